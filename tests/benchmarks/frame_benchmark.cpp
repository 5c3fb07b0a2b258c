// Measures the passes of a frame against bare Embree in the same run: the same primary rays, and
// exactly the frame's shadow rays. Ours and theirs take turns; medians.
//
//     frame_benchmark SCENE [PAIRS] [THREADS] [LIGHTS]
//
// 1920 x 1080, 1 ray per light and pixel; of the scene's lights the first LIGHTS, by default 1.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <vector>

#include "apps/renderer/renderer.h"
#include "apps/renderer/tile_scratch.h"
#include "core/parallel/tiles.h"
#include "core/scene/read_scene.h"
#include "raster/resolve.h"
#include "shadow/draw_lights.h"
#include "tests/benchmarks/bare_embree.h"

using namespace penumbra;

namespace {

constexpr int kWidth = 1920;
constexpr int kHeight = 1080;
constexpr int kSquare =
    4;  // pixels of a tile in squares along a Z curve, as the shadow pass orders them

template <class Body>
void each_pixel_in_z_order(const Body& body) {
    constexpr int kSide = kTileSize / kSquare;
    for (unsigned i = 0; i < kSide * kSide; ++i) {
        unsigned sx = 0;
        unsigned sy = 0;
        for (unsigned bit = 0; bit < 4; ++bit) {
            sx |= (i >> (2 * bit) & 1u) << bit;
            sy |= (i >> (2 * bit + 1) & 1u) << bit;
        }
        for (int y = 0; y < kSquare; ++y)
            for (int x = 0; x < kSquare; ++x)
                body(static_cast<int>(sx) * kSquare + x, static_cast<int>(sy) * kSquare + y);
    }
}

benchmarks::RayBatch primary_rays(const Camera& camera, const Tile& tile) {
    benchmarks::RayBatch batch;
    each_pixel_in_z_order([&](int x, int y) {
        if (tile.x0 + x >= kWidth || tile.y0 + y >= kHeight) return;
        const Vec3f direction = camera.direction(static_cast<float>(tile.x0 + x) + 0.5f,
                                                 static_cast<float>(tile.y0 + y) + 0.5f);
        batch.add(camera.eye, direction, std::numeric_limits<float>::infinity());
    });
    batch.pad();
    return batch;
}

void add_active(const shadow::RayScratch& rays, benchmarks::RayBatch& batch) {
    each_pixel_in_z_order([&](int x, int y) {
        if (!(rays.active[static_cast<std::size_t>(y)] >> x & 1u)) return;
        const auto vector = [&](const Plane3<float>& p) {
            return Vec3f{p[0].at(x, y), p[1].at(x, y), p[2].at(x, y)};
        };
        batch.add(vector(rays.origin), vector(rays.direction), rays.range.at(x, y));
    });
}

// Exactly the shadow rays of the frame: the tile passes once more, keeping the rays.
struct Workload {
    SceneView view;
    std::vector<benchmarks::RayBatch> primary, shadow;
    std::size_t shadow_rays = 0;
    std::size_t covered_pixels = 0;
};

void prepare_workload(const Scene& scene, const parallel::Arena& arena, Workload& work) {
    const FrameContext context{
        .width = kWidth, .height = kHeight, .frame = 1, .isa = simd::best_isa()};
    evaluate(scene, times_of_frame(scene.animation, 1), {.width = kWidth, .height = kHeight},
             work.view);
    shadow::Occluders occluders(arena, shadow::TraceIsa::kAvx2);
    occluders.update(work.view);
    shadow::LightSet lights;
    shadow::prepare_lights(work.view, lights);
    raster::Geometry geometry;
    const parallel::TileGrid grid({.x0 = 0, .y0 = 0, .x1 = kWidth, .y1 = kHeight});
    raster::prepare(work.view, context, grid.window, arena, geometry);
    renderer::TileScratch scratch;
    for (int i = 0; i < grid.count(); ++i) {
        const Tile tile = grid.tile(i);
        raster::rasterize(work.view, geometry, tile, context.isa, scratch.raster,
                          scratch.visibility());
        raster::resolve(work.view, geometry, context, tile, scratch.visibility(),
                        scratch.surface());
        shadow::draw_lights(lights, work.view, context, tile, scratch.surface());
        const ConstSurfaceView surface = to_const(scratch.surface());
        shadow::cull_lights(lights, work.view, context, surface, 1.0f / 1024, scratch.lights);
        benchmarks::RayBatch batch;
        for (const std::uint32_t light : scratch.lights.kept()) {
            shadow::generate_rays(
                {.frame = context,
                 .tile = tile,
                 .eye = work.view.camera.eye,
                 .surface = surface,
                 .offset_scales = occluders.offset_scales()},
                {.light = &work.view.lights[light], .light_index = light, .index = 0, .count = 1},
                scratch.rays);
            add_active(scratch.rays, batch);
        }
        batch.pad();
        work.shadow_rays += static_cast<std::size_t>(batch.count);
        work.primary.push_back(primary_rays(work.view.camera, tile));
        work.shadow.push_back(std::move(batch));
        each_pixel_in_z_order([&](int x, int y) {
            if (tile.x0 + x < kWidth && tile.y0 + y < kHeight)
                work.covered_pixels += surface.depth.at(x, y) < kDepthOfNothing;
        });
    }
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(),
                     values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

struct Samples {
    std::vector<double> g_buffer, shadow, shade, rays, trace, filter, frame, evaluate;
    std::vector<double> bare_primary, bare_shadow;
    std::vector<double> ratio_g_buffer, excess_shadow;
};

// Tile passes are measured in seconds of all threads; their share of the tiles' wall clock is what
// they cost a frame.
double tile_share(const renderer::FrameStatistics& s,
                  std::initializer_list<renderer::Pass> passes) {
    double all = 0;
    double some = 0;
    for (int i = 0; i < renderer::kPassCount; ++i)
        if (renderer::is_tile_pass(static_cast<renderer::Pass>(i)))
            all += s.passes.seconds[static_cast<std::size_t>(i)];
    for (const renderer::Pass pass : passes) some += s.passes[pass];
    return s.tiles_wall_seconds * some / all;
}

template <class Time>
benchmarks::Call best_call(std::initializer_list<benchmarks::Call> calls, const Time& time) {
    benchmarks::Call best = *calls.begin();
    double best_seconds = std::numeric_limits<double>::infinity();
    for (const benchmarks::Call call : calls) {
        const double seconds = median({time(call), time(call), time(call)});
        if (seconds < best_seconds) {
            best_seconds = seconds;
            best = call;
        }
    }
    return best;
}

void run(const Scene& scene, int pairs, int threads) {
    using benchmarks::Call;
    using renderer::Pass;
    const parallel::Arena arena(threads);
    Workload work;
    prepare_workload(scene, arena, work);
    const benchmarks::BareEmbree bare(work.view, "avx2", threads);
    renderer::Renderer ours(scene, {.width = kWidth, .height = kHeight, .samples_per_pixel = 1},
                            {.threads = threads});
    renderer::Film film;
    ours.render(1, {renderer::Aov::kBeauty}, film);

    const Call primary_call =
        best_call({Call::kSingle, Call::kPacket8, Call::kPacket16},
                  [&](Call c) { return bare.intersect(work.primary, c, arena); });
    const Call shadow_call =
        best_call({Call::kSingle, Call::kPacket8, Call::kPacket16, Call::kStream},
                  [&](Call c) { return bare.occlude(work.shadow, c, arena); });
    Samples all;
    for (int i = 0; i < pairs; ++i) {
        const renderer::FrameStatistics s = ours.render(1, {renderer::Aov::kBeauty}, film);
        const double primary = bare.intersect(work.primary, primary_call, arena);
        const double shadow = bare.occlude(work.shadow, shadow_call, arena);
        all.g_buffer.push_back(s.passes[Pass::kSetup] +
                               tile_share(s, {Pass::kRasterize, Pass::kResolve}));
        all.shadow.push_back(tile_share(s, {Pass::kShade, Pass::kRays, Pass::kTrace}));
        all.shade.push_back(tile_share(s, {Pass::kShade}));
        all.rays.push_back(tile_share(s, {Pass::kRays}));
        all.trace.push_back(tile_share(s, {Pass::kTrace}));
        all.filter.push_back(s.passes[Pass::kNoise] + s.passes[Pass::kFilter]);
        all.evaluate.push_back(s.passes[Pass::kEvaluate]);
        all.frame.push_back(s.render_seconds);
        all.bare_primary.push_back(primary);
        all.bare_shadow.push_back(shadow);
        all.ratio_g_buffer.push_back(all.g_buffer.back() / primary);
        all.excess_shadow.push_back(all.shadow.back() - shadow);
    }

    const double pixels = static_cast<double>(kWidth) * kHeight;
    fmt::print("{} x {}, {} threads, {} pairs, {:.0f} % covered, {:.2f} Mrays of {} lights\n",
               kWidth, kHeight, threads, pairs,
               100.0 * static_cast<double>(work.covered_pixels) / pixels,
               1e-6 * static_cast<double>(work.shadow_rays), work.view.lights.size());
    const auto row = [](const char* what, const std::vector<double>& seconds,
                        const std::string& note) {
        fmt::print("{:<28} {:8.1f} ms  {}\n", what, 1e3 * median(seconds), note);
    };
    row("G-buffer", all.g_buffer,
        fmt::format("{:.2f} x the primary rays", median(all.ratio_g_buffer)));
    row("  bare primary rays", all.bare_primary, benchmarks::name(primary_call));
    row("shadow pass", all.shadow,
        fmt::format("the bare rays + {:.1f} ms", 1e3 * median(all.excess_shadow)));
    row("  shade", all.shade, "");
    row("  rays", all.rays, "");
    row("  trace", all.trace, "");
    row("  bare shadow rays", all.bare_shadow,
        fmt::format("{}, {:.1f} Mrays/s", benchmarks::name(shadow_call),
                    1e-6 * static_cast<double>(work.shadow_rays) / median(all.bare_shadow)));
    row("filter chain", all.filter, "");
    row("evaluate", all.evaluate, "");
    row("whole frame", all.frame,
        fmt::format("{:.1f} Mpixel/s", 1e-6 * pixels / median(all.frame)));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "usage: frame_benchmark SCENE [PAIRS] [THREADS] [LIGHTS]\n");
        return 2;
    }
    try {
        const int pairs = argc > 2 ? std::atoi(argv[2]) : 11;
        const int threads = argc > 3 ? std::atoi(argv[3]) : 2;
        const int lights = argc > 4 ? std::atoi(argv[4]) : 1;
        Scene scene = read_scene(argv[1]);
        scene.lights.resize(
            std::min(scene.lights.size(), static_cast<std::size_t>(std::max(lights, 0))));
        run(scene, std::max(pairs, 1), std::max(threads, 1));
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return 1;
    }
}
