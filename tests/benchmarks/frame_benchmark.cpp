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

#include "apps/bench/report.h"
#include "apps/bench/workload.h"
#include "apps/renderer/renderer.h"
#include "core/profile/stopwatch.h"
#include "core/scene/read_scene.h"
#include "shadow/bare_rays.h"

using namespace penumbra;

namespace {

constexpr int kWidth = 1920;
constexpr int kHeight = 1080;

double median(std::vector<double> values) {
    return bench::summarize(std::move(values)).median;
}

// Embree by itself: seconds for all tiles.
class Bare {
  public:
    Bare(const bench::Workload& work, const parallel::Arena& arena)
        : work_(work),
          arena_(arena),
          rays_(work.view, shadow::TraceIsa::kAvx2, arena),
          scratch_(static_cast<std::size_t>(arena.threads())) {}

    double intersect(shadow::RayCall call) {
        return seconds(work_.primary, [&](const shadow::RayBatch& batch, std::size_t) {
            rays_.intersect(batch, call);
        });
    }
    double occlude(shadow::RayCall call) {
        return seconds(work_.shadow, [&](const shadow::RayBatch& batch, std::size_t worker) {
            rays_.occlude(batch, call, scratch_[worker]);
        });
    }

  private:
    template <class Body>
    double seconds(const std::vector<shadow::RayBatch>& batches, const Body& body) {
        const profile::Stopwatch watch;
        arena_.for_each(static_cast<int>(batches.size()), [&](int index, int worker) {
            body(batches[static_cast<std::size_t>(index)], static_cast<std::size_t>(worker));
        });
        return watch.seconds();
    }

    const bench::Workload& work_;
    const parallel::Arena& arena_;
    shadow::BareRays rays_;
    std::vector<shadow::RayCallScratch> scratch_;
};

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
shadow::RayCall best_call(const std::vector<shadow::RayCall>& calls, const Time& time) {
    shadow::RayCall best = calls.front();
    double best_seconds = std::numeric_limits<double>::infinity();
    for (const shadow::RayCall call : calls) {
        const double seconds = median({time(call), time(call), time(call)});
        if (seconds < best_seconds) {
            best_seconds = seconds;
            best = call;
        }
    }
    return best;
}

void run(const Scene& scene, int pairs, int threads) {
    using renderer::Pass;
    const parallel::Arena arena(threads);
    const renderer::ImageSettings image{.width = kWidth, .height = kHeight, .samples_per_pixel = 1};
    const bench::Workload work = bench::record_workload(scene, image, {.threads = threads}, 1);
    Bare bare(work, arena);
    renderer::Renderer ours(scene, image, {.threads = threads});
    renderer::Film film;
    ours.render(1, {renderer::Aov::kBeauty}, film);

    const shadow::RayCall primary_call =
        best_call(shadow::intersect_calls(), [&](shadow::RayCall c) { return bare.intersect(c); });
    const shadow::RayCall shadow_call =
        best_call(shadow::occlude_calls(), [&](shadow::RayCall c) { return bare.occlude(c); });
    Samples all;
    for (int i = 0; i < pairs; ++i) {
        const renderer::FrameStatistics s = ours.render(1, {renderer::Aov::kBeauty}, film);
        const double primary = bare.intersect(primary_call);
        const double shadow = bare.occlude(shadow_call);
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
    row("  bare primary rays", all.bare_primary, shadow::name(primary_call));
    row("shadow pass", all.shadow,
        fmt::format("the bare rays + {:.1f} ms", 1e3 * median(all.excess_shadow)));
    row("  shade", all.shade, "");
    row("  rays", all.rays, "");
    row("  trace", all.trace, "");
    row("  bare shadow rays", all.bare_shadow,
        fmt::format("{}, {:.1f} Mrays/s", shadow::name(shadow_call),
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
