// What the profile costs: the number of a frame's slices times the measured cost of one, with a
// profile and without, and frames with and without one in turns as a confirmation.
//
//     profile_overhead [SCENE] [PAIRS] [THREADS]

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "apps/renderer/builtin_scene.h"
#include "apps/renderer/renderer.h"
#include "core/profile/profile.h"
#include "core/profile/stopwatch.h"
#include "core/scene/read_scene.h"

using namespace penumbra;

namespace {

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Nanoseconds of one scope, the least of several rounds: what it takes when nothing interferes.
double scope_nanoseconds(profile::Profile* profile) {
    constexpr int kScopes = 100000;
    double best = 1e9;
    for (int round = 0; round < 20; ++round) {
        if (profile) profile->clear();
        const profile::Stopwatch watch;
        for (int i = 0; i < kScopes; ++i) {
            const profile::Scope scope(profile, 0, profile::Kind::kTask, "scope", {"index", i});
            asm volatile("" ::: "memory");  // the scope is no less than the compiler makes of it
        }
        best = std::min(best, 1e9 * watch.seconds() / kScopes);
    }
    return best;
}

struct Slices {
    std::size_t passes = 0;  // whose clock runs with a profile and without
    std::size_t others = 0;
};

Slices count_slices(const profile::Profile& profile) {
    Slices count;
    for (int worker = 0; worker < profile.threads(); ++worker)
        for (const profile::Slice& slice : profile.track(worker).slices())
            ++(slice.kind == profile::Kind::kPass ? count.passes : count.others);
    return count;
}

void run(const Scene& scene, int pairs, int threads) {
    profile::Profile profile;
    renderer::Renderer with(scene, {}, {.threads = threads, .profile = &profile});
    renderer::Renderer without(scene, {}, {.threads = threads});
    renderer::Film film;
    const renderer::AovSet aovs{renderer::Aov::kBeauty};
    with.render(1, aovs, film);
    without.render(1, aovs, film);

    std::vector<double> on, off, difference;
    Slices slices;
    for (int pair = 0; pair < pairs; ++pair) {
        profile.clear();
        const auto frame_on = [&] { on.push_back(with.render(1, aovs, film).render_seconds); };
        const auto frame_off = [&] { off.push_back(without.render(1, aovs, film).render_seconds); };
        // In both orders, so that none has the warmer caches.
        if (pair % 2 == 0) frame_on();
        frame_off();
        if (pair % 2 == 1) frame_on();
        slices = count_slices(profile);
        difference.push_back(on.back() / off.back() - 1);
    }

    profile::Profile scratch;
    scratch.make_tracks(1);
    const double on_nanoseconds = scope_nanoseconds(&scratch);
    const double off_nanoseconds = scope_nanoseconds(nullptr);
    // One reading of the clock ends a pass and begins the next.
    const auto all = static_cast<double>(slices.passes + slices.others);
    const double thread_nanoseconds = 1e9 * median(off) * threads;
    fmt::print("{} slices of passes and {} others per frame of {:.1f} ms on {} threads\n",
               slices.passes, slices.others, 1e3 * median(off), threads);
    fmt::print("a scope: {:.1f} ns with a profile, {:.2f} ns without\n", on_nanoseconds,
               off_nanoseconds);
    fmt::print("so the profile costs at most {:.3f} % of a frame, none {:.4f} %\n",
               100 * all * on_nanoseconds / thread_nanoseconds,
               100 * all * off_nanoseconds / thread_nanoseconds);
    fmt::print("{} pairs of frames: {:+.2f} % (median of the ratios)\n", pairs,
               100 * median(difference));
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const Scene scene = argc > 1 ? read_scene(argv[1]) : renderer::read_builtin_scene();
        const int pairs = argc > 2 ? std::atoi(argv[2]) : 21;
        const int threads = argc > 3 ? std::atoi(argv[3]) : 2;
        run(scene, std::max(pairs, 1), std::max(threads, 1));
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return 1;
    }
}
