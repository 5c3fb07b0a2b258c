#include "core/image/deflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "core/image/huffman.h"

namespace penumbra::image {
namespace {

constexpr std::size_t kBlockTokens = std::size_t{1} << 16;
constexpr int kHashBits = 15;
constexpr std::size_t kWindow = 32768;
constexpr std::size_t kShortestMatch = 4;
constexpr std::size_t kLongestMatch = 258;
constexpr std::size_t kEndOfBlock = 256;

// RFC 1951, 3.2.5: the first length and distance of each code, and how many bits follow it.
constexpr std::uint16_t kLengthBase[29] = {3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                           15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                           67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr std::uint8_t kLengthBits[29] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                          2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
// 3.2.7: the order in which lengths of the code for code lengths are sent.
constexpr std::uint8_t kLengthOrder[19] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                           11, 4,  12, 3, 13, 2, 14, 1, 15};

constexpr std::array<std::uint8_t, 259> make_length_codes() {
    std::array<std::uint8_t, 259> codes{};
    for (std::size_t length = 3; length < 259; ++length) {
        std::uint8_t code = 28;
        while (kLengthBase[code] > length) --code;
        codes[length] = code;
    }
    return codes;
}
constexpr std::array<std::uint8_t, 259> kLengthCodes = make_length_codes();

struct DistanceCode {
    std::uint32_t code, bits, extra;
};
// Distances double every two codes.
DistanceCode distance_code(std::uint32_t distance) {
    const std::uint32_t n = distance - 1;
    if (n < 4) return {n, 0, 0};
    const auto log = static_cast<std::uint32_t>(std::bit_width(n)) - 1;
    const std::uint32_t half = (n >> (log - 1)) & 1;
    return {2 * log + half, log - 1, n & ((1u << (log - 1)) - 1)};
}

// A literal (length 0, its value in `distance`) or a match.
struct Token {
    std::uint16_t length, distance;
};

class BitWriter {
  public:
    explicit BitWriter(std::vector<std::uint8_t>& to) : to_(to) {}
    // At most 32 bits at once, the lowest first.
    void put(std::uint32_t bits, std::uint32_t count) {
        pending_ |= static_cast<std::uint64_t>(bits) << filled_;
        filled_ += count;
        if (filled_ < 32) return;
        std::uint8_t word[4];
        for (std::uint32_t i = 0; i < 4; ++i)
            word[i] = static_cast<std::uint8_t>(pending_ >> (8 * i));
        to_.insert(to_.end(), word, word + 4);
        pending_ >>= 32;
        filled_ -= 32;
    }
    void finish() {
        for (; filled_ > 0; filled_ -= std::min(filled_, 8u)) {
            to_.push_back(static_cast<std::uint8_t>(pending_));
            pending_ >>= 8;
        }
    }

  private:
    std::vector<std::uint8_t>& to_;
    std::uint64_t pending_ = 0;
    std::uint32_t filled_ = 0;
};

std::uint32_t load32(const std::uint8_t* from) {
    std::uint32_t word;
    std::memcpy(&word, from, 4);
    return word;
}

std::size_t match_length(const std::uint8_t* a, const std::uint8_t* b, std::size_t limit) {
    std::size_t length = 0;
    while (length + 8 <= limit) {
        std::uint64_t x, y;
        std::memcpy(&x, a + length, 8);
        std::memcpy(&y, b + length, 8);
        if (x != y) return length + static_cast<std::size_t>(std::countr_zero(x ^ y)) / 8;
        length += 8;
    }
    while (length < limit && a[length] == b[length]) ++length;
    return length;
}

// Cuts the bytes into literals and matches, a block at a time.
class Matcher {
  public:
    explicit Matcher(std::span<const std::uint8_t> bytes)
        : bytes_(bytes), last_(std::size_t{1} << kHashBits, kNever) {}

    [[nodiscard]] bool done() const { return at_ == bytes_.size(); }

    void next_block(std::vector<Token>& tokens) {
        tokens.clear();
        while (tokens.size() < kBlockTokens && at_ < bytes_.size()) {
            const std::size_t length = find_match();
            if (length == 0) {
                tokens.push_back({0, bytes_[at_++]});
                continue;
            }
            tokens.push_back(
                {static_cast<std::uint16_t>(length), static_cast<std::uint16_t>(distance_)});
            at_ += length;
        }
    }

  private:
    static constexpr std::uint32_t kNever = 0xFFFFFFFF;

