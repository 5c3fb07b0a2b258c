#include "apps/renderer/frame_file.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "apps/renderer/frame_list.h"
#include "apps/renderer/version.h"
#include "core/error.h"
#include "core/image/png.h"
#include "core/image/publish.h"

namespace penumbra::renderer {
namespace {

constexpr const char* kDigestAttribute = "penumbraDigest";

using image::ExrMatrix;

// OpenEXR's standard attribute worldToCamera: x right, y up, z along the view, row vectors.
ExrMatrix world_to_camera(const Camera& c) {
    const auto offset = [&](const Vec3f& axis) { return -dot(axis, c.eye); };
    return {{c.right.x, c.up.x, c.forward.x, 0,  //
             c.right.y, c.up.y, c.forward.y, 0,  //
             c.right.z, c.up.z, c.forward.z, 0,  //
             offset(c.right), offset(c.up), offset(c.forward), 1}};
}

// worldToNDC: after the division by w, (0, 0) is the display window's top left and (1, 1) its
// bottom right.
ExrMatrix world_to_ndc(const Camera& c, int width, int height) {
    const auto w = static_cast<float>(width);
    const auto h = static_cast<float>(height);
    const Vec3f x = (c.right * c.focal + c.forward * c.center_x) * (1 / w);
    const Vec3f y = (c.forward * c.center_y - c.up * c.focal) * (1 / h);
    const Vec3f z = c.forward;
    return {{x.x, y.x, z.x, z.x,  //
             x.y, y.y, z.y, z.y,  //
             x.z, y.z, z.z, z.z,  //
             -dot(x, c.eye), -dot(y, c.eye), -dot(z, c.eye), -dot(z, c.eye)}};
}

// 23.976 and its like are thousandths over 1001.
image::ExrRational rational(double frames_per_second) {
    const double ntsc = std::round(frames_per_second * 1.001);
    if (std::abs(ntsc * 1000 / 1001 - frames_per_second) < 1e-3 && ntsc != frames_per_second)
        return {static_cast<int>(ntsc) * 1000, 1001};
    if (frames_per_second == std::round(frames_per_second))
        return {static_cast<int>(frames_per_second), 1};
    return {static_cast<int>(std::lround(frames_per_second * 1000)), 1000};
}

// Collects channels from the film's planes, cut to the crop.
class Channels {
  public:
    Channels(const Film& film, bool float_precision)
        : dx_(film.crop.x0 - film.window.x0),
          dy_(film.crop.y0 - film.window.y0),
          float_precision_(float_precision) {}

    void add(std::string_view name, SampleType type, const Plane<float>& plane) {
        const bool half = type == SampleType::kHalf && !float_precision_;
        channels_.push_back({.name = std::string(name),
                             .type = half ? image::ExrType::kHalf : image::ExrType::kFloat,
                             .floats = plane.view().offset(dx_, dy_)});
    }
    void add(std::string_view name, const Plane<std::uint32_t>& plane) {
        channels_.push_back({.name = std::string(name),
                             .type = image::ExrType::kUint,
                             .ids = plane.view().offset(dx_, dy_)});
    }
    [[nodiscard]] std::vector<image::ExrChannel> take() { return std::move(channels_); }

  private:
    int dx_, dy_;
    bool float_precision_;
    std::vector<image::ExrChannel> channels_;
};

void add_aov(const AovInfo& aov, const Film& film, Channels& channels) {
    for (std::size_t i = 0; i < aov.channels().size(); ++i)
        if (aov.type == SampleType::kUint)
            channels.add(aov.slots[i].name, film.ids(aov.aov, i));
        else
            channels.add(aov.slots[i].name, aov.type, film.numbers(aov.aov, i));
}

image::Window to_window(const PixelRect& r) {
    return {.x0 = r.x0, .y0 = r.y0, .x1 = r.x1, .y1 = r.y1};
}

void write_preview(const Film& film, const std::string& path, float exposure) {
    const auto cut = [&](const Plane<float>& plane) {
        return plane.view().offset(film.crop.x0 - film.window.x0, film.crop.y0 - film.window.y0);
    };
    const PlaneView3<const float> rgb = {cut(film.beauty[0]), cut(film.beauty[1]),
                                         cut(film.beauty[2])};
    image::write_png(path, image::tone_map(rgb, film.crop.width(), film.crop.height(),
                                           {.exposure_ev = exposure}));
}

}  // namespace

image::ExrImage describe_file(const Film& film, const FrameIdentity& identity,
                              const OutputSettings& output) {
    Channels channels(film, output.float_precision);
    for (const AovInfo& aov : aov_table())
        if (output.aovs.contains(aov.aov)) add_aov(aov, film, channels);
    return {.display = {.x0 = 0, .y0 = 0, .x1 = film.width, .y1 = film.height},
            .data = to_window(film.crop),
            .channels = channels.take(),
            .metadata = {{"software", fmt::format("penumbra {}", version())},
                         {"frame", identity.frame},
                         {"framesPerSecond", rational(identity.frames_per_second)},
                         {"worldToCamera", world_to_camera(identity.camera)},
                         {"worldToNDC", world_to_ndc(identity.camera, film.width, film.height)},
                         {"penumbraSettings", identity.settings},
                         {kDigestAttribute, identity.digest}},
            .compression = output.compression};
}

image::ExrWriteReport write_frame(const Film& film, const FrameIdentity& identity,
                                  const OutputSettings& output, int threads) {
    image::PendingFile file(expand_pattern(output.pattern, identity.frame));
    const image::ExrWriteReport report =
        image::write_exr(file.path(), describe_file(film, identity, output), threads);
    image::require_complete(file.path());
    // The EXR last: its presence says that a frame is done.
    if (output.preview)
        write_preview(film, expand_pattern(*output.preview, identity.frame), output.exposure);
    file.publish();
    return report;
}

bool is_already_rendered(const OutputSettings& output, int frame, const std::string& digest) {
    const std::filesystem::path path = expand_pattern(output.pattern, frame);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return false;
    if (output.preview &&
        !std::filesystem::is_regular_file(expand_pattern(*output.preview, frame), ignored))
        return false;
    try {
        const image::ExrHeader header = image::read_exr_header(path);
        const auto found = header.metadata.find(kDigestAttribute);
        return header.is_complete() && found != header.metadata.end() &&
               found->second == image::ExrValue(digest);
    } catch (const InputError&) {
        return false;  // some other file: it is rendered anew
    }
}

}  // namespace penumbra::renderer
