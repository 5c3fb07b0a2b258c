#include "apps/renderer/setting_notations.h"

#include <fmt/format.h>

#include <charconv>

#include "core/error.h"

namespace penumbra::renderer {
namespace {

constexpr int kLargestSide = 16384;  // as for a scene's film.size

// `count` integers with one separator between each two; empty if the text is anything else.
std::vector<int> integers(std::string_view text, char separator, std::size_t count) {
    std::vector<int> values;
    while (values.size() < count) {
        int value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{}) return {};
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        values.push_back(value);
        if (values.size() == count) break;
        if (text.empty() || text.front() != separator) return {};
        text.remove_prefix(1);
    }
    return text.empty() ? values : std::vector<int>{};
}

}  // namespace

void read_size(std::string_view text, ImageSettings& image) {
    const std::vector<int> size = integers(text, 'x', 2);
    if (size.empty() || size[0] < 1 || size[1] < 1 || size[0] > kLargestSide ||
        size[1] > kLargestSide)
        throw InputError(fmt::format("--size: expected WIDTHxHEIGHT, each 1 to {}, got \"{}\"",
                                     kLargestSide, text));
    image.width = size[0];
    image.height = size[1];
}

std::string print_size(const ImageSettings& image) {
    return image.width > 0 ? fmt::format("{}x{}", image.width, image.height) : "";
}

void read_crop(std::string_view text, std::optional<PixelRect>& crop) {
    const std::vector<int> c = integers(text, ',', 4);
    if (c.empty() || c[0] < 0 || c[1] < 0 || c[2] <= c[0] || c[3] <= c[1])
        throw InputError(
            fmt::format("--crop: expected X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1, got \"{}\"", text));
    crop = PixelRect{.x0 = c[0], .y0 = c[1], .x1 = c[2], .y1 = c[3]};
}

std::string print_crop(const std::optional<PixelRect>& crop) {
    return crop ? fmt::format("{},{},{},{}", crop->x0, crop->y0, crop->x1, crop->y1) : "";
}

void read_aovs(std::string_view text, AovSet& aovs) {
    aovs = parse_aov_list(text);
}

std::string print_aovs(const AovSet& aovs) {
    std::string text;
    for (const AovInfo& aov : aov_table())
        if (aovs.contains(aov.aov)) text += fmt::format("{}{}", text.empty() ? "" : ",", aov.name);
    return text;
}

std::vector<std::string> aov_words() {
    std::vector<std::string> words{"all"};
    for (const AovInfo& aov : aov_table()) words.emplace_back(aov.name);
    return words;
}

std::vector<std::pair<std::string_view, image::ExrCompression>> compression_words() {
    std::vector<std::pair<std::string_view, image::ExrCompression>> words;
    for (const image::ExrCompression each : image::exr_compressions())
        words.emplace_back(image::name(each), each);
    return words;
}

void read_preview(std::string_view text, std::optional<std::string>& preview) {
    const std::size_t dot = text.rfind('.');
    if (dot == std::string_view::npos || text.substr(dot) != ".png")
        throw InputError(
            fmt::format("--preview: expected a name that ends in .png, got \"{}\"", text));
    preview = text;
}

std::string print_preview(const std::optional<std::string>& preview) {
    return preview.value_or("");
}

}  // namespace penumbra::renderer
