#include "apps/bench/undisturbed.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/error.h"

namespace penumbra::bench {
namespace {

// All passes of a run have the same repetitions.
const std::vector<Sample>& repetitions(const ThreadRun& run) {
    PENUMBRA_ASSERT(!run.passes.empty(), "{} threads", run.threads);
    return run.passes.front().samples;
}

ThreadRun only(const ThreadRun& run, const std::vector<std::size_t>& kept) {
    ThreadRun result = run;
    for (std::size_t p = 0; p < run.passes.size(); ++p) {
        result.passes[p].samples.clear();
        for (const std::size_t i : kept)
            result.passes[p].samples.push_back(run.passes[p].samples[i]);
    }
    return result;
}

}  // namespace

double best_core_share(const ThreadRun& run) {
    std::vector<double> shares;
    for (const Sample& sample : repetitions(run)) shares.push_back(sample.core_share);
    std::sort(shares.begin(), shares.end());
    if (shares.empty() || shares.front() <= 0) return 0;
    return quantile(shares, 0.9);
}

double best_core_share(const Report& report, const std::string& scene, int threads) {
    for (const SceneResult& result : report.scenes)
        for (const ThreadRun& run : result.runs)
            if (result.name == scene && run.threads == threads) return best_core_share(run);
    return 0;
}

std::string disturbance(const ThreadRun& run) {
    const double best = best_core_share(run);
    const std::vector<Sample>& all = repetitions(run);
    const auto disturbed = std::count_if(all.begin(), all.end(), [&](const Sample& sample) {
        return !is_undisturbed(sample.core_share, best);
    });
    if (disturbed == 0) return "";
    return fmt::format("others used the cores in {} of {} frames", disturbed, all.size());
}

ThreadRun undisturbed(const ThreadRun& run, double best) {
    const std::vector<Sample>& all = repetitions(run);
    std::map<int, int> counts;
    std::map<int, int> undisturbed_counts;
    for (const Sample& sample : all) {
        ++counts[sample.launch];
        if (is_undisturbed(sample.core_share, best)) ++undisturbed_counts[sample.launch];
    }
    const auto says_enough = [&](int launch) {
        return undisturbed_counts[launch] >= std::min(kFewestUndisturbed, counts[launch]);
    };
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (is_undisturbed(all[i].core_share, best) && says_enough(all[i].launch))
            kept.push_back(i);
    return only(run, kept);
}

std::vector<int> launches(const PassResult& pass) {
    std::set<int> numbers;
    for (const Sample& sample : pass.samples) numbers.insert(sample.launch);
    return {numbers.begin(), numbers.end()};
}

std::vector<int> launches(const ThreadRun& run) {
    return launches(run.passes.front());
}

ThreadRun least_disturbed(const ThreadRun& run, std::size_t count) {
    const std::vector<Sample>& all = repetitions(run);
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return all[a].core_share > all[b].core_share;
    });
    order.resize(std::min(count, order.size()));
    std::sort(order.begin(), order.end());
    return only(run, order);
}

}  // namespace penumbra::bench
