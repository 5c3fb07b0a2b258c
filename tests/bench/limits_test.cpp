#include <doctest/doctest.h>

#include "apps/bench/limits.h"
#include "apps/bench/machine.h"
#include "apps/renderer/builtin_scene.h"
#include "shadow/bare_rays.h"

using namespace penumbra;
using namespace penumbra::bench;

namespace {

constexpr renderer::ImageSettings kImage{.width = 200, .height = 120};

const Scene& scene() {
    static const Scene kScene = renderer::read_builtin_scene();
    return kScene;
}

std::uint64_t count(const std::vector<shadow::RayBatch>& batches) {
    std::uint64_t rays = 0;
    for (const shadow::RayBatch& batch : batches) rays += static_cast<std::uint64_t>(batch.count);
    return rays;
}

}  // namespace

TEST_CASE("the kept shadow rays are those that the renderer counts") {
    const Workload work = record_workload(scene(), kImage, {.threads = 2}, 1);
    renderer::Renderer renderer(scene(), kImage, {.threads = 1});
    renderer::Film film;
    const renderer::FrameStatistics frame = renderer.render(1, {renderer::Aov::kBeauty}, film);
    CHECK(work.shadow_rays == frame.shadow_rays);
    CHECK(count(work.shadow) == frame.shadow_rays);
    CHECK(work.shadow_scale == 1);
    CHECK(work.triangles == frame.triangles);
}

TEST_CASE("there is one primary ray per pixel of the picture") {
    CHECK(count(record_workload(scene(), kImage, {.threads = 2}, 1).primary) == 200 * 120);
}

TEST_CASE("where rays would fill the memory a part of them stands for all") {
    const Workload all = record_workload(scene(), kImage, {.threads = 2}, 1);
    const Workload some = record_workload(scene(), kImage, {.threads = 2}, 1, 1 << 20);
    CHECK(some.shadow_rays == all.shadow_rays);
    CHECK(count(some.shadow) < all.shadow_rays);
    CHECK(some.shadow_scale * static_cast<double>(count(some.shadow)) ==
          doctest::Approx(static_cast<double>(all.shadow_rays)));
}

TEST_CASE("all calls of the bare ray tracer find the same") {
    const parallel::Arena arena(2);
    const Workload work = record_workload(scene(), kImage, {.threads = 2}, 1);
    const shadow::BareRays bare(work.view, shadow::TraceIsa::kAvx2, arena);
    shadow::RayCallScratch scratch;
    int covered = 0;
    for (const shadow::RayBatch& batch : work.primary)
        covered += bare.intersect(batch, shadow::RayCall::kSingle);
    CHECK(static_cast<double>(covered) ==
          doctest::Approx(static_cast<double>(work.covered_pixels)).epsilon(0.02));
    for (const shadow::RayBatch& batch : work.shadow) {
        const int expected = bare.occlude(batch, shadow::RayCall::kSingle, scratch);
        CHECK(expected <= batch.count);
        for (const shadow::RayCall call : shadow::occlude_calls())
            CHECK(bare.occlude(batch, call, scratch) == doctest::Approx(expected).epsilon(1e-3));
    }
}

TEST_CASE("demands grow with pixels, rays and triangles") {
    const Workload small = record_workload(scene(), {.width = 64, .height = 64}, {}, 1);
    const Workload large = record_workload(scene(), {.width = 128, .height = 128}, {}, 1);
    const auto of = [](renderer::Pass pass, const Workload& work) {
        return demand(renderer::info(pass), work);
    };
    using renderer::Pass;
    CHECK(of(Pass::kFilter, large) == 4 * of(Pass::kFilter, small));
    CHECK(of(Pass::kSetup, large) == of(Pass::kSetup, small));
    CHECK(of(Pass::kSetup, small) == 12 * small.vertices + 16 * small.triangles);
    CHECK(of(Pass::kShade, small) == 58 * small.shaded_vertices + 32 * small.shaded_pairs);
    CHECK(of(Pass::kRays, small) == 100 * small.shadow_rays);
    CHECK(of(Pass::kRays, large) > 3 * of(Pass::kRays, small));
    CHECK(of(Pass::kDeposit, small) == 64 * 64 * 68);
    CHECK(of(Pass::kNoise, small) == 64 * 64 * 40);
    CHECK(of(Pass::kFilter, small) == 64 * 64 * 148);
    CHECK(of(Pass::kTrace, small) == 0);
}

TEST_CASE("every limit takes time, whatever the number of threads") {
    const Workload work = record_workload(scene(), kImage, {.threads = 2}, 1);
    profile::Profile profile;
    parallel::Arena arena(3);
    arena.record(&profile);
    const shadow::BareRays bare(work.view, shadow::TraceIsa::kAvx2, arena);
    Limits limits(work, bare, {.isa = simd::best_isa()}, arena, profile);
    const Limits::Measured m = limits.measure();
    for (const renderer::PassInfo& pass : renderer::kPasses) {
        CAPTURE(std::string(pass.name));
        CHECK((m.of(pass).wall_milliseconds > 0) == (pass.limit != LimitKind::kNone));
        CHECK((m.of(pass).thread_milliseconds > 0) == (pass.limit != LimitKind::kNone));
    }
}

TEST_CASE("where it is cancelled no ray is traced any more, and no limit measured") {
    const std::atomic<bool> cancelled = true;
    const Workload part =
        record_workload(scene(), kImage, {.threads = 2}, 1, kMemoryOfRays, &cancelled);
    CHECK(part.shadow_rays == 0);
    const Workload work = record_workload(scene(), kImage, {.threads = 2}, 1);
    profile::Profile profile;
    parallel::Arena arena(2);
    arena.record(&profile);
    const shadow::BareRays bare(work.view, shadow::TraceIsa::kAvx2, arena);
    Limits limits(work, bare, {.isa = simd::best_isa(), .cancelled = &cancelled}, arena, profile);
    const Limits::Measured m = limits.measure();
    for (const renderer::PassInfo& pass : renderer::kPasses)
        CHECK(m.of(pass).thread_milliseconds == 0);
}

TEST_CASE("a sweep doubles the threads up to what there is, which it includes") {
    CHECK(thread_sweep(1) == std::vector<int>{1});
    CHECK(thread_sweep(2) == std::vector<int>{1, 2});
    CHECK(thread_sweep(6) == std::vector<int>{1, 2, 4, 6});
    CHECK(thread_sweep(8) == std::vector<int>{1, 2, 4, 8});
}

TEST_CASE("the machine is described") {
    const Machine machine = describe_machine(simd::Isa::kAvx2, shadow::TraceIsa::kAvx512);
    CHECK(machine.kernel_isa == "avx2");
    CHECK(machine.trace_isa == "avx512");
    CHECK(machine.processors >= 1);
    CHECK_FALSE(machine.software.empty());
    CHECK(machine.date.size() == 25);
}
