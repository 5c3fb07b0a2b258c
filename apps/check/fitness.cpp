#include "apps/check/fitness.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <vector>

#include "apps/diff/image_source.h"
#include "core/error.h"

namespace penumbra::check {
namespace {

// What is known of a channel from the rows so far.
class Channel {
  public:
    explicit Channel(const diff::SourceChannel& info) : info_(info) {}

    void add(const float* values, int count) {
        std::string bytes;
        for (int x = 0; x < count; ++x) {
            add_value(std::bit_cast<std::uint32_t>(values[x]), values[x] == 0, bytes);
            if (!std::isfinite(values[x])) ++non_finite_;
        }
        add_row(bytes);
    }
    void add(const std::uint32_t* ids, int count) {
        std::string bytes;
        for (int x = 0; x < count; ++x) add_value(ids[x], ids[x] == 0, bytes);
        add_row(bytes);
    }

    [[nodiscard]] bool is_zero() const { return is_zero_; }
    [[nodiscard]] bool is_constant() const { return is_constant_; }
    [[nodiscard]] std::size_t non_finite() const { return non_finite_; }
    [[nodiscard]] const std::string& name() const { return info_.name; }
    [[nodiscard]] bool holds_ids() const { return info_.holds_ids(); }
    // Name, type and values in words.
    [[nodiscard]] std::string summary() const {
        return fmt::format("{} {} {}", info_.name, info_.type,
                           digest_of(rows_, VirtualFiles{}).hex());
    }

  private:
    void add_value(std::uint32_t bits, bool is_zero, std::string& bytes) {
        if (!first_) first_ = bits;
        is_constant_ = is_constant_ && bits == *first_;
        is_zero_ = is_zero_ && is_zero;
        for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 255);
    }
    // By rows, so that it does not depend on the blocks in which files are read.
    void add_row(const std::string& bytes) { rows_ += digest_of(bytes, VirtualFiles{}).hex(); }

    diff::SourceChannel info_;
    std::optional<std::uint32_t> first_;
    bool is_zero_ = true, is_constant_ = true;
    std::size_t non_finite_ = 0;
    std::string rows_;
};

// The rows of a part, a few at a time: memory does not grow with the picture's height.
void read_part(diff::ImageSource& image, int part, std::vector<Channel>& channels) {
    const diff::SourcePart& info = image.parts()[static_cast<std::size_t>(part)];
    const int width = info.data.width(), height = info.data.height();
    constexpr int kFewestRows = 16;
    const int band = std::max(kFewestRows, image.lines_per_block(part));
    std::vector<Plane<float>> floats(channels.size());
    std::vector<Plane<std::uint32_t>> ids(channels.size());
    std::vector<diff::ChannelRows> rows(channels.size());
    for (std::size_t i = 0; i < channels.size(); ++i) {
        rows[i].channel = static_cast<int>(i);
        if (channels[i].holds_ids())
            rows[i].ids = (ids[i] = Plane<std::uint32_t>(width, band)).view();
        else
            rows[i].floats = (floats[i] = Plane<float>(width, band)).view();
    }
    for (int first = 0; first < height; first += band) {
        const int end = std::min(height, first + band);
        image.read(part, first, end, rows, 0);
        for (std::size_t i = 0; i < channels.size(); ++i)
            for (int y = 0; y < end - first; ++y) {
                if (channels[i].holds_ids())
                    channels[i].add(ids[i].row(y), width);
                else
                    channels[i].add(floats[i].row(y), width);
            }
    }
}

std::string problem_of(const std::vector<Channel>& channels) {
    std::size_t non_finite = 0;
    std::vector<const Channel*> judged;
    for (const Channel& channel : channels) {
        non_finite += channel.non_finite();
        if (channel.name() == "R" || channel.name() == "G" || channel.name() == "B")
            judged.push_back(&channel);
    }
    if (non_finite > 0)
        return fmt::format("holds {} values that are no finite numbers", non_finite);
    if (judged.empty())
        for (const Channel& channel : channels) judged.push_back(&channel);
    const auto all = [&](bool (Channel::*holds)() const) {
        return std::all_of(judged.begin(), judged.end(),
                           [&](const Channel* channel) { return (channel->*holds)(); });
    };
    if (all(&Channel::is_zero)) return "is black";
    return all(&Channel::is_constant) ? "has one colour everywhere" : "";
}

}  // namespace

Fitness judge_picture(const std::filesystem::path& exr_file) {
    std::vector<diff::Failure> failures;
    const auto image = diff::open_image(exr_file, 1, failures);
    if (!image) throw InputError(exr_file, failures.empty() ? "" : failures.front().message);
    std::vector<Channel> all;
    std::string text;
    for (std::size_t part = 0; part < image->parts().size(); ++part) {
        const diff::SourcePart& info = image->parts()[part];
        std::vector<Channel> channels;
        for (const diff::SourceChannel& channel : info.channels) channels.emplace_back(channel);
        read_part(*image, static_cast<int>(part), channels);
        text += fmt::format("{} {} x {}: ", info.name, info.data.width(), info.data.height());
        for (Channel& channel : channels) {
            text += channel.summary() + ", ";
            all.push_back(std::move(channel));
        }
    }
    return {digest_of(text, VirtualFiles{}), problem_of(all)};
}

}  // namespace penumbra::check
