#include "core/parallel/tiles.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/error.h"

namespace penumbra::parallel {
namespace {

int floor_to_tile(int pixel) {
    const int remainder = pixel % kTileSize;
    return pixel - remainder - (remainder < 0 ? kTileSize : 0);
}

// The even bits of a Morton code hold x, the odd ones y.
std::uint64_t spread_bits(std::uint32_t n) {
    std::uint64_t spread = 0;
    for (int bit = 0; bit < 32; ++bit)
        spread |= static_cast<std::uint64_t>((n >> bit) & 1u) << (2 * bit);
    return spread;
}

void sort_by_morton_code(const TileGrid& grid, std::vector<int>& sequence) {
    std::vector<std::pair<std::uint64_t, int>> keyed;
    keyed.reserve(sequence.size());
    for (const int index : sequence) {
        const auto column = static_cast<std::uint32_t>(index % grid.columns);
        const auto row = static_cast<std::uint32_t>(index / grid.columns);
        keyed.emplace_back(spread_bits(column) | spread_bits(row) << 1, index);
    }
    std::sort(keyed.begin(), keyed.end());
    std::transform(keyed.begin(), keyed.end(), sequence.begin(),
                   [](const auto& entry) { return entry.second; });
}

// Fisher and Yates, with a generator of our own: std::shuffle's result is up to the library.
void shuffle(std::vector<int>& sequence, std::uint32_t seed) {
    std::uint64_t state = seed;
    for (std::size_t remaining = sequence.size(); remaining > 1; --remaining) {
        // Knuth's linear congruential generator (MMIX); the upper bits are the good ones.
        state = state * 6364136223846793005u + 1442695040888963407u;
        std::swap(sequence[remaining - 1], sequence[(state >> 33) % remaining]);
    }
}

}  // namespace

TileGrid::TileGrid(const PixelRect& rect) : window(rect) {
    if (rect.empty()) return;
    x0 = floor_to_tile(rect.x0);
    y0 = floor_to_tile(rect.y0);
    columns = (floor_to_tile(rect.x1 - 1) - x0) / kTileSize + 1;
    rows = (floor_to_tile(rect.y1 - 1) - y0) / kTileSize + 1;
}

Tile TileGrid::tile(int index) const {
    PENUMBRA_ASSERT(index >= 0 && index < count(), "index = {}, count = {}", index, count());
    return {.x0 = x0 + index % columns * kTileSize,
            .y0 = y0 + index / columns * kTileSize,
            .index = index};
}

PixelRect TileGrid::visible(const Tile& tile) const {
    return {std::max(window.x0, tile.x0), std::max(window.y0, tile.y0),
            std::min(window.x1, tile.x0 + kTileSize), std::min(window.y1, tile.y0 + kTileSize)};
}

std::vector<int> tile_sequence(const TileGrid& grid, const TileOrder& order) {
    std::vector<int> sequence(static_cast<std::size_t>(grid.count()));
    std::iota(sequence.begin(), sequence.end(), 0);
    if (order.kind == TileOrder::Kind::kMorton) sort_by_morton_code(grid, sequence);
    if (order.kind == TileOrder::Kind::kShuffled) shuffle(sequence, order.seed);
    return sequence;
}

void for_each_tile(const Arena& arena, const TileGrid& grid, const TileOrder& order,
                   const std::function<void(const Tile&, int)>& body,
                   const std::atomic<bool>* cancelled) {
    const std::vector<int> sequence = tile_sequence(grid, order);
    const auto run_tile = [&](int position, int worker) {
        body(grid.tile(sequence[static_cast<std::size_t>(position)]), worker);
    };
    arena.for_each(grid.count(), run_tile, cancelled);
}

}  // namespace penumbra::parallel
