#include "apps/renderer/frame_list.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <unordered_set>

#include "core/error.h"

namespace penumbra::renderer {
namespace {

constexpr std::size_t kMostFrames = 1'000'000;

struct Range {
    int first, last, step;
};

// A number at the start of `text`, which is then shortened by it.
std::optional<int> take_number(std::string_view& text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

bool take(std::string_view& text, char c) {
    if (text.empty() || text.front() != c) return false;
    text.remove_prefix(1);
    return true;
}

std::optional<Range> parse_range(std::string_view text) {
    const std::optional<int> first = take_number(text);
    if (!first) return std::nullopt;
    Range range{*first, *first, 1};
    if (take(text, '-')) {
        const std::optional<int> last = take_number(text);
        if (!last || *last < *first) return std::nullopt;
        range.last = *last;
        if (take(text, 'x')) {
            const std::optional<int> step = take_number(text);
            if (!step || *step < 1) return std::nullopt;
            range.step = *step;
        }
    }
    return text.empty() ? std::optional(range) : std::nullopt;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

}  // namespace

std::vector<int> parse_frame_list(std::string_view text) {
    std::vector<int> frames;
    std::unordered_set<int> seen;
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        const std::string_view item = trimmed(rest.substr(0, comma));
        const std::optional<Range> range = parse_range(item);
        if (!range) {
            throw InputError(fmt::format(
                "--frames: expected a frame, FIRST-LAST or FIRST-LASTxSTEP, got \"{}\"", item));
        }
        for (long long f = range->first; f <= range->last; f += range->step) {
            if (frames.size() >= kMostFrames)
                throw InputError(fmt::format("--frames: more than {} frames", kMostFrames));
            if (seen.insert(static_cast<int>(f)).second) frames.push_back(static_cast<int>(f));
        }
        if (comma == std::string_view::npos) return frames;
        rest.remove_prefix(comma + 1);
    }
}

std::string expand_pattern(std::string_view pattern, int frame) {
    std::string path;
    const std::size_t slash = pattern.rfind('/');
    const std::size_t name = slash == std::string_view::npos ? 0 : slash + 1;
    path = pattern.substr(0, name);
    for (std::size_t i = name; i < pattern.size();) {
        std::size_t run = 0;
        while (i + run < pattern.size() && pattern[i + run] == '#') ++run;
        if (run == 0) {
            path += pattern[i++];
        } else {
            path += frame < 0 ? fmt::format("-{:0{}}", -static_cast<long long>(frame), run)
                              : fmt::format("{:0{}}", frame, run);
            i += run;
        }
    }
    return path;
}

bool has_frame_number(std::string_view pattern) {
    const std::size_t slash = pattern.rfind('/');
    return pattern.find('#', slash == std::string_view::npos ? 0 : slash) != std::string_view::npos;
}

}  // namespace penumbra::renderer
