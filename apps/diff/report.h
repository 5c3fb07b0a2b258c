#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/diff/metric.h"
#include "core/image/png.h"

// What a comparison found: plain data for the console, JSON and HTML.

namespace penumbra::diff {

// What is wrong with a pair, each a kind of its own.
enum class FailureKind {
    kMissing,      // a file is not there: exit code 2
    kNotAnImage,   // of no known format: 2
    kUnsupported,  // an EXR that is deep or subsampled: 2
    kMask,         // not of the picture's size, or black: 2
    kNothing,      // no layer is left to compare: 2
    kIncomplete,   // blocks of pixels are missing
    kDamaged,      // begins like an image but cannot be read
    kFormat,       // other kinds of files: one is display-coded, one scene-linear
    kParts,
    kSize,      // of the display window
    kWindow,    // its place, or the data window
    kChannels,  // names
    kType,      // of channels
    kNonFinite,
    kThreshold,  // a metric is beyond its limit
    kDiffers,    // values differ that no threshold covers
};
[[nodiscard]] std::string_view name(FailureKind kind);
// Is the input at fault, not the picture?
[[nodiscard]] bool is_input_error(FailureKind kind);

struct Failure {
    FailureKind kind;
    std::string layer;  // "" where the whole file is meant
    std::string message;
};

struct NonFinite {
    std::uint64_t nan = 0, infinite = 0;  // values
};

// A square of pixels, in the data window's own coordinates, with its mean error: FLIP for
// colours (plus a thousandth of the relative difference), else the relative difference.
struct Block {
    int x = 0, y = 0, width = 0, height = 0;
    double error = 0;
};

// The same pixels of both images and the colours of the error map.
struct Pictures {
    image::Picture reference, test, heat;
};
struct WorstTile {
    Block block;
    Pictures pictures;
};

struct ChannelReport {
    std::string name;
    std::string type;
    bool is_colour = false;       // one of those that PSNR, SSIM and FLIP see
    std::uint64_t differing = 0;  // pixels
};

struct LayerReport {
    std::string name;
    bool is_colour = false;
    std::vector<ChannelReport> channels;
    std::uint64_t pixels = 0;  // compared
    MetricValues metrics;
    NonFinite reference, test;
    std::vector<Block> worst;  // most different first, only such that differ
    // Only where pictures were asked for and the layer differs.
    std::optional<Pictures> pictures;
    int reduction = 1;  // one pixel of `pictures` stands for a square of so many
    std::vector<WorstTile> worst_pictures;

    [[nodiscard]] bool differs() const;
};

struct PairReport {
    std::string name;  // of the pair in reports
    std::string reference, test;
    std::vector<Failure> failures;
    std::vector<LayerReport> layers;
    std::vector<std::string> ignored_layers;
    // Over all layers and parts: the largest error at each pixel of all data windows. Only where
    // asked for.
    std::optional<image::Picture> heat;

    [[nodiscard]] bool passed() const { return failures.empty(); }
    [[nodiscard]] int exit_code() const;  // 0, 1 or 2
};

}  // namespace penumbra::diff
