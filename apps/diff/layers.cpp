#include "apps/diff/layers.h"

#include <algorithm>

#include "core/error.h"

namespace penumbra::diff {
namespace {

std::string layer_of(const std::string& channel) {
    const std::size_t dot = channel.rfind('.');
    if (dot != std::string::npos) return channel.substr(0, dot);
    return channel.size() == 1 && std::string_view("RGBAY").find(channel) != std::string_view::npos
               ? "beauty"
               : channel;
}

std::string suffix_of(const std::string& channel) {
    const std::size_t dot = channel.rfind('.');
    return dot == std::string::npos ? channel : channel.substr(dot + 1);
}

void find_colour(const SourcePart& part, Layer& layer) {
    const auto place = [&](std::string_view suffix) {
        for (std::size_t i = 0; i < layer.channels.size(); ++i) {
            const SourceChannel& channel =
                part.channels[static_cast<std::size_t>(layer.channels[i])];
            if (suffix_of(channel.name) == suffix && !channel.holds_ids())
                return static_cast<int>(i);
        }
        return -1;
    };
    const int r = place("R"), g = place("G"), b = place("B"), y = place("Y"), x = place("X");
    if (r >= 0 && g >= 0 && b >= 0)
        layer.colour = {r, g, b};
    else if (y >= 0 && x < 0)  // X and Y are coordinates
        layer.colour = {y, y, y};
}

std::string to_text(const image::Window& w) {
    return fmt::format("{} x {} at ({}, {})", w.width(), w.height(), w.x0, w.y0);
}

// Channel types by name, without those of ignored layers.
std::vector<std::pair<std::string, std::string>> channels_of(const ImageSource& image, int part,
                                                             const std::set<std::string>& ignored) {
    std::vector<std::pair<std::string, std::string>> result;
    const auto& channels = image.parts()[static_cast<std::size_t>(part)].channels;
    for (const Layer& layer : find_layers(image))
        if (layer.part == part && !ignored.contains(layer.name))
            for (const int i : layer.channels)
                result.emplace_back(channels[static_cast<std::size_t>(i)].name,
                                    channels[static_cast<std::size_t>(i)].type);
    std::sort(result.begin(), result.end());
    return result;
}

class StructureCheck {
  public:
    StructureCheck(const ImageSource& reference, const ImageSource& test,
                   const std::set<std::string>& ignored)
        : reference_(reference), test_(test), ignored_(ignored) {}

    std::vector<Failure> run() {
        if (reference_.is_display_coded() != test_.is_display_coded()) {
            fail(FailureKind::kFormat, fmt::format("the reference is {}, the test {}",
                                                   coding(reference_), coding(test_)));
        }
        if (reference_.parts().size() != test_.parts().size()) {
            fail(FailureKind::kParts, fmt::format("the reference has {} parts, the test {}",
                                                  reference_.parts().size(), test_.parts().size()));
            return std::move(failures_);
        }
        for (std::size_t i = 0; i < reference_.parts().size(); ++i) check_part(static_cast<int>(i));
        return std::move(failures_);
    }

  private:
    static std::string_view coding(const ImageSource& image) {
        return image.is_display_coded() ? "display-coded (PNG, JPEG)" : "scene-linear (EXR, HDR)";
    }
    void fail(FailureKind kind, std::string message) {
        failures_.push_back({kind, "", std::move(message)});
    }

    void check_part(int number) {
        const SourcePart& a = reference_.parts()[static_cast<std::size_t>(number)];
        const SourcePart& b = test_.parts()[static_cast<std::size_t>(number)];
        if (a.name != b.name)
            fail(FailureKind::kParts,
                 fmt::format("part {} is '{}' in the reference, '{}' in the test", number, a.name,
                             b.name));
        if (a.display.width() != b.display.width() || a.display.height() != b.display.height())
            fail(
                FailureKind::kSize,
                fmt::format("the reference has {} x {} pixels, the test {} x {}", a.display.width(),
                            a.display.height(), b.display.width(), b.display.height()));
        else if (!(a.display == b.display))
            fail(FailureKind::kWindow, fmt::format("the display window is {} in the reference, {} "
                                                   "in the test",
                                                   to_text(a.display), to_text(b.display)));
        if (!(a.data == b.data) && (a.display == b.display || !(a.data == a.display)))
            fail(FailureKind::kWindow,
                 fmt::format("the data window is {} in the reference, {} in the test",
                             to_text(a.data), to_text(b.data)));
        check_channels(number);
    }

    template <class Channels>
    static auto find_channel(const Channels& channels, const std::string& name) {
        return std::find_if(channels.begin(), channels.end(),
                            [&](const auto& each) { return each.first == name; });
    }

    void check_channels(int part) {
        const auto a = channels_of(reference_, part, ignored_);
        const auto b = channels_of(test_, part, ignored_);
        std::string missing, added;
        for (const auto& [name, type] : a) {
            const auto other = find_channel(b, name);
            if (other == b.end())
                missing += " " + name;
            else if (other->second != type)
                fail(FailureKind::kType, fmt::format("channel {} is {} in the reference, {} in the "
                                                     "test",
                                                     name, type, other->second));
        }
        for (const auto& [name, type] : b)
            if (find_channel(a, name) == a.end()) added += " " + name;
        if (!missing.empty())
            fail(FailureKind::kChannels, "channels missing in the test:" + missing);
        if (!added.empty())
            fail(FailureKind::kChannels, "channels that only the test has:" + added);
    }

    const ImageSource& reference_;
    const ImageSource& test_;
    const std::set<std::string>& ignored_;
    std::vector<Failure> failures_;
};

}  // namespace

std::vector<Layer> find_layers(const ImageSource& image) {
    std::vector<Layer> layers;
    for (std::size_t p = 0; p < image.parts().size(); ++p) {
        const SourcePart& part = image.parts()[p];
        const std::string prefix = image.parts().size() > 1 ? part.name + ":" : "";
        const std::size_t first = layers.size();
        for (std::size_t c = 0; c < part.channels.size(); ++c) {
            const std::string name = prefix + layer_of(part.channels[c].name);
            auto at = std::find_if(layers.begin() + static_cast<std::ptrdiff_t>(first),
                                   layers.end(), [&](const Layer& l) { return l.name == name; });
            if (at == layers.end()) at = layers.insert(at, {name, static_cast<int>(p), {}, {}});
            at->channels.push_back(static_cast<int>(c));
        }
        for (std::size_t i = first; i < layers.size(); ++i) find_colour(part, layers[i]);
    }
    return layers;
}

std::vector<Failure> compare_structure(const ImageSource& reference, const ImageSource& test,
                                       const std::set<std::string>& ignored) {
    return StructureCheck(reference, test, ignored).run();
}

}  // namespace penumbra::diff
