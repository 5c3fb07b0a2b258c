#include "apps/bench/launch_values.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/error.h"

namespace penumbra::bench {
namespace {

// One value per launch, in ascending order of launches.
template <class Ratio>
LaunchRatios logarithms_of_medians(const PassResult& pass, const Ratio& ratio) {
    std::map<int, std::vector<double>> launches;
    for (std::size_t i = 0; i < pass.samples.size(); ++i)
        launches[pass.samples[i].launch].push_back(ratio(i));
    LaunchRatios result;
    for (auto& [launch, ratios] : launches) {
        const double value = summarize(std::move(ratios)).median;
        if (value <= 0) return {};
        result.push_back(std::log(value));
    }
    return result;
}

double divided(double time, double limit) {
    return limit > 0 ? time / limit : 0;
}

bool is_known(const LaunchValues& values) {
    return !values.then.empty() && !values.now.empty();
}

// The median difference between any two.
double spread(const LaunchValues& values) {
    std::vector<double> all = values.then;
    all.insert(all.end(), values.now.begin(), values.now.end());
    std::vector<double> differences;
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t k = i + 1; k < all.size(); ++k)
            differences.push_back(std::abs(all[k] - all[i]));
    return differences.empty() ? 0 : summarize(std::move(differences)).median;
}

// Of the passes with this limit the one whose limit takes longest, which is measured best; or null.
const PassResult* find_limit(const ThreadRun& run, LimitKind kind) {
    const PassResult* longest = nullptr;
    for (const PassResult& pass : run.passes) {
        if (pass.limit != kind || !pass.parts.empty() || pass.samples.empty()) continue;
        const double floor = pass.samples.front().limit_floor_milliseconds;
        if (!longest || floor > longest->samples.front().limit_floor_milliseconds) longest = &pass;
    }
    return longest;
}

// How long streams took, in primary rays.
LaunchRatios memory(const PassResult& stream, const PassResult& rays) {
    return logarithms_of_medians(stream, [&](std::size_t i) {
        return divided(stream.samples[i].limit_floor_milliseconds,
                       rays.samples[i].limit_floor_milliseconds);
    });
}

LaunchValues against_primary_rays(const ThreadRun& then, const ThreadRun& now,
                                  const PassResult& before, const PassResult& after) {
    const PassResult* const old_rays = find_limit(then, LimitKind::kPrimaryRays);
    const PassResult* const new_rays = find_limit(now, LimitKind::kPrimaryRays);
    if (!old_rays || !new_rays) return {};
    LaunchValues values{floor_ratios(before, *old_rays), floor_ratios(after, *new_rays),
                        LimitKind::kPrimaryRays};
    const PassResult* const old_stream = find_limit(then, LimitKind::kStream);
    const PassResult* const new_stream = find_limit(now, LimitKind::kStream);
    if (!is_known(values) || !old_stream || !new_stream) return values;
    const LaunchValues conditions{memory(*old_stream, *old_rays), memory(*new_stream, *new_rays)};
    return is_known(conditions) ? adjusted(values, conditions) : values;
}

double mean(const LaunchRatios& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

LaunchRatios median_ratios(const PassResult& pass) {
    return logarithms_of_medians(pass, [&](std::size_t i) {
        return divided(pass.samples[i].milliseconds, pass.samples[i].limit_milliseconds);
    });
}

LaunchRatios floor_ratios(const PassResult& pass, const PassResult& reference) {
    return logarithms_of_medians(pass, [&](std::size_t i) {
        return divided(pass.samples[i].floor_milliseconds,
                       reference.samples[i].limit_floor_milliseconds);
    });
}

LaunchValues adjusted(LaunchValues values, const LaunchValues& conditions) {
    double products = 0;
    double squares = 0;
    const auto add = [&](const LaunchRatios& y, const LaunchRatios& x) {
        const double mean_x = mean(x);
        const double mean_y = mean(y);
        for (std::size_t i = 0; i < x.size(); ++i) {
            products += (x[i] - mean_x) * (y[i] - mean_y);
            squares += (x[i] - mean_x) * (x[i] - mean_x);
        }
    };
    add(values.then, conditions.then);
    add(values.now, conditions.now);
    const double k = squares > 0 ? std::clamp(products / squares, 0.0, 1.0) : 0;
    for (std::size_t i = 0; i < values.then.size(); ++i) values.then[i] -= k * conditions.then[i];
    for (std::size_t i = 0; i < values.now.size(); ++i) values.now[i] -= k * conditions.now[i];
    return values;
}

LaunchValues steadiest_values(const ThreadRun& then, const ThreadRun& now,
                              const std::string& pass) {
    const PassResult* const before = find(then, pass);
    const PassResult* const after = find(now, pass);
    PENUMBRA_ASSERT(before && after, "pass = {}", pass);
    LaunchValues own{floor_ratios(*before, *before), floor_ratios(*after, *after), after->limit};
    LaunchValues rays = against_primary_rays(then, now, *before, *after);
    if (is_known(own) && is_known(rays)) return spread(own) <= spread(rays) ? own : rays;
    if (is_known(own)) return own;
    return {median_ratios(*before), median_ratios(*after), after->limit};
}

}  // namespace penumbra::bench
