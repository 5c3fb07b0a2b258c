#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/bench/charts.h"
#include "apps/page/svg.h"

namespace penumbra::bench {
namespace {

using page::Svg;
using page::tick_distance;

constexpr double kChartWidth = 430;
constexpr double kHeight = 300;
constexpr double kLeft = 44, kRight = 92, kTop = 34, kBottom = 40;
constexpr double kLeastLabelDistance = 12;

// A quantity of each pass over the number of threads.
struct Scaling {
    std::string title;
    double (*value)(const SceneResult&, const ThreadRun&, const std::string&);
    double (*ideal)(double threads, double fewest);
    double most = 0;  // of the vertical axis
};

class Chart {
  public:
    Chart(const SceneResult& scene, const Scaling& scaling)
        : scene_(scene), scaling_(scaling), svg_(kChartWidth, kHeight, scaling.title) {
        for (const ThreadRun& run : scene.runs) {
            fewest_ = fewest_ == 0 ? run.threads : std::min<double>(fewest_, run.threads);
            most_ = std::max<double>(most_, run.threads);
        }
    }

    std::string draw() {
        axes();
        std::vector<Svg::Point> ideal;
        for (int i = 0; i <= 32; ++i) {
            const double threads = fewest_ + (most_ - fewest_) * i / 32;
            ideal.push_back(place(threads, scaling_.ideal(threads, fewest_)));
        }
        svg_.path(ideal, "ideal");
        labels_.push_back({ideal.back().second, "ideal", "label-ideal"});
        int colour = 0;
        for (const PassResult& pass : scene_.runs.front().passes) {
            const bool is_frame = pass.name == "frame";
            // Groups and the remainder would hide the passes.
            if (!is_frame && (!pass.parts.empty() || pass.limit == LimitKind::kNone)) continue;
            curve(pass.name, is_frame ? "frame" : fmt::format("c{}", colour++));
        }
        write_labels();
        return svg_.finish();
    }

  private:
    [[nodiscard]] Svg::Point place(double threads, double value) const {
        const double along = (threads - fewest_) / std::max(most_ - fewest_, 1e-9);
        const double up = std::clamp(value / scaling_.most, 0.0, 1.0);
        return {kLeft + along * (kChartWidth - kLeft - kRight),
                kHeight - kBottom - up * (kHeight - kTop - kBottom)};
    }

    void axes() {
        const double step = tick_distance(scaling_.most);
        for (double at = 0; at <= scaling_.most * 1.0001; at += step) {
            svg_.line(place(fewest_, at), place(most_, at), "grid");
            const Svg::Point left = place(fewest_, at);
            svg_.text({left.first - 6, left.second + 4}, "end", fmt::format("{:g}", at), "tick");
        }
        for (const ThreadRun& run : scene_.runs) {
            const Svg::Point bottom = place(run.threads, 0);
            svg_.line(bottom, place(run.threads, scaling_.most), "grid");
            svg_.text({bottom.first, bottom.second + 16}, "middle", fmt::format("{}", run.threads),
                      "tick");
        }
        svg_.text({(kLeft + kChartWidth - kRight) / 2, kHeight - 6}, "middle", "threads", "tick");
        svg_.text({kLeft - 30, 14}, "start", scaling_.title, "title");
    }

    void curve(const std::string& pass, const std::string& style) {
        std::vector<Svg::Point> points;
        std::vector<const ThreadRun*> runs;
        for (const ThreadRun& run : scene_.runs) runs.push_back(&run);
        std::sort(runs.begin(), runs.end(),
                  [](const ThreadRun* a, const ThreadRun* b) { return a->threads < b->threads; });
        for (const ThreadRun* run : runs) {
            const double value = scaling_.value(scene_, *run, pass);
            points.push_back(place(run->threads, value));
            svg_.circle(points.back(), 3, "dot " + style,
                        fmt::format("{}, {} threads: {:.2f}", pass, run->threads, value));
        }
        svg_.path(points, "curve " + style);
        labels_.push_back({points.back().second, pass, "label-" + style});
    }

    // At the curves' ends, moved apart where they would cover each other.
    void write_labels() {
        std::stable_sort(labels_.begin(), labels_.end(),
                         [](const Label& a, const Label& b) { return a.y < b.y; });
        double above = -kLeastLabelDistance;
        const double lowest = kHeight - kBottom;
        const auto count = static_cast<double>(labels_.size());
        for (std::size_t i = 0; i < labels_.size(); ++i) {
            const double left = count - 1 - static_cast<double>(i);
            double y = std::min(labels_[i].y, lowest - kLeastLabelDistance * left);
            y = std::max(y, above + kLeastLabelDistance);
            above = y;
            svg_.text({kChartWidth - kRight + 8, y + 4}, "start", labels_[i].words,
                      labels_[i].style);
        }
    }

    struct Label {
        double y;
        std::string words, style;
    };
    const SceneResult& scene_;
    const Scaling& scaling_;
    Svg svg_;
    double fewest_ = 0, most_ = 0;
    std::vector<Label> labels_;
};

std::string draw(const SceneResult& scene, Scaling scaling) {
    for (const ThreadRun& run : scene.runs)
        for (const PassResult& pass : run.passes)
            if (pass.limit != LimitKind::kNone)
                scaling.most = std::max(scaling.most, scaling.value(scene, run, pass.name));
    return Chart(scene, scaling).draw();
}

double ideal_speed_up(double threads, double fewest) {
    return threads / fewest;
}
double ideal_efficiency(double /*threads*/, double /*fewest*/) {
    return 1;
}

}  // namespace

std::string speed_up_chart(const SceneResult& scene) {
    double most = 1;
    for (const ThreadRun& run : scene.runs)
        for (const ThreadRun& other : scene.runs)
            most = std::max(most, static_cast<double>(run.threads) / other.threads);
    return draw(scene,
                {.title = "speed-up", .value = speed_up, .ideal = ideal_speed_up, .most = most});
}

std::string efficiency_chart(const SceneResult& scene) {
    return draw(
        scene,
        {.title = "efficiency", .value = efficiency, .ideal = ideal_efficiency, .most = 1.1});
}

}  // namespace penumbra::bench
