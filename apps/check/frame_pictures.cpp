#include "apps/check/frame_pictures.h"

#include <fmt/format.h>

#include "apps/diff/html_parts.h"
#include "core/error.h"
#include "core/image/exr.h"
#include "core/image/png.h"

namespace penumbra::check {
namespace {

// Wider pictures are reduced: they only say what the scene is.
constexpr int kWidestPicture = 640;

// The beauty as a picture; nothing where a file has none.
std::optional<image::Picture> picture_of(const std::filesystem::path& file) {
    const image::ExrPixels pixels = image::read_exr(file);
    const image::ExrPlane* const rgb[3] = {pixels.find("R"), pixels.find("G"), pixels.find("B")};
    for (const image::ExrPlane* plane : rgb)
        if (plane == nullptr || plane->type == image::ExrType::kUint) return std::nullopt;
    const int width = pixels.header.data.width(), height = pixels.header.data.height();
    const int step = (width + kWidestPicture - 1) / kWidestPicture;
    Plane3<float> reduced{Plane<float>(width / step, (height + step - 1) / step), {}, {}};
    const int w = width / step, h = (height + step - 1) / step;
    for (std::size_t c = 0; c < 3; ++c) {
        reduced[c] = Plane<float>(w, h);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) reduced[c].at(x, y) = rgb[c]->floats.at(x * step, y * step);
    }
    return image::tone_map({reduced[0].view(), reduced[1].view(), reduced[2].view()}, w, h,
                           {.curve = image::ToneCurve::kClip});
}

std::string single_picture(const FrameOutcome& frame) {
    try {
        const auto picture = picture_of(frame.render);
        if (!picture) return "";
        return fmt::format(
            "<figure class=\"render\"><img alt=\"the new picture\" src=\"{}\"></figure>\n",
            diff::html_data_uri(*picture));
    } catch (const InputError& error) {
        return fmt::format("<p>{}</p>\n", diff::html_escaped(error.what()));
    }
}

}  // namespace

std::string frame_pictures(const FrameOutcome& frame) {
    std::string html;
    if (!frame.frame.empty()) html += fmt::format("<h3>Frame {}</h3>\n", frame.frame);
    if (frame.comparison) {
        const std::string viewers = diff::html_viewers(*frame.comparison);
        html += diff::html_failures(*frame.comparison);
        if (frame.verdict != Verdict::kPassed || !viewers.empty())
            html += diff::html_metrics(*frame.comparison);
        if (!viewers.empty()) return html + viewers;
    }
    return html + single_picture(frame);
}

}  // namespace penumbra::check
