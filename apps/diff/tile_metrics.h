#pragma once

#include <cstdint>
#include <vector>

#include "apps/diff/layers.h"
#include "apps/diff/mask.h"
#include "apps/diff/metric.h"
#include "apps/diff/part_reader.h"
#include "core/compare/error_sums.h"
#include "core/compare/flip.h"

namespace penumbra::diff {

// Tiles are the unit of work and of summation: constants, so that the sums do not depend on
// threads.
inline constexpr int kTileWidth = 256;
inline constexpr int kTileHeight = 64;
// Squares that reports enlarge.
inline constexpr int kBlockSize = 64;
inline constexpr int kBlocksPerTile = kTileWidth / kBlockSize;

// The channels of a layer in the reader's slots.
struct LayerSlots {
    std::vector<int> slots;
    std::vector<int> colour;  // three of them, or none
};

// Pixels [x0, x1) x [y0, y1) of the data window.
struct TileRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    [[nodiscard]] int width() const { return x1 - x0; }
    [[nodiscard]] int height() const { return y1 - y0; }
};

// What the tiles of one layer have in common.
struct TileContext {
    const PartReader& reader;
    const LayerSlots& layer;
    const Mask* mask = nullptr;  // all pixels count where there is none
    int mask_x = 0, mask_y = 0;  // the data window's top left in the mask
    bool is_display_coded = false;
    double pixel_threshold = 0;
    MetricSet metrics;
    compare::Exposures exposures;  // of HDR-FLIP

    [[nodiscard]] bool counts(int x, int y) const {
        return mask == nullptr || mask->counts(x + mask_x, y + mask_y);
    }
};

// A mean in the making.
struct MeanSum {
    double sum = 0;
    std::uint64_t count = 0;
    void add(double value) {
        sum += value;
        ++count;
    }
    void add(const MeanSum& other) {
        sum += other.sum;
        count += other.count;
    }
    [[nodiscard]] double mean() const { return count == 0 ? 0 : sum / static_cast<double>(count); }
};

struct TileSums {
    std::uint64_t pixels = 0;              // compared
    std::uint64_t exceeding = 0;           // of them, beyond the pixel threshold
    std::vector<std::uint64_t> differing;  // by slot of the layer
    NonFinite reference, test;
    compare::ErrorSums errors, coded;
    MeanSum ssim, flip, hdr_flip;
    MeanSum block_errors[kBlocksPerTile];

    void add(const TileSums& other);  // all but block_errors
};

[[nodiscard]] TileSums measure_tile(const TileContext& context, const TileRect& tile);

// How different two values are to the eye of the error map, in [0, 1]: |a - b| / max(|a|, |b|);
// 1 for ids that differ and where one is not finite.
[[nodiscard]] double relative_difference(const TileContext& context, int slot, int x, int y);

// Do the bits differ? Zeros of both signs are the same.
[[nodiscard]] bool values_differ(const TileContext& context, int slot, int x, int y);

}  // namespace penumbra::diff
