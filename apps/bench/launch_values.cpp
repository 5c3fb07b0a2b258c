#include "apps/bench/launch_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.h"

namespace penumbra::bench {
namespace {

struct Times {
    std::vector<double> pass, limit;
};

double low(std::vector<double> values, double position) {
    std::sort(values.begin(), values.end());
    return quantile(values, position);
}

double median_ratio(const Times& times) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < times.pass.size(); ++i)
        ratios.push_back(times.limit[i] > 0 ? times.pass[i] / times.limit[i] : 0);
    return low(std::move(ratios), 0.5);
}

double ratio(const Times& times, Digest digest) {
    if (digest == Digest::kMedianRatio) return median_ratio(times);
    const double position = digest == Digest::kLowest ? 0 : 0.1;
    const double limit = low(times.limit, position);
    return limit > 0 ? low(times.pass, position) / limit : 0;
}

// The median difference between any two.
double spread(const LaunchValues& values) {
    std::vector<double> all = values.then;
    all.insert(all.end(), values.now.begin(), values.now.end());
    std::vector<double> differences;
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t k = i + 1; k < all.size(); ++k)
            differences.push_back(std::abs(all[k] - all[i]));
    return differences.empty() ? 0 : low(std::move(differences), 0.5);
}

const PassResult* find_primary_rays(const ThreadRun& run) {
    for (const PassResult& pass : run.passes)
        if (pass.limit == LimitKind::kPrimaryRays && pass.parts.empty()) return &pass;
    return nullptr;
}

}  // namespace

std::vector<double> launch_values(const PassResult& pass, const PassResult& reference,
                                  Digest digest) {
    std::map<int, Times> launches;
    for (std::size_t i = 0; i < pass.samples.size(); ++i) {
        Times& times = launches[pass.samples[i].launch];
        times.pass.push_back(pass.samples[i].milliseconds);
        times.limit.push_back(reference.samples[i].limit_milliseconds);
    }
    std::vector<double> values;
    for (const auto& [launch, times] : launches) {
        const double value = ratio(times, digest);
        if (value <= 0) return {};
        values.push_back(std::log(value));
    }
    return values;
}

LaunchValues steadiest_values(const ThreadRun& then, const ThreadRun& now,
                              const std::string& pass) {
    const PassResult* const before = find(then, pass);
    const PassResult* const after = find(now, pass);
    PENUMBRA_ASSERT(before && after, "pass = {}", pass);
    LaunchValues best;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const PassResult& old_limit, const PassResult& new_limit) {
        for (const Digest digest : {Digest::kMedianRatio, Digest::kLowDeciles, Digest::kLowest}) {
            LaunchValues values{launch_values(*before, old_limit, digest),
                                launch_values(*after, new_limit, digest), new_limit.limit};
            if (values.then.empty() || values.now.empty()) continue;
            const double spread_here = spread(values);
            if (spread_here >= least) continue;
            least = spread_here;
            best = std::move(values);
        }
    };
    consider(*before, *after);
    const PassResult* const old_rays = find_primary_rays(then);
    const PassResult* const new_rays = find_primary_rays(now);
    if (old_rays && new_rays) consider(*old_rays, *new_rays);
    return best;
}

}  // namespace penumbra::bench
