#include "apps/diff/part_pictures.h"

#include <algorithm>

namespace penumbra::diff {
namespace {

constexpr std::size_t kLargestPictures = 4;  // layers whose pictures a report shows

// The three pictures of a layer.
struct Canvases {
    PictureCanvas reference, test;
    HeatCanvas heat;
    explicit Canvases(const image::Window& data)
        : reference(data.width(), data.height()),
          test(data.width(), data.height()),
          heat(data, reference.reduction()) {}

    void place(const TilePictures& drawn, const TileRect& tile, int x0, int y0) {
        reference.place(drawn.reference, tile.x0, tile.y0);
        test.place(drawn.test, tile.x0, tile.y0);
        heat.place(drawn.heat, tile, x0, y0);
    }
};

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

}  // namespace

void draw_part(const PartTiles& tiles, const std::vector<LayerPair>& layers,
               std::vector<LayerReport>& reports, HeatCanvas& all) {
    std::vector<LayerPair> chosen;
    std::vector<LayerReport*> targets;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (!reports[i].differs()) continue;
        chosen.push_back(layers[i]);
        targets.push_back(&reports[i]);
    }
    if (chosen.empty()) return;
    const bool wants_all = tiles.settings().pictures == PictureWish::kAll;
    const image::Window& data = tiles.info().data;
    std::vector<Canvases> canvases;
    for (std::size_t i = 0; wants_all && i < std::min(chosen.size(), kLargestPictures); ++i)
        canvases.emplace_back(data);
    for (LayerReport* target : targets)
        target->worst_pictures.resize(wants_all ? target->worst.size() : 0);
    tiles.for_each(chosen, {}, {},
                   [&](const TileContext& context, std::size_t layer, int, const TileRect& rect) {
                       const TilePictures drawn = draw_tile(context, rect);
                       all.place(drawn.heat, rect, data.x0, data.y0);
                       if (wants_all) crop_worst(drawn, rect, *targets[layer]);
                       if (layer < canvases.size())
                           canvases[layer].place(drawn, rect, data.x0, data.y0);
                   });
    for (std::size_t i = 0; i < canvases.size(); ++i) {
        targets[i]->reduction = canvases[i].reference.reduction();
        targets[i]->pictures = {canvases[i].reference.take(), canvases[i].test.take(),
                                canvases[i].heat.picture()};
    }
}

}  // namespace penumbra::diff
