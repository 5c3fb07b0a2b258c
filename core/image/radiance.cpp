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
constexpr std::size_t kMaxHeaderLength = std::size_t{1} << 20;

using Rgbe = std::array<std::uint8_t, 4>;

// No row is longer: flat pixels take 4 bytes, each behind at most three empty runs of 4.
std::size_t longest_row(int width) {
    return 16 * static_cast<std::size_t>(width) + 8;
}

// Some bytes of the file, from one place on.
class Bytes {
  public:
    Bytes(const FileReader& file, std::uint64_t begin, std::size_t length)
        : path_(file.path()), begin_(begin) {
        const std::uint64_t rest = file.size() - std::min(begin, file.size());
        content_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(rest, length)));
        if (!file.read_at(begin, content_)) fail("is cut off");
    }

    [[noreturn]] void fail(std::string_view what) const {
        throw InputError(path_, fmt::format("byte {}", place()),
                         fmt::format("the Radiance HDR file {}", what));
    }
    [[nodiscard]] std::uint64_t place() const { return begin_ + at_; }
    [[nodiscard]] std::size_t left() const { return content_.size() - at_; }

    std::string_view line() {
        const std::size_t begin = at_;
        while (at_ < content_.size() && content_[at_] != '\n') {
            if (++at_ - begin > kMaxLineLength) fail("has a header line of over 4096 bytes");
        }
        if (at_ == content_.size()) fail("is cut off in its header");
        const char* text = reinterpret_cast<const char*>(content_.data()) + begin;
        return {text, at_++ - begin};
    }
    Rgbe next_pixel() {
        if (left() < 4) fail("is cut off");
        const std::uint8_t* p = content_.data() + at_;
        at_ += 4;
        return {p[0], p[1], p[2], p[3]};
    }
    std::uint8_t next_byte() {
        if (left() == 0) fail("is cut off");
        return content_[at_++];
    }

  private:
    const std::filesystem::path& path_;
    std::uint64_t begin_;
    std::vector<std::uint8_t> content_;
    std::size_t at_ = 0;
};

void read_variables(Bytes& bytes) {
    (void)bytes.line();  // "#?RADIANCE" or "#?RGBE"
    bool has_format = false;
    for (std::string_view text = bytes.line(); !text.empty(); text = bytes.line()) {
        if (!text.starts_with("FORMAT=")) continue;
        if (text != "FORMAT=32-bit_rle_rgbe") {
            bytes.fail(fmt::format("has '{}', expected FORMAT=32-bit_rle_rgbe", text));
        }
        has_format = true;
    }
    if (!has_format) bytes.fail("has no FORMAT line");
}

bool read_number(std::string_view& text, std::string_view prefix, int& number) {
    if (!text.starts_with(prefix)) return false;
    text.remove_prefix(prefix.size());
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return error == std::errc() && number > 0;
}

struct Header {
    int width = 0, height = 0;
    std::uint64_t end = 0;
};

Header read_header(const FileReader& file) {
    Bytes bytes(file, 0, kMaxHeaderLength);
    read_variables(bytes);
    const std::string_view whole = bytes.line();
    std::string_view text = whole;
    Header header;
    if (!read_number(text, "-Y ", header.height) || !read_number(text, " +X ", header.width) ||
        !text.empty()) {
        bytes.fail(fmt::format("has the size '{}', expected '-Y height +X width'", whole));
    }
    header.end = bytes.place();
    return header;
}

// One row after the other out of some bytes.
class RowDecoder {
  public:
    RowDecoder(Bytes& bytes, int width) : bytes_(bytes), row_(static_cast<std::size_t>(width)) {}

    const std::vector<Rgbe>& next() {
        const Rgbe first = bytes_.next_pixel();
        const bool by_component = row_.size() >= 8 && row_.size() < 32768 && first[0] == 2 &&
                                  first[1] == 2 && first[2] < 128;
        if (!by_component) {
            read_pixels(first);
        } else if (first[2] * 256u + first[3] != row_.size()) {
            bytes_.fail(fmt::format("has a row of {} pixels, expected {}",
                                    first[2] * 256 + first[3], row_.size()));
        } else {
            for (std::size_t component = 0; component < 4; ++component) read_component(component);
        }
        return row_;
    }

