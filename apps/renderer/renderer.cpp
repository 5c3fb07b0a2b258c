#include "apps/renderer/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "apps/renderer/deposit.h"
#include "apps/renderer/frame_passes.h"
#include "apps/renderer/jitter.h"
#include "apps/renderer/pass_clock.h"
#include "apps/renderer/tile_scratch.h"
#include "core/error.h"
#include "core/parallel/tiles.h"
#include "core/profile/stopwatch.h"
#include "raster/resolve.h"
#include "shadow/accumulate.h"
#include "shadow/draw_lights.h"
#include "shadow/lights.h"

namespace penumbra::renderer {
namespace {

// What one worker counts, on a cache line of its own.
struct alignas(64) WorkerCounts {
    PassClock clock;
    std::uint64_t shadow_rays = 0;
};

}  // namespace

ImageSettings completed(const Scene& scene, const ImageSettings& image) {
    ImageSettings all = image;
    if (all.width == 0) all.width = scene.width;
    if (all.height == 0) all.height = scene.height;
    if (all.samples_per_pixel == 0) all.samples_per_pixel = scene.samples_per_pixel;
    const Plan& plan = plan_of(all.method);
    if (!plan.needs_rays) all.denoise = Denoise::kNone;
    if (!all.denoise) all.denoise = plan.denoise;
    if (!all.crop) all.crop = PixelRect{.x0 = 0, .y0 = 0, .x1 = all.width, .y1 = all.height};
    return all;
}

// Depends on what pixels depend on, and never on the crop, which must not change one.
shadow::OccluderSettings occluder_settings(const ImageSettings& image,
                                           const ExecutionSettings& execution) {
    const std::size_t pixels =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    const auto rays_per_pixel = static_cast<std::size_t>(image.samples_per_pixel * image.passes);
    return {.isa = execution.trace_isa,
            .test = image.reproducible ? shadow::HitTest::kExact : shadow::HitTest::kEmbree,
            .kernels = execution.isa,
            .most_rebuilt = pixels * rays_per_pixel / shadow::kRaysPerRebuiltTriangle};
}

struct Renderer::State {
    const Scene& scene;
    ImageSettings image;
    ExecutionSettings execution;
    parallel::Arena arena;
    shadow::Occluders occluders;
    SceneView view;
    Camera camera;                                 // without jitter
    const std::atomic<bool>* cancelled = nullptr;  // of the frame that is rendered
    raster::Geometry geometry;
    FrameScratch frame_scratch;
    std::vector<TileScratch> scratch;  // one per worker
    std::vector<WorkerCounts> counts;  // one per worker

    State(const Scene& s, const ImageSettings& i, const ExecutionSettings& e)
        : scene(s),
          image(completed(s, i)),
          execution(e),
          arena(e.threads > 0 ? e.threads : parallel::default_thread_count()),
          occluders(arena, occluder_settings(image, e)),
          scratch(static_cast<std::size_t>(arena.threads())),
          counts(static_cast<std::size_t>(arena.threads())) {
        if (!execution.isa) execution.isa = simd::best_isa();
        arena.record(execution.profile);
    }

