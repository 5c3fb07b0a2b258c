#include "apps/diff/part_comparison.h"

#include <algorithm>
#include <cmath>

#include "apps/diff/tile_pictures.h"
#include "core/compare/median.h"

namespace penumbra::diff {
namespace {

constexpr std::size_t kWorstTiles = 6;
constexpr std::size_t kLargestPictures = 4;  // layers whose pictures a report shows
// Rows of both images that a band holds; at least one row of tiles, whatever it takes.
constexpr std::size_t kBandBytes = std::size_t{192} << 20;
constexpr int kLargestBand = 16 * kTileHeight;

int band_height(int width, std::size_t slots) {
    const std::size_t row =
        static_cast<std::size_t>(width) * 4 * 2 * std::max<std::size_t>(slots, 1);
    const auto tiles = static_cast<int>(kBandBytes / row / kTileHeight);
    return std::clamp(tiles * kTileHeight, kTileHeight, kLargestBand);
}

struct SlotTable {
    std::vector<Slot> slots;
    std::vector<LayerSlots> layers;
};

SlotTable make_slots(const std::vector<LayerPair>& layers, const SourcePart& part) {
    SlotTable table;
    for (const LayerPair& layer : layers) {
        LayerSlots entry;
        for (std::size_t i = 0; i < layer.test_channels.size(); ++i) {
            const int channel = layer.reference.channels[i];
            entry.slots.push_back(static_cast<int>(table.slots.size()));
            table.slots.push_back({channel, layer.test_channels[i],
                                   part.channels[static_cast<std::size_t>(channel)].holds_ids()});
        }
        for (const int place : layer.reference.colour)
            entry.colour.push_back(entry.slots[static_cast<std::size_t>(place)]);
        table.layers.push_back(std::move(entry));
    }
    return table;
}

bool more_different(const Block& a, const Block& b) {
    if (a.error != b.error) return a.error > b.error;
    return a.y != b.y ? a.y < b.y : a.x < b.x;
}

void keep_worst(std::vector<Block>& blocks, std::size_t count) {
    std::sort(blocks.begin(), blocks.end(), more_different);
    if (blocks.size() > count) blocks.resize(count);
}

void append_blocks(const TileSums& sums, const TileRect& tile, std::vector<Block>& blocks) {
    for (int i = 0; i < kBlocksPerTile; ++i) {
        const int x = tile.x0 + i * kBlockSize;
        if (x >= tile.x1 || !(sums.block_errors[i].sum > 0)) continue;
        blocks.push_back({x, tile.y0, std::min(kBlockSize, tile.x1 - x), tile.height(),
                          sums.block_errors[i].mean()});
    }
}

image::Picture crop(const image::Picture& from, int x0, int y0, int width, int height) {
    image::Picture to{width, height, 3, {}};
    for (int y = 0; y < height; ++y) {
        const auto begin =
            from.bytes.begin() + (static_cast<std::ptrdiff_t>(y0 + y) * from.width + x0) * 3;
        to.bytes.insert(to.bytes.end(), begin, begin + 3 * width);
    }
    return to;
}

void crop_worst(const TilePictures& drawn, const TileRect& tile, LayerReport& report) {
    const image::Picture heat = colour_map(drawn.heat, tile.width(), tile.height());
    for (std::size_t i = 0; i < report.worst.size(); ++i) {
        const Block& b = report.worst[i];
        if (b.y != tile.y0 || b.x < tile.x0 || b.x >= tile.x1) continue;
        const int x = b.x - tile.x0;
        report.worst_pictures[i] = {
            b,
            {crop(drawn.reference, x, 0, b.width, b.height),
             crop(drawn.test, x, 0, b.width, b.height), crop(heat, x, 0, b.width, b.height)}};
    }
}

struct Canvases {
    PictureCanvas reference, test;
    Canvases(int width, int height) : reference(width, height), test(width, height) {}
};

// Rec. 709 luminance of what HDR-FLIP sees: negative and non-finite values count as 0.
std::vector<float> luminances(const PartReader& reader, const std::vector<int>& colour, int y) {
    constexpr float kWeights[3] = {0.2126f, 0.7152f, 0.0722f};
    std::vector<float> row(static_cast<std::size_t>(reader.width()));
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const float* values = reader.floats(Side::kReference, colour[channel], y);
        for (std::size_t x = 0; x < row.size(); ++x)
            if (values[x] > 0 && std::isfinite(values[x])) row[x] += kWeights[channel] * values[x];
    }
    return row;
}

MetricSet without_hdr(MetricSet metrics) {
    metrics.remove(Metric::kHdrFlip);
    return metrics;
}

}  // namespace

PartComparison::PartComparison(ImageSource& reference, ImageSource& test, int part,
                               const CompareSettings& settings, const parallel::Arena& arena)
    : reference_(reference),
      test_(test),
      part_(part),
      settings_(settings),
      arena_(arena),
      info_(reference.parts()[static_cast<std::size_t>(part)]) {}

