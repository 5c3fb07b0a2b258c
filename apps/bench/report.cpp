#include "apps/bench/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"

namespace penumbra::bench {
namespace {

template <class Get>
std::vector<double> each(const PassResult& pass, const Get& get) {
    std::vector<double> values;
    values.reserve(pass.samples.size());
    for (const Sample& sample : pass.samples) values.push_back(get(sample));
    return values;
}

double median_milliseconds(const PassResult& pass) {
    return summarize(milliseconds(pass)).median;
}

const ThreadRun& fewest_threads(const SceneResult& scene) {
    return *std::min_element(
        scene.runs.begin(), scene.runs.end(),
        [](const ThreadRun& a, const ThreadRun& b) { return a.threads < b.threads; });
}

}  // namespace

std::string name(LimitKind kind) {
    switch (kind) {
        case LimitKind::kNone:
            return "";
        case LimitKind::kPrimaryRays:
            return "primary rays";
        case LimitKind::kShadowRays:
            return "shadow rays";
        case LimitKind::kStream:
            return "stream";
        case LimitKind::kArithmetic:
            return "arithmetic";
        case LimitKind::kSum:
            return "sum";
    }
    return "";
}

double quantile(const std::vector<double>& sorted, double position) {
    const double place = position * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

Summary summarize(std::vector<double> values) {
    PENUMBRA_ASSERT(!values.empty(), "values = {}", values.size());
    std::sort(values.begin(), values.end());
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    const double squares = std::accumulate(
        values.begin(), values.end(), 0.0,
        [mean](double sum, double value) { return sum + (value - mean) * (value - mean); });
    return {.median = quantile(values, 0.5),
            .lower_quartile = quantile(values, 0.25),
            .upper_quartile = quantile(values, 0.75),
            .mean = mean,
            .deviation = count > 1 ? std::sqrt(squares / (count - 1)) : 0,
            .lowest = values.front(),
            .highest = values.back()};
}

std::vector<double> milliseconds(const PassResult& pass) {
    return each(pass, [](const Sample& s) { return s.milliseconds; });
}

std::vector<double> thread_milliseconds(const PassResult& pass) {
    return each(pass, [](const Sample& s) { return s.thread_milliseconds; });
}

std::vector<double> limit_milliseconds(const PassResult& pass) {
    return each(pass, [](const Sample& s) { return s.limit_milliseconds; });
}

std::vector<double> fractions(const PassResult& pass) {
    if (pass.limit == LimitKind::kNone) return {};
    return each(pass, [](const Sample& s) {
        return s.milliseconds > 0 ? s.limit_milliseconds / s.milliseconds : 0;
    });
}

const PassResult* find(const ThreadRun& run, const std::string& pass) {
    const auto found = std::find_if(run.passes.begin(), run.passes.end(),
                                    [&](const PassResult& p) { return p.name == pass; });
    return found == run.passes.end() ? nullptr : &*found;
}

const PassResult& whole_frame(const ThreadRun& run) {
    PENUMBRA_ASSERT(!run.passes.empty(), "passes = {}", run.passes.size());
    return run.passes.back();
}

double share(const ThreadRun& run, const PassResult& pass) {
    const double frame = median_milliseconds(whole_frame(run));
    return frame > 0 ? median_milliseconds(pass) / frame : 0;
}

Throughput throughput(const PassResult& pass) {
    const double seconds = 1e-3 * median_milliseconds(pass);
    if (seconds <= 0) return {};
    const auto per_second = [seconds](std::uint64_t work) {
        return static_cast<double>(work) / seconds;
    };
    return {.pixels = per_second(pass.work.pixels),
            .triangles = per_second(pass.work.triangles),
            .rays = per_second(pass.work.rays),
            .bytes = per_second(pass.work.bytes)};
}

double speed_up(const SceneResult& scene, const ThreadRun& run, const std::string& pass) {
    const PassResult* const base = find(fewest_threads(scene), pass);
    const PassResult* const here = find(run, pass);
    if (!base || !here) return 0;
    const double milliseconds_here = median_milliseconds(*here);
    return milliseconds_here > 0 ? median_milliseconds(*base) / milliseconds_here : 0;
}

double efficiency(const SceneResult& scene, const ThreadRun& run, const std::string& pass) {
    return speed_up(scene, run, pass) * fewest_threads(scene).threads / run.threads;
}

std::string benchmark_name(const SceneResult& scene, const ThreadRun& run, const PassResult& pass) {
    return fmt::format("{}/threads:{}/{}", scene.name, run.threads, pass.name);
}

}  // namespace penumbra::bench
