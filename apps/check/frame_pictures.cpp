#include "apps/check/frame_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "apps/diff/html_parts.h"
#include "apps/diff/image_source.h"
#include "apps/page/html.h"
#include "core/error.h"
#include "core/image/png.h"

namespace penumbra::check {
namespace {

// Wider pictures are reduced: they only say what the scene is.
constexpr int kWidestPicture = 640;

// Places of R, G and B among a part's channels; nothing where it has no such picture.
std::optional<std::array<int, 3>> find_colours(const diff::SourcePart& part) {
    constexpr std::string_view kNames[] = {"R", "G", "B"};
    std::array<int, 3> places{-1, -1, -1};
    for (std::size_t i = 0; i < part.channels.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            if (part.channels[i].name == kNames[c] && !part.channels[i].holds_ids())
                places[c] = static_cast<int>(i);
    if (std::find(places.begin(), places.end(), -1) != places.end()) return std::nullopt;
    return places;
}

// The beauty as a picture, every step-th pixel of it, where the file has one.
std::optional<image::Picture> picture_of(const std::filesystem::path& file) {
    std::vector<diff::Failure> failures;
    const auto image = diff::open_image(file, 1, failures);
    if (!image) throw InputError(file, failures.empty() ? "" : failures.front().message);
    const diff::SourcePart& part = image->parts().front();
    const auto colours = find_colours(part);
    if (!colours) return std::nullopt;
    const int width = part.data.width(), height = part.data.height();
    const int step = (width + kWidestPicture - 1) / kWidestPicture;
    const int w = (width + step - 1) / step, h = (height + step - 1) / step;
    const int band = std::max(16, image->lines_per_block(0));
    Plane3<float> reduced = make_plane3<float>(w, h), rows = make_plane3<float>(width, band);
    std::vector<diff::ChannelRows> targets;
    for (std::size_t c = 0; c < 3; ++c) targets.push_back({(*colours)[c], rows[c].view(), {}});
    for (int first = 0; first < height; first += band) {
        const int end = std::min(height, first + band);
        image->read(0, first, end, targets, 0);
        for (int y = (first + step - 1) / step; y * step < end; ++y)
            for (std::size_t c = 0; c < 3; ++c)
                for (int x = 0; x < w; ++x)
                    reduced[c].at(x, y) = rows[c].at(x * step, y * step - first);
    }
    return image::tone_map(view(std::as_const(reduced)), w, h, {.curve = image::ToneCurve::kClip});
}

std::string single_picture(const FrameOutcome& frame) {
    try {
        const auto picture = picture_of(frame.render);
        if (!picture) return "";
        return fmt::format(
            "<figure class=\"render\"><img alt=\"the new picture\" src=\"{}\"></figure>\n",
            page::html_data_uri(*picture));
    } catch (const InputError& error) {
        return fmt::format("<p>{}</p>\n", page::html_escaped(error.what()));
    }
}

}  // namespace

std::string frame_pictures(const FrameOutcome& frame) {
    std::string html;
    if (!frame.frame.empty()) html += fmt::format("<h3>Frame {}</h3>\n", frame.frame);
    if (frame.comparison) {
        const std::string viewers = diff::html_viewers(*frame.comparison);
        html += diff::html_failures(*frame.comparison);
        if (!viewers.empty())
            return html + viewers +
                   fmt::format("<details><summary>all numbers</summary>{}</details>\n",
                               diff::html_metrics(*frame.comparison));
    }
    return html + single_picture(frame);
}

}  // namespace penumbra::check