void PartComparison::for_each_tile(const std::vector<LayerPair>& layers, MetricSet metrics,
                                   const std::vector<compare::Exposures>& exposures,
                                   const Body& body) {
    const SlotTable table = make_slots(layers, info_);
    PartReader reader(reference_, test_, part_, table.slots, arena_);
    const int width = reader.width(), height = reader.height();
    const int columns = (width + kTileWidth - 1) / kTileWidth;
    const int band = band_height(width, table.slots.size());
    for (int top = 0; top < height; top += band) {
        const int bottom = std::min(top + band, height);
        reader.load(std::max(top - compare::kFlipHalo, 0),
                    std::min(bottom + compare::kFlipHalo, height));
        const int rows = (bottom - top + kTileHeight - 1) / kTileHeight;
        const int tiles = rows * columns;
        arena_.for_each(tiles * static_cast<int>(layers.size()), [&](int index, int) {
            const auto layer = static_cast<std::size_t>(index / tiles);
            const int column = index % tiles % columns, row = index % tiles / columns;
            const TileRect rect{column * kTileWidth, top + row * kTileHeight,
                                std::min((column + 1) * kTileWidth, width),
                                std::min(top + (row + 1) * kTileHeight, height)};
            const TileContext context{
                .reader = reader,
                .layer = table.layers[layer],
                .mask = settings_.mask,
                .mask_x = info_.data.x0 - info_.display.x0,
                .mask_y = info_.data.y0 - info_.display.y0,
                .is_display_coded = reference_.is_display_coded(),
                .pixel_threshold = settings_.pixel_threshold,
                .metrics = metrics,
                .exposures = exposures.empty() ? compare::Exposures{} : exposures[layer]};
            body(context, layer, (top / kTileHeight + row) * columns + column, rect);
        });
    }
}

std::vector<TileSums> PartComparison::measure(const std::vector<LayerPair>& layers,
                                              MetricSet metrics,
                                              const std::vector<compare::Exposures>& exposures,
                                              std::vector<std::vector<Block>>* blocks) {
    const int columns = (info_.data.width() + kTileWidth - 1) / kTileWidth;
    const int rows = (info_.data.height() + kTileHeight - 1) / kTileHeight;
    std::vector<std::vector<TileSums>> tiles(layers.size());
    for (auto& each : tiles) each.resize(static_cast<std::size_t>(columns) * rows);
    std::vector<TileRect> rects(static_cast<std::size_t>(columns) * rows);
    for_each_tile(
        layers, metrics, exposures,
        [&](const TileContext& context, std::size_t layer, int tile, const TileRect& rect) {
            tiles[layer][static_cast<std::size_t>(tile)] = measure_tile(context, rect);
            if (layer == 0) rects[static_cast<std::size_t>(tile)] = rect;
        });
    std::vector<TileSums> totals(layers.size());
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
        totals[layer].differing.resize(layers[layer].test_channels.size());
        for (std::size_t i = 0; i < rects.size(); ++i) {
            totals[layer].add(tiles[layer][i]);
            if (blocks != nullptr) append_blocks(tiles[layer][i], rects[i], (*blocks)[layer]);
        }
    }
    return totals;
}

LayerReport PartComparison::to_report(const LayerPair& layer, const TileSums& sums,
                                      std::vector<Block> blocks) const {
    LayerReport report;
    report.name = layer.reference.name;
    report.is_colour = layer.reference.is_colour();
    for (std::size_t i = 0; i < sums.differing.size(); ++i) {
        const SourceChannel& channel =
            info_.channels[static_cast<std::size_t>(layer.reference.channels[i])];
        const bool is_colour =
            std::find(layer.reference.colour.begin(), layer.reference.colour.end(),
                      static_cast<int>(i)) != layer.reference.colour.end();
        report.channels.push_back({channel.name, channel.type, is_colour, sums.differing[i]});
    }
    report.pixels = sums.pixels;
    report.reference = sums.reference;
    report.test = sums.test;
    keep_worst(blocks, kWorstTiles);
    report.worst = std::move(blocks);
    const auto set = [&](Metric metric, double value) {
        if (settings_.metrics.has(metric)) report.metrics[metric] = value;
    };
    set(Metric::kMax, sums.errors.largest);
    set(Metric::kMae, sums.errors.mae());
    set(Metric::kRmse, sums.errors.rmse());
    set(Metric::kRelmse, sums.errors.relmse());
    set(Metric::kPixels, static_cast<double>(sums.exceeding));
    set(Metric::kShare,
        sums.pixels == 0 ? 0
                         : static_cast<double>(sums.exceeding) / static_cast<double>(sums.pixels));
    if (!report.is_colour) return report;
    set(Metric::kPsnr, sums.coded.psnr());
    // Where the mask leaves no whole window, nothing is known against the test.
    set(Metric::kSsim, sums.ssim.count == 0 ? 1 : sums.ssim.mean());
    set(Metric::kFlip, sums.flip.mean());
    if (!reference_.is_display_coded()) set(Metric::kHdrFlip, 0);
    return report;
}