    std::size_t find_match() {
        const std::size_t left = bytes_.size() - at_;
        if (left < kShortestMatch) return 0;
        const std::uint32_t word = load32(&bytes_[at_]);
        std::uint32_t& slot = last_[(word * 0x9E3779B1u) >> (32 - kHashBits)];
        const std::size_t candidate = slot;
        slot = static_cast<std::uint32_t>(at_);
        if (candidate == kNever || at_ - candidate >= kWindow) return 0;
        if (load32(&bytes_[candidate]) != word) return 0;
        distance_ = at_ - candidate;
        return match_length(&bytes_[candidate], &bytes_[at_], std::min(left, kLongestMatch));
    }

    std::span<const std::uint8_t> bytes_;
    std::vector<std::uint32_t> last_;  // where each hash was met last
    std::size_t at_ = 0;
    std::size_t distance_ = 0;
};

// Writes one block with codes of its own (BTYPE 2).
class BlockWriter {
  public:
    explicit BlockWriter(BitWriter& out) : out_(out) {}

    void write(const std::vector<Token>& tokens, bool is_last) {
        count(tokens);
        literals_ = make_huffman_code(literal_counts_, 15);
        distances_ = make_huffman_code(distance_counts_, 15);
        out_.put(is_last ? 1 : 0, 1);
        out_.put(2, 2);
        write_codes();
        for (const Token& token : tokens) write_token(token);
        out_.put(literals_.codes[kEndOfBlock], literals_.lengths[kEndOfBlock]);
    }

  private:
    void count(const std::vector<Token>& tokens) {
        literal_counts_.fill(0);
        distance_counts_.fill(0);
        literal_counts_[kEndOfBlock] = 1;
        for (const Token& token : tokens) {
            if (token.length == 0) {
                ++literal_counts_[token.distance];
            } else {
                ++literal_counts_[257u + kLengthCodes[token.length]];
                ++distance_counts_[distance_code(token.distance).code];
            }
        }
    }

    // The lengths of both codes, themselves coded; runs are not used: 320 lengths per block are
    // little.
    void write_codes() {
        std::array<std::uint32_t, 19> counts{};
        for (const std::uint8_t length : literals_.lengths) ++counts[length];
        for (const std::uint8_t length : distances_.lengths) ++counts[length];
        const HuffmanCode lengths = make_huffman_code(counts, 7);
        out_.put(static_cast<std::uint32_t>(literals_.lengths.size()) - 257, 5);
        out_.put(static_cast<std::uint32_t>(distances_.lengths.size()) - 1, 5);
        out_.put(19 - 4, 4);
        for (const std::uint8_t symbol : kLengthOrder) out_.put(lengths.lengths[symbol], 3);
        for (const HuffmanCode* code : {&literals_, &distances_}) {
            for (const std::uint8_t length : code->lengths) {
                out_.put(lengths.codes[length], lengths.lengths[length]);
            }
        }
    }

    void write_token(const Token& token) {
        if (token.length == 0) {
            out_.put(literals_.codes[token.distance], literals_.lengths[token.distance]);
            return;
        }
        const std::uint32_t length = kLengthCodes[token.length];
        out_.put(literals_.codes[257 + length], literals_.lengths[257 + length]);
        out_.put(static_cast<std::uint32_t>(token.length) - kLengthBase[length],
                 kLengthBits[length]);
        const DistanceCode distance = distance_code(token.distance);
        out_.put(distances_.codes[distance.code], distances_.lengths[distance.code]);
        out_.put(distance.extra, distance.bits);
    }

    BitWriter& out_;
    std::array<std::uint32_t, 286> literal_counts_{};
    std::array<std::uint32_t, 30> distance_counts_{};
    HuffmanCode literals_, distances_;
};

std::uint32_t adler32(std::span<const std::uint8_t> bytes) {
    std::uint32_t a = 1, b = 0;
    while (!bytes.empty()) {
        // As many as cannot overflow 32 bits before the remainder is taken.
        const auto part = bytes.first(std::min<std::size_t>(bytes.size(), 5552));
        for (const std::uint8_t byte : part) b += a += byte;
        a %= 65521;
        b %= 65521;
        bytes = bytes.subspan(part.size());
    }
    return b << 16 | a;
}

}  // namespace

std::vector<std::uint8_t> deflate(std::span<const std::uint8_t> bytes) {
    std::vector<std::uint8_t> stream{0x78, 0x01};
    stream.reserve(bytes.size() / 2 + 1024);
    BitWriter bits(stream);
    BlockWriter blocks(bits);
    Matcher matcher(bytes);
    std::vector<Token> tokens;
    do {
        matcher.next_block(tokens);
        blocks.write(tokens, matcher.done());
    } while (!matcher.done());
    bits.finish();
    const std::uint32_t checksum = adler32(bytes);
    for (int shift = 24; shift >= 0; shift -= 8) {
        stream.push_back(static_cast<std::uint8_t>(checksum >> shift));
    }
    return stream;
}

}  // namespace penumbra::image