  private:
    // Counts above 128 repeat one byte, others copy that many.
    void read_component(std::size_t component) {
        for (std::size_t x = 0; x < row_.size();) {
            const std::uint8_t count = bytes_.next_byte();
            const bool repeats = count > 128;
            const std::size_t length = repeats ? count - 128u : count;
            if (length == 0 || length > row_.size() - x)
                bytes_.fail("has a run that leaves its row");
            std::uint8_t value = repeats ? bytes_.next_byte() : std::uint8_t{0};
            for (std::size_t i = 0; i < length; ++i) {
                if (!repeats) value = bytes_.next_byte();
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
                if (x == 0 || shift > 16) bytes_.fail("has a run without a pixel before it");
                const std::size_t count = static_cast<std::size_t>(pixel[3]) << shift;
                if (count > row_.size() - x) bytes_.fail("has a run that leaves its row");
                for (std::size_t i = 0; i < count; ++i, ++x) row_[x] = row_[x - 1];
                shift += 8;
            } else {
                row_[x++] = pixel;
                shift = 0;
            }
            if (x == row_.size()) return;
            pixel = bytes_.next_pixel();
        }
    }

    Bytes& bytes_;
    std::vector<Rgbe> row_;
};

// An exponent of 0 is black; else mantissa / 256 * 2^(exponent - 128), exact in a float.
const std::array<float, 256>& scales() {
    static const std::array<float, 256> kScales = [] {
        std::array<float, 256> table{};
        for (int e = 1; e < 256; ++e)
            table[static_cast<std::size_t>(e)] = std::ldexp(1.0f, e - 136);
        return table;
    }();
    return kScales;
}

}  // namespace

bool is_radiance(std::span<const std::uint8_t> content) {
    const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
    return text.starts_with("#?RADIANCE") || text.starts_with("#?RGBE");
}

RadianceRows::RadianceRows(const FileReader& file) : file_(file) {
    const Header header = read_header(file);
    width_ = header.width;
    height_ = header.height;
    check_image_size(static_cast<std::uint64_t>(width_), static_cast<std::uint64_t>(height_), 0,
                     file.path());
    begins_.push_back(header.end);
    find_rows();
}

void RadianceRows::find_rows() {
    const std::size_t longest = longest_row(width_);
    const auto rows = static_cast<std::size_t>(height_) + 1;
    while (begins_.size() < rows) {
        Bytes bytes(file_, begins_.back(), std::max(longest, std::size_t{1} << 20));
        const bool is_last = bytes.place() + bytes.left() == file_.size();
        RowDecoder decoder(bytes, width_);
        do {
            (void)decoder.next();
            begins_.push_back(bytes.place());
        } while (begins_.size() < rows && (is_last || bytes.left() >= longest));
    }
}

void RadianceRows::read(int first, int end, const Take& take) const {
    const std::uint64_t begin = begins_[static_cast<std::size_t>(first)];
    Bytes bytes(file_, begin,
                static_cast<std::size_t>(begins_[static_cast<std::size_t>(end)] - begin));
    RowDecoder decoder(bytes, width_);
    std::vector<float> rgb(3 * static_cast<std::size_t>(width_));
    for (int row = first; row < end; ++row) {
        std::size_t to = 0;
        for (const Rgbe& pixel : decoder.next()) {
            const float scale = scales()[pixel[3]];
            for (std::size_t c = 0; c < 3; ++c) rgb[to++] = static_cast<float>(pixel[c]) * scale;
        }
        take(row, rgb);
    }
}

DecodedImage decode_radiance(std::span<const std::uint8_t> content,
                             const std::filesystem::path& name) {
    const FileReader file(content, name);
    const Header header = read_header(file);
    check_image_size(static_cast<std::uint64_t>(header.width),
                     static_cast<std::uint64_t>(header.height), 3 * sizeof(float), name);
    const RadianceRows rows(file);  // all there: memory is not taken for what a header promises
    DecodedImage image;
    image.width = rows.width();
    image.height = rows.height();
    image.channels = 3;
    image.type = SampleType::kFloat;
    image.floats.reserve(image.sample_count());
    constexpr int kRowsAtOnce = 16;
    for (int y = 0; y < image.height; y += kRowsAtOnce)
        rows.read(y, std::min(y + kRowsAtOnce, image.height), [&](int, std::span<const float> rgb) {
            image.floats.insert(image.floats.end(), rgb.begin(), rgb.end());
        });
    return image;
}

}  // namespace penumbra::image