    [[nodiscard]] bool is_cancelled() const { return cancelled != nullptr && cancelled->load(); }
    void evaluate_at(int frame, FrameStatistics& statistics);
    void render_tiles(int pass, const FrameContext& context, Film& film,
                      FrameStatistics& statistics);
    void render_tile(const Tile& tile, const FrameContext& context, int worker, Film& film);
    void trace_lights(const Tile& tile, const FrameContext& context, TileScratch& tile_scratch,
                      WorkerCounts& count);
};

void Renderer::State::evaluate_at(int frame, FrameStatistics& statistics) {
    const FramePass evaluation(Pass::kEvaluate, execution.profile, statistics);
    evaluate(scene, times_of_frame(scene.animation, frame),
             {.width = image.width, .height = image.height}, view);
    camera = view.camera;
    if (plan_of(image.method).needs_occluders) occluders.update(view);
}

// S_N and U_N: one ray per pixel, light and sample at a time, so that rays fit the cache.
void Renderer::State::trace_lights(const Tile& tile, const FrameContext& context,
                                   TileScratch& tile_scratch, WorkerCounts& count) {
    const shadow::RayInputs inputs{.frame = context,
                                   .tile = tile,
                                   .eye = view.camera.eye,
                                   .surface = to_const(tile_scratch.surface()),
                                   .offset_scales = occluders.offset_scales()};
    for (const std::uint32_t light : tile_scratch.lights.kept()) {
        if (is_cancelled()) return;
        for (int sample = 0; sample < image.samples_per_pixel; ++sample) {
            shadow::generate_rays(inputs,
                                  {.lights = view.lights.view(),
                                   .light = light,
                                   .index = sample,
                                   .count = image.samples_per_pixel},
                                  tile_scratch.rays);
            if (execution.on_rays) (*execution.on_rays)(tile, tile_scratch.rays);
            count.clock.end(Pass::kRays);
            shadow::trace(occluders, execution.visibility, tile_scratch.rays);
            const std::uint64_t traced = tile_scratch.rays.count_active();
            count.clock.end(Pass::kTrace, {"rays", static_cast<std::int64_t>(traced)});
            shadow::accumulate(tile_scratch.rays, context.isa, tile_scratch.sums());
            count.clock.end(Pass::kRays);
            count.shadow_rays += traced;
        }
    }
}

// All that happens to a tile, in cache.
void Renderer::State::render_tile(const Tile& tile, const FrameContext& context, int worker,
                                  Film& film) {
    TileScratch& s = scratch[static_cast<std::size_t>(worker)];
    WorkerCounts& count = counts[static_cast<std::size_t>(worker)];
    count.clock.begin_tile(tile);

    raster::rasterize(view, geometry, tile, context.isa, s.raster, s.visibility());
    count.clock.end(Pass::kRasterize);

    raster::resolve(view, geometry, context, tile, s.visibility(), s.surface());
    shadow::draw_lights(view, context, tile, s.surface());
    count.clock.end(Pass::kResolve);

    const ConstSurfaceView surface = to_const(s.surface());
    shadow::cull_lights(view, context, surface, image.light_tolerance, s.lights);
    shadow::shade(view, s.lights, image.unshadowed, context, surface, s.sums());
    count.clock.end(Pass::kShade);

    s.clear_samples();
    if (plan_of(image.method).needs_rays) trace_lights(tile, context, s, count);

    deposit({tile, context.pass, surface, to_const(s.sums()), view.camera}, film);
    count.clock.end(Pass::kDeposit);
}

void Renderer::State::render_tiles(int pass, const FrameContext& context, Film& film,
                                   FrameStatistics& statistics) {
    {
        const FramePass setup(Pass::kSetup, execution.profile, statistics);
        jitter(camera, pass, image.passes, view.camera);
        raster::prepare(view, context, film.window, arena, geometry);
    }
    const profile::Phase tiles(execution.profile, "tiles");
    const profile::Stopwatch watch;
    const parallel::TileGrid grid(film.window);
    parallel::for_each_tile(
        arena, grid, execution.tile_order,
        [&](const Tile& tile, int worker) { render_tile(tile, context, worker, film); }, cancelled);
    statistics.tiles_wall_seconds += watch.seconds();
}

Renderer::Renderer(const Scene& scene, const ImageSettings& image,
                   const ExecutionSettings& execution) {
    check_settings(scene, image, execution);
    state_ = std::make_unique<State>(scene, image, execution);
}
Renderer::~Renderer() = default;

const Camera& Renderer::camera() const {
    return state_->camera;
}
int Renderer::threads() const {
    return state_->arena.threads();
}

FrameStatistics Renderer::render(int frame, AovSet wanted, Film& film,
                                 const std::atomic<bool>* cancelled) {
    State& s = *state_;
    s.cancelled = cancelled;
    FrameStatistics statistics;
    if (s.execution.profile) s.execution.profile->make_room();
    const profile::Phase phase(s.execution.profile, "frame", {"frame", frame});
    const profile::Stopwatch whole;
    s.evaluate_at(frame, statistics);

    prepare_film(s.image.width, s.image.height, *s.image.crop, frame_margin(s.image), wanted, film);
    for (int worker = 0; worker < s.arena.threads(); ++worker)
        s.counts[static_cast<std::size_t>(worker)] = {.clock = PassClock(s.execution, worker)};
    FrameContext context{.width = s.image.width,
                         .height = s.image.height,
                         .frame = frame,
                         .seed = s.image.seed,
                         .isa = *s.execution.isa};
    for (int pass = 0; pass < s.image.passes; ++pass) {
        context.pass = pass;
        s.render_tiles(pass, context, film, statistics);
    }
    if (!s.is_cancelled())
        finish_frame({s.image, context, s.camera, s.arena, s.execution.profile}, s.frame_scratch,
                     film, statistics);

    for (const WorkerCounts& count : s.counts) {
        statistics.passes += count.clock.seconds();
        statistics.shadow_rays += count.shadow_rays;
    }
    for (const Instance& instance : s.view.instances)
        statistics.triangles += instance.mesh->triangles.size();
    statistics.render_seconds = whole.seconds();
    return statistics;
}

void check_settings(const Scene& scene, const ImageSettings& image,
                    const ExecutionSettings& execution) {
    const ImageSettings all = completed(scene, image);
    const PixelRect& crop = *all.crop;
    if (crop.empty() || crop.x0 < 0 || crop.y0 < 0 || crop.x1 > all.width || crop.y1 > all.height)
        throw InputError(
            fmt::format("--crop: expected a part of the {} x {} picture, got {},{},{},{}",
                        all.width, all.height, crop.x0, crop.y0, crop.x1, crop.y1));
    if (execution.isa && !simd::is_supported(*execution.isa))
        throw InputError(
            fmt::format("--isa: this processor does not support {}", simd::name(*execution.isa)));
    static_cast<void>(simd::best_isa());
}

}  // namespace penumbra::renderer
