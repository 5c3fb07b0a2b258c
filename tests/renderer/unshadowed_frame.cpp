#include "tests/renderer/unshadowed_frame.h"

#include <algorithm>

#include "apps/renderer/settings.h"
#include "apps/renderer/tile_scratch.h"
#include "core/error.h"
#include "core/parallel/tiles.h"
#include "raster/resolve.h"
#include "shadow/accumulate.h"
#include "shadow/draw_lights.h"
#include "shadow/lights.h"

namespace penumbra::tests {
namespace {

using renderer::TileScratch;

// What all tiles of a frame read.
struct Frame {
    const UnshadowedSettings& settings;
    FrameContext context;
    PixelRect crop;
    SceneView view;
    raster::Geometry geometry;
    std::vector<float> offset_scales;  // rays are not traced: where they start does not matter
};

void prepare(const Scene& scene, const parallel::Arena& arena, Frame& frame) {
    evaluate(scene, times_of_frame(scene.animation, frame.settings.frame),
             {.width = frame.settings.width, .height = frame.settings.height}, frame.view);
    raster::prepare(frame.view, frame.context, frame.crop, arena, frame.geometry);
    frame.offset_scales.assign(std::max<std::size_t>(frame.view.instances.size(), 1), 0.0f);
}

// Leaves the G-buffer, the tile's lights and U in scratch.
void shade_tile(const Frame& frame, const Tile& tile, TileScratch& s) {
    const FrameContext& context = frame.context;
    raster::rasterize(frame.view, frame.geometry, tile, context.isa, s.raster, s.visibility());
    raster::resolve(frame.view, frame.geometry, context, tile, s.visibility(), s.surface());
    shadow::draw_lights(frame.view, context, tile, s.surface());
    const ConstSurfaceView surface = to_const(s.surface());
    shadow::cull_lights(frame.view, context, surface, renderer::ImageSettings{}.light_tolerance,
                        s.lights);
    shadow::shade(frame.view, s.lights, frame.settings.accuracy, context, surface, s.sums());
}

// Leaves the U_N of one set of rays in scratch.
void sample_set(const Frame& frame, const Tile& tile, std::uint32_t seed, TileScratch& s) {
    shadow::RayInputs inputs{.frame = frame.context,
                             .tile = tile,
                             .eye = frame.view.camera.eye,
                             .surface = to_const(s.surface()),
                             .offset_scales = frame.offset_scales};
    inputs.frame.seed = seed;
    s.clear_samples();
    for (const std::uint32_t light : s.lights.kept()) {
        for (int sample = 0; sample < kRaysPerSet; ++sample) {
            shadow::generate_rays(inputs,
                                  {.lights = frame.view.lights.view(),
                                   .light = light,
                                   .index = sample,
                                   .count = kRaysPerSet},
                                  s.rays);
            shadow::accumulate(s.rays, frame.context.isa, s.sums());
        }
    }
}

// One worker's memory.
struct Scratch {
    TileScratch tile;
    std::array<std::vector<double>, 3> totals;  // of a batch's sets of rays
};

template <class Body>
void each_tile_pixel(const Body& body) {
    for (int y = 0; y < kTileSize; ++y)
        for (int x = 0; x < kTileSize; ++x) body(x, y, static_cast<std::size_t>(y * kTileSize + x));
}

template <class T, class Value>
void write_tile(const Frame& frame, const Tile& tile, Plane<T>& plane, const Value& value) {
    const PlaneView<T> corner =
        plane.view().offset(tile.x0 - frame.crop.x0, tile.y0 - frame.crop.y0);
    each_tile_pixel([&](int x, int y, std::size_t i) { corner.at(x, y) = value(x, y, i); });
}

void sample_batch(const Frame& frame, const Tile& tile, std::uint32_t first_seed, int sets,
                  Scratch& s) {
    for (std::vector<double>& total : s.totals) total.assign(shadow::kTilePixels, 0.0);
    for (int set = 0; set < sets; ++set) {
        sample_set(frame, tile, first_seed + static_cast<std::uint32_t>(set), s.tile);
        const PlaneView3<float> sums = s.tile.sums().unshadowed_samples;
        for (std::size_t c = 0; c < 3; ++c)
            each_tile_pixel([&](int x, int y, std::size_t i) {
                s.totals[c][i] += static_cast<double>(sums[c].at(x, y));
            });
    }
}

void sample_tile(const Frame& frame, const Tile& tile, Scratch& s, UnshadowedFrame& result) {
    const int lights = std::max(static_cast<int>(s.tile.lights.kept().size()), 1);
    const int sets = std::max(frame.settings.rays_per_batch / (kRaysPerSet * lights), 1);
    std::uint32_t seed = frame.settings.seed;
    for (Plane3<float>& batch : result.sampled) {
        sample_batch(frame, tile, seed, sets, s);
        seed += static_cast<std::uint32_t>(sets);
        for (std::size_t c = 0; c < 3; ++c)
            write_tile(frame, tile, batch[c], [&](int, int, std::size_t i) {
                return static_cast<float>(s.totals[c][i] / sets);
            });
    }
}

void write_surface(const Frame& frame, const Tile& tile, TileScratch& s, UnshadowedFrame& result) {
    const SurfaceView surface = s.surface();
    const LightSumsView sums = s.sums();
    for (std::size_t c = 0; c < 3; ++c)
        write_tile(frame, tile, result.analytic[c], [&](int x, int y, std::size_t) {
            return sums.unshadowed_diffuse[c].at(x, y) + sums.unshadowed_glossy[c].at(x, y);
        });
    write_tile(frame, tile, result.material,
               [&](int x, int y, std::size_t) { return surface.material.at(x, y); });
    const auto vector = [](const PlaneView3<float>& planes, int x, int y) {
        return Vec3f{planes[0].at(x, y), planes[1].at(x, y), planes[2].at(x, y)};
    };
    write_tile(frame, tile, result.cos_view, [&](int x, int y, std::size_t) {
        const Vec3f to_eye = frame.view.camera.eye - vector(surface.position, x, y);
        return dot(vector(surface.normal, x, y), normalize(to_eye));
    });
}

UnshadowedFrame empty_frame(const PixelRect& crop, int batches) {
    const int width = crop.width();
    const int height = crop.height();
    UnshadowedFrame result{.width = width,
                           .height = height,
                           .analytic = make_plane3<float>(width, height),
                           .sampled = {},
                           .cos_view = Plane<float>(width, height),
                           .material = Plane<std::uint32_t>(width, height)};
    for (int i = 0; i < batches; ++i) result.sampled.push_back(make_plane3<float>(width, height));
    return result;
}

}  // namespace

UnshadowedFrame render_unshadowed(const Scene& scene, const UnshadowedSettings& settings) {
    const int width = settings.width;
    const int height = settings.height;
    const parallel::Arena arena(settings.threads);
    Frame frame{.settings = settings,
                .context = {.width = width,
                            .height = height,
                            .frame = settings.frame,
                            .isa = simd::best_isa()},
                .crop = settings.crop.value_or(PixelRect{.x1 = width, .y1 = height}),
                .view = {},
                .geometry = {},
                .offset_scales = {}};
    PENUMBRA_ASSERT(frame.crop.x0 % kTileSize == 0 && frame.crop.y0 % kTileSize == 0, "{}, {}",
                    frame.crop.x0, frame.crop.y0);
    prepare(scene, arena, frame);
    UnshadowedFrame result = empty_frame(frame.crop, settings.batches);
    std::vector<Scratch> scratch(static_cast<std::size_t>(arena.threads()));
    parallel::for_each_tile(arena, parallel::TileGrid(frame.crop), {},
                            [&](const Tile& tile, int worker) {
                                Scratch& s = scratch[static_cast<std::size_t>(worker)];
                                shade_tile(frame, tile, s.tile);
                                write_surface(frame, tile, s.tile, result);
                                sample_tile(frame, tile, s, result);
                            });
    return result;
}

}  // namespace penumbra::tests
