#include "core/image/radiance.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/error.h"
#include "core/image/file_checks.h"

namespace penumbra::image {
namespace {

constexpr std::size_t kMaxLineLength = 4096;

using Rgbe = std::array<std::uint8_t, 4>;

class RadianceReader {
  public:
    RadianceReader(std::span<const std::uint8_t> content, const std::filesystem::path& name)
        : content_(content), name_(name) {}

    DecodedImage read() {
        read_header();
        read_resolution();
        image_.channels = 3;
        image_.type = SampleType::kFloat;
        check_image_size(static_cast<std::uint64_t>(image_.width),
                         static_cast<std::uint64_t>(image_.height), 3 * sizeof(float), name_);
        // Memory grows with the rows that there are, not with those that the header promises.
        image_.floats.reserve(std::min(image_.sample_count(), content_.size() * 48));
        row_.resize(static_cast<std::size_t>(image_.width));
        for (int y = 0; y < image_.height; ++y) read_row();
        return std::move(image_);
    }

  private:
    [[noreturn]] void fail(std::string_view what) const {
        throw InputError(name_, fmt::format("byte {}", at_),
                         fmt::format("the Radiance HDR file {}", what));
    }

    std::string_view line() {
        const std::size_t begin = at_;
        while (at_ < content_.size() && content_[at_] != '\n') {
            if (++at_ - begin > kMaxLineLength) fail("has a header line of over 4096 bytes");
        }
        if (at_ == content_.size()) fail("is cut off in its header");
        const char* text = reinterpret_cast<const char*>(content_.data()) + begin;
        return {text, at_++ - begin};
    }

    void read_header() {
        (void)line();  // "#?RADIANCE" or "#?RGBE"
        bool has_format = false;
        for (std::string_view text = line(); !text.empty(); text = line()) {
            if (!text.starts_with("FORMAT=")) continue;
            if (text != "FORMAT=32-bit_rle_rgbe") {
                fail(fmt::format("has '{}', expected FORMAT=32-bit_rle_rgbe", text));
            }
            has_format = true;
        }
        if (!has_format) fail("has no FORMAT line");
    }

    static bool read_number(std::string_view& text, std::string_view prefix, int& number) {
        if (!text.starts_with(prefix)) return false;
        text.remove_prefix(prefix.size());
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        return error == std::errc() && number > 0;
    }

    void read_resolution() {
        const std::string_view whole = line();
        std::string_view text = whole;
        if (!read_number(text, "-Y ", image_.height) || !read_number(text, " +X ", image_.width) ||
            !text.empty()) {
            fail(fmt::format("has the size '{}', expected '-Y height +X width'", whole));
        }
    }

    Rgbe next_pixel() {
        if (content_.size() - at_ < 4) fail("is cut off");
        const std::uint8_t* p = content_.data() + at_;
        at_ += 4;
        return {p[0], p[1], p[2], p[3]};
    }
    std::uint8_t next_byte() {
        if (at_ == content_.size()) fail("is cut off");
        return content_[at_++];
    }

    void read_row() {
        const Rgbe first = next_pixel();
        const bool by_component = image_.width >= 8 && image_.width < 32768 && first[0] == 2 &&
                                  first[1] == 2 && first[2] < 128;
        if (!by_component) {
            read_pixels(first);
        } else if (first[2] * 256 + first[3] != image_.width) {
            fail(fmt::format("has a row of {} pixels, expected {}", first[2] * 256 + first[3],
                             image_.width));
        } else {
            for (std::size_t component = 0; component < 4; ++component) read_component(component);
        }
        for (const Rgbe& pixel : row_) append(pixel);
    }

    // Counts above 128 repeat one byte, others copy that many.
    void read_component(std::size_t component) {
        for (std::size_t x = 0; x < row_.size();) {
            const std::uint8_t count = next_byte();
            const bool repeats = count > 128;
            const std::size_t length = repeats ? count - 128u : count;
            if (length == 0 || length > row_.size() - x) fail("has a run that leaves its row");
            std::uint8_t value = repeats ? next_byte() : std::uint8_t{0};
            for (std::size_t i = 0; i < length; ++i) {
                if (!repeats) value = next_byte();
                row_[x++][component] = value;
            }
        }
    }

    // Flat, or the old run-length code: a pixel (1, 1, 1, n) repeats the one before n times;
    // several of them in a row are the digits of one number in base 256, lowest first.
    void read_pixels(Rgbe pixel) {
        int shift = 0;
        for (std::size_t x = 0;;) {
            if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
                if (x == 0 || shift > 16) fail("has a run without a pixel before it");
                const std::size_t count = static_cast<std::size_t>(pixel[3]) << shift;
                if (count > row_.size() - x) fail("has a run that leaves its row");
                for (std::size_t i = 0; i < count; ++i, ++x) row_[x] = row_[x - 1];
                shift += 8;
            } else {
                row_[x++] = pixel;
                shift = 0;
            }
            if (x == row_.size()) return;
            pixel = next_pixel();
        }
    }

    void append(const Rgbe& pixel) {
        // An exponent of 0 is black; else mantissa / 256 * 2^(exponent - 128), exact in a float.
        const float scale = pixel[3] == 0 ? 0.0f : std::ldexp(1.0f, pixel[3] - 136);
        for (std::size_t c = 0; c < 3; ++c) {
            image_.floats.push_back(static_cast<float>(pixel[c]) * scale);
        }
    }

    std::span<const std::uint8_t> content_;
    const std::filesystem::path& name_;
    std::size_t at_ = 0;
    DecodedImage image_;
    std::vector<Rgbe> row_;
};

}  // namespace

bool is_radiance(std::span<const std::uint8_t> content) {
    const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
    return text.starts_with("#?RADIANCE") || text.starts_with("#?RGBE");
}

DecodedImage decode_radiance(std::span<const std::uint8_t> content,
                             const std::filesystem::path& name) {
    return RadianceReader(content, name).read();
}

}  // namespace penumbra::image
