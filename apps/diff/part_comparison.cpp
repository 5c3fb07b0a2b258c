#include "apps/diff/part_comparison.h"

#include <algorithm>

#include "apps/diff/exposure_survey.h"
#include "apps/diff/part_pictures.h"

namespace penumbra::diff {
namespace {

constexpr std::size_t kWorstTiles = 6;

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

MetricSet without_hdr(MetricSet metrics) {
    metrics.remove(Metric::kHdrFlip);
    return metrics;
}

struct Measurement {
    TileSums sums;
    std::vector<Block> blocks;  // that differ
};

// Sums are added in the order of the tiles, whoever measured them.
std::vector<Measurement> measure(const PartTiles& tiles, const std::vector<LayerPair>& layers,
                                 MetricSet metrics,
                                 const std::vector<compare::Exposures>& exposures) {
    const auto count = static_cast<std::size_t>(tiles.count());
    std::vector<std::vector<TileSums>> sums(layers.size());
    for (auto& each : sums) each.resize(count);
    std::vector<TileRect> rects(count);
    tiles.for_each(
        layers, metrics, exposures,
        [&](const TileContext& context, std::size_t layer, int tile, const TileRect& rect) {
            sums[layer][static_cast<std::size_t>(tile)] = measure_tile(context, rect);
            if (layer == 0) rects[static_cast<std::size_t>(tile)] = rect;
        });
    std::vector<Measurement> results(layers.size());
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
        results[layer].sums.differing.resize(layers[layer].test_channels.size());
        for (std::size_t i = 0; i < count; ++i) {
            results[layer].sums.add(sums[layer][i]);
            append_blocks(sums[layer][i], rects[i], results[layer].blocks);
        }
    }
    return results;
}

void report_channels(const LayerPair& layer, const TileSums& sums, const SourcePart& part,
                     LayerReport& report) {
    for (std::size_t i = 0; i < sums.differing.size(); ++i) {
        const SourceChannel& channel =
            part.channels[static_cast<std::size_t>(layer.reference.channels[i])];
        const bool is_colour =
            std::find(layer.reference.colour.begin(), layer.reference.colour.end(),
                      static_cast<int>(i)) != layer.reference.colour.end();
        report.channels.push_back({channel.name, channel.type, is_colour, sums.differing[i]});
    }
}

void report_metrics(const TileSums& sums, const PartTiles& tiles, LayerReport& report) {
    const auto set = [&](Metric metric, double value) {
        if (tiles.settings().metrics.has(metric)) report.metrics[metric] = value;
    };
    const auto pixels = static_cast<double>(sums.pixels);
    set(Metric::kMax, sums.errors.largest);
    set(Metric::kMae, sums.errors.mae());
    set(Metric::kRmse, sums.errors.rmse());
    set(Metric::kRelmse, sums.errors.relmse());
    set(Metric::kPixels, static_cast<double>(sums.exceeding));
    set(Metric::kShare, sums.pixels == 0 ? 0 : static_cast<double>(sums.exceeding) / pixels);
    if (!report.is_colour) return;
    set(Metric::kPsnr, sums.coded.psnr());
    // Where the mask leaves no whole window, nothing is known against the test.
    set(Metric::kSsim, sums.ssim.count == 0 ? 1 : sums.ssim.mean());
    set(Metric::kFlip, sums.flip.mean());
    if (!tiles.is_display_coded()) set(Metric::kHdrFlip, 0);
}

LayerReport to_report(const LayerPair& layer, Measurement measured, const PartTiles& tiles) {
    LayerReport report;
    report.name = layer.reference.name;
    report.is_colour = layer.reference.is_colour();
    report.pixels = measured.sums.pixels;
    report.reference = measured.sums.reference;
    report.test = measured.sums.test;
    report_channels(layer, measured.sums, tiles.info(), report);
    report_metrics(measured.sums, tiles, report);
    keep_worst(measured.blocks, kWorstTiles);
    report.worst = std::move(measured.blocks);
    return report;
}

// Only layers whose colours differ are looked at: three more passes over the reference and one over
// the test.
void measure_hdr(const PartTiles& tiles, const std::vector<LayerPair>& layers,
                 std::vector<LayerReport>& reports) {
    if (!tiles.settings().metrics.has(Metric::kHdrFlip) || tiles.is_display_coded()) return;
    std::vector<LayerPair> chosen;
    std::vector<LayerReport*> targets;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (!reports[i].is_colour || !reports[i].differs()) continue;
        chosen.push_back(layers[i]);
        targets.push_back(&reports[i]);
    }
    if (chosen.empty()) return;
    MetricSet metrics;
    metrics.add(Metric::kHdrFlip);
    const auto measured = measure(tiles, chosen, metrics, survey_exposures(tiles, chosen));
    for (std::size_t i = 0; i < chosen.size(); ++i)
        targets[i]->metrics[Metric::kHdrFlip] = measured[i].sums.hdr_flip.mean();
}

}  // namespace

std::vector<LayerReport> compare_part(const PartTiles& tiles, const std::vector<LayerPair>& layers,
                                      HeatCanvas* heat) {
    std::vector<Measurement> measured =
        measure(tiles, layers, without_hdr(tiles.settings().metrics), {});
    std::vector<LayerReport> reports;
    for (std::size_t i = 0; i < layers.size(); ++i)
        reports.push_back(to_report(layers[i], std::move(measured[i]), tiles));
    measure_hdr(tiles, layers, reports);
    if (heat != nullptr) draw_part(tiles, layers, reports, *heat);
    return reports;
}

}  // namespace penumbra::diff
