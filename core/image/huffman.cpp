#include "core/image/huffman.h"

#include <algorithm>
#include <array>

namespace penumbra::image {
namespace {

struct Leaf {
    std::uint32_t frequency;
    std::uint16_t symbol;
};

std::vector<Leaf> used_symbols(std::span<const std::uint32_t> frequencies) {
    std::vector<Leaf> leaves;
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
        if (frequencies[i] > 0) leaves.push_back({frequencies[i], static_cast<std::uint16_t>(i)});
    }
    for (std::size_t i = 0; leaves.size() < 2; ++i) {
        if (frequencies[i] == 0) leaves.push_back({1, static_cast<std::uint16_t>(i)});
    }
    // Ties by symbol: the same code on every machine.
    std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) {
        return a.frequency != b.frequency ? a.frequency < b.frequency : a.symbol < b.symbol;
    });
    return leaves;
}

// Depths of the leaves of a Huffman tree, leaves in order of frequency: two queues, the leaves and
// the inner nodes, whose frequencies come out sorted (van Leeuwen 1976).
std::vector<int> tree_depths(const std::vector<Leaf>& leaves) {
    const std::size_t count = leaves.size();
    std::vector<std::uint64_t> weight(2 * count - 1);
    std::vector<std::size_t> parent(2 * count - 1, 0);
    for (std::size_t i = 0; i < count; ++i) weight[i] = leaves[i].frequency;
    std::size_t leaf = 0, inner = count;
    for (std::size_t node = count; node < weight.size(); ++node) {
        for (int child = 0; child < 2; ++child) {
            const bool take_leaf = leaf < count && (inner >= node || weight[leaf] <= weight[inner]);
            const std::size_t taken = take_leaf ? leaf++ : inner++;
            weight[node] += weight[taken];
            parent[taken] = node;
        }
    }
    std::vector<int> depth(weight.size(), 0);
    for (std::size_t node = weight.size() - 1; node-- > 0;) depth[node] = depth[parent[node]] + 1;
    depth.resize(count);
    return depth;
}

// How many codes of each length. Too long ones are cut; then the Kraft sum, counted in units of
// 2^-longest, is brought back to exactly 1 (decoders refuse incomplete codes): by lengthening the
// longest codes that may still grow, and by shortening again what that took too much.
std::array<std::uint32_t, 17> limit_lengths(const std::vector<int>& depths, int longest) {
    std::array<std::uint32_t, 17> count{};
    const std::int64_t whole = std::int64_t{1} << longest;
    std::int64_t kraft = 0;
    for (const int depth : depths) {
        const int length = std::min(depth, longest);
        ++count[static_cast<std::size_t>(length)];
        kraft += whole >> length;
    }
    const auto move = [&](int from, int to) {
        --count[static_cast<std::size_t>(from)];
        ++count[static_cast<std::size_t>(to)];
        kraft += (whole >> to) - (whole >> from);
    };
    while (kraft > whole) {
        int length = longest - 1;
        while (count[static_cast<std::size_t>(length)] == 0) --length;
        move(length, length + 1);
    }
    // A code of length n that loses a bit fills 2^-n more; the longest ones can fill any remainder.
    for (int length = 2; length <= longest; ++length) {
        while (count[static_cast<std::size_t>(length)] > 0 && whole - kraft >= whole >> length) {
            move(length, length - 1);
        }
    }
    return count;
}

std::uint16_t reversed(std::uint32_t code, int length) {
    std::uint32_t result = 0;
    for (int bit = 0; bit < length; ++bit) result |= ((code >> bit) & 1) << (length - 1 - bit);
    return static_cast<std::uint16_t>(result);
}

void assign_codes(HuffmanCode& code, const std::array<std::uint32_t, 17>& count) {
    std::array<std::uint32_t, 17> next{};
    for (std::size_t length = 1; length < 17; ++length) {
        next[length] = (next[length - 1] + (length > 1 ? count[length - 1] : 0)) << 1;
    }
    for (std::size_t symbol = 0; symbol < code.lengths.size(); ++symbol) {
        const std::uint8_t length = code.lengths[symbol];
        if (length > 0) code.codes[symbol] = reversed(next[length]++, length);
    }
}

}  // namespace

HuffmanCode make_huffman_code(std::span<const std::uint32_t> frequencies, int longest) {
    const std::vector<Leaf> leaves = used_symbols(frequencies);
    const std::array<std::uint32_t, 17> count = limit_lengths(tree_depths(leaves), longest);
    HuffmanCode code{std::vector<std::uint8_t>(frequencies.size()),
                     std::vector<std::uint16_t>(frequencies.size())};
    // The rarest symbols get the longest codes.
    std::size_t leaf = 0;
    for (std::size_t length = 16; length > 0; --length) {
        for (std::uint32_t n = count[length]; n > 0; --n) {
            code.lengths[leaves[leaf++].symbol] = static_cast<std::uint8_t>(length);
        }
    }
    assign_codes(code, count);
    return code;
}

}  // namespace penumbra::image
