#include "apps/bench/matched_runs.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/bench/comparison.h"
#include "apps/bench/undisturbed.h"

namespace penumbra::bench {
namespace {

MatchedRuns::Side side(const ThreadRun& kept, const ThreadRun& run) {
    const std::vector<int> all = launches(run);
    MatchedRuns::Side result{.kept = kept, .all = all.size()};
    for (const int launch : launches(kept))
        result.places.push_back(static_cast<std::size_t>(
            std::lower_bound(all.begin(), all.end(), launch) - all.begin()));
    return result;
}

}  // namespace

Quantity MatchedRuns::among_all(const LaunchValues& values) const {
    Quantity quantity(then.all + now.all, kMissing);
    for (std::size_t i = 0; i < then.places.size(); ++i) quantity[then.places[i]] = values.then[i];
    for (std::size_t i = 0; i < now.places.size(); ++i)
        quantity[then.all + now.places[i]] = values.now[i];
    return quantity;
}

MatchedRuns match(const ThreadRun& then, const ThreadRun& now, bool is_same_processor) {
    MatchedRuns all{.then = side(then, then), .now = side(now, now)};
    double old_best = best_core_share(then);
    double new_best = best_core_share(now);
    if (old_best <= 0 || new_best <= 0) {
        all.note = "whether others used the cores was not measured; all launches are compared";
        return all;
    }
    if (is_same_processor) old_best = new_best = std::max(old_best, new_best);
    MatchedRuns quiet{.then = side(undisturbed(then, old_best), then),
                      .now = side(undisturbed(now, new_best), now)};
    const std::size_t old_count = quiet.then.places.size();
    const std::size_t new_count = quiet.now.places.size();
    if (old_count == all.then.all && new_count == all.now.all) return quiet;
    const bool is_enough = std::min(old_count, new_count) >= kFewestLaunches;
    MatchedRuns& chosen = is_enough ? quiet : all;
    chosen.note =
        fmt::format("{} of {} launches then and {} of {} now had cores of their own{}", old_count,
                    all.then.all, new_count, all.now.all,
                    is_enough ? "; these are compared"
                              : ", too few to compare these alone; measure with more --patience");
    return chosen;
}

}  // namespace penumbra::bench
