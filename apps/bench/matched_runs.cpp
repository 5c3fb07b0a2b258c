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
    double old_best = best_core_share(then);
    double new_best = best_core_share(now);
    if (old_best <= 0 || new_best <= 0)
        return {
            .then = side(then, then),
            .now = side(now, now),
            .note = "whether others used the cores was not measured; all launches are compared"};
    if (is_same_processor) old_best = new_best = std::max(old_best, new_best);
    MatchedRuns matched{.then = side(undisturbed(then, old_best), then),
                        .now = side(undisturbed(now, new_best), now)};
    const std::size_t old_count = matched.then.places.size();
    const std::size_t new_count = matched.now.places.size();
    const bool is_enough = std::min(old_count, new_count) >= kFewestLaunches;
    if (old_count < matched.then.all || new_count < matched.now.all)
        matched.note = fmt::format(
            "{} of {} launches then and {} of {} now had cores of their own{}", old_count,
            matched.then.all, new_count, matched.now.all,
            is_enough ? "; these are compared"
                      : ", too few to compare these alone; measure with more --patience");
    if (!is_enough) {
        matched.then = side(then, then);
        matched.now = side(now, now);
    }
    return matched;
}

}  // namespace penumbra::bench