std::vector<compare::Exposures> PartComparison::survey(const std::vector<LayerPair>& layers) {
    std::vector<compare::StreamingMedian> medians(layers.size());
    const SlotTable table = make_slots(layers, info_);
    for (const bool is_first : {true, false}) {
        PartReader reader(
            reference_, reference_, part_,
            [&] {
                std::vector<Slot> slots = table.slots;
                for (Slot& slot : slots) slot.test_channel = slot.reference_channel;
                return slots;
            }(),
            arena_);
        const int band = band_height(reader.width(), table.slots.size());
        for (int top = 0; top < reader.height(); top += band) {
            const int bottom = std::min(top + band, reader.height());
            reader.load(top, bottom);
            arena_.for_each(static_cast<int>(layers.size()), [&](int index, int) {
                const auto layer = static_cast<std::size_t>(index);
                for (int y = top; y < bottom; ++y) {
                    const std::vector<float> row =
                        luminances(reader, table.layers[layer].colour, y);
                    is_first ? medians[layer].count_upper(row) : medians[layer].count_lower(row);
                }
            });
        }
        if (is_first)
            for (compare::StreamingMedian& median : medians) median.choose_upper();
    }
    std::vector<compare::Exposures> exposures;
    for (const compare::StreamingMedian& median : medians)
        exposures.push_back(compare::choose_exposures(static_cast<double>(median.median()),
                                                      static_cast<double>(median.largest())));
    return exposures;
}

// Only layers whose colours differ are looked at: three more passes over the reference and one over
// the test.
void PartComparison::measure_hdr(const std::vector<LayerPair>& layers,
                                 std::vector<LayerReport>& reports) {
    if (!settings_.metrics.has(Metric::kHdrFlip) || reference_.is_display_coded()) return;
    std::vector<LayerPair> chosen;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (!reports[i].is_colour || !reports[i].differs()) continue;
        chosen.push_back(layers[i]);
        places.push_back(i);
    }
    if (chosen.empty()) return;
    MetricSet metrics;
    metrics.add(Metric::kHdrFlip);
    const std::vector<TileSums> totals = measure(chosen, metrics, survey(chosen), nullptr);
    for (std::size_t i = 0; i < chosen.size(); ++i)
        reports[places[i]].metrics[Metric::kHdrFlip] = totals[i].hdr_flip.mean();
}

void PartComparison::draw(const std::vector<LayerPair>& layers, std::vector<LayerReport>& reports,
                          std::optional<image::Picture>* heat) {
    std::vector<LayerPair> chosen;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (!reports[i].differs()) continue;
        chosen.push_back(layers[i]);
        places.push_back(i);
    }
    const int width = info_.data.width(), height = info_.data.height();
    const bool wants_all = settings_.pictures == PictureWish::kAll;
    std::vector<Canvases> canvases;
    for (std::size_t i = 0; wants_all && i < std::min(chosen.size(), kLargestPictures); ++i)
        canvases.emplace_back(width, height);
    for (const std::size_t place : places)
        reports[place].worst_pictures.resize(wants_all ? reports[place].worst.size() : 0);
    std::vector<HeatCanvas> heats(chosen.size(), HeatCanvas(width, height));
    if (!chosen.empty())
        for_each_tile(
            chosen, {}, {},
            [&](const TileContext& context, std::size_t layer, int, const TileRect& rect) {
                const TilePictures drawn = draw_tile(context, rect);
                heats[layer].place(drawn.heat, rect);
                if (wants_all) crop_worst(drawn, rect, reports[places[layer]]);
                if (layer >= canvases.size()) return;
                canvases[layer].reference.place(drawn.reference, rect.x0, rect.y0);
                canvases[layer].test.place(drawn.test, rect.x0, rect.y0);
            });
    HeatCanvas all(width, height);
    for (const HeatCanvas& each : heats) all.add(each);
    if (heat != nullptr) *heat = all.picture();
    for (std::size_t i = 0; i < canvases.size(); ++i) {
        reports[places[i]].pictures = {canvases[i].reference.picture(), canvases[i].test.picture(),
                                       heats[i].picture()};
        reports[places[i]].reduction = canvases[i].reference.reduction();
    }
}

std::vector<LayerReport> PartComparison::run(std::vector<LayerPair> layers,
                                             std::optional<image::Picture>* heat) {
    std::vector<std::vector<Block>> blocks(layers.size());
    const std::vector<TileSums> totals =
        measure(layers, without_hdr(settings_.metrics), {}, &blocks);
    std::vector<LayerReport> reports;
    for (std::size_t i = 0; i < layers.size(); ++i)
        reports.push_back(to_report(layers[i], totals[i], std::move(blocks[i])));
    measure_hdr(layers, reports);
    if (settings_.pictures != PictureWish::kNone) draw(layers, reports, heat);
    return reports;
}

}  // namespace penumbra::diff
