#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/bench/charts.h"
#include "apps/page/svg.h"

namespace penumbra::bench {
namespace {

using page::Svg;
using page::tick_distance;

constexpr double kWidth = 900;
constexpr double kLabels = 96;    // left of the bars
constexpr double kNumbers = 230;  // right of them
constexpr double kRow = 26;
constexpr double kAxis = 24;  // below the bars
constexpr double kLength = kWidth - kLabels - kNumbers;

// One row: what is drawn of a pass.
struct Bar {
    const PassResult& pass;
    Summary time;
    double limit = 0, fraction = 0;  // 0: none

    explicit Bar(const PassResult& of) : pass(of), time(summarize(milliseconds(of))) {
        if (of.limit == LimitKind::kNone) return;
        limit = summarize(limit_milliseconds(of)).median;
        fraction = summarize(fractions(of)).median;
    }
    [[nodiscard]] double reach() const { return std::max(time.upper_quartile, limit); }
    [[nodiscard]] std::string words() const {
        std::string text = fmt::format("{:.3g} ms", time.median);
        if (limit > 0) text += fmt::format(", {:.2f} of {}", fraction, name(pass.limit));
        return text;
    }
};

void draw_axis(Svg& svg, double most, double bottom) {
    const double step = tick_distance(most);
    for (double at = 0; at <= most * 1.0001; at += step) {
        const double x = kLabels + kLength * at / most;
        svg.line({x, 0}, {x, bottom}, "grid");
        svg.text({x, bottom + 16}, "middle", fmt::format("{:g}", at), "tick");
    }
    svg.text({kLabels + kLength + 12, bottom + 16}, "start", "ms", "tick");
}

void draw_bar(Svg& svg, const Bar& bar, double most, double top) {
    const auto x = [&](double milliseconds) { return kLabels + kLength * milliseconds / most; };
    const double middle = top + kRow / 2;
    svg.text({kLabels - 8, middle + 4}, "end", bar.pass.name, "label");
    svg.rectangle({kLabels, top + 5}, {x(bar.time.median) - kLabels, kRow - 10}, "bar",
                  bar.words());
    svg.line({x(bar.time.lower_quartile), middle}, {x(bar.time.upper_quartile), middle}, "whisker");
    for (const double end : {bar.time.lower_quartile, bar.time.upper_quartile})
        svg.line({x(end), middle - 4}, {x(end), middle + 4}, "whisker");
    if (bar.limit > 0) svg.line({x(bar.limit), top + 1}, {x(bar.limit), top + kRow - 1}, "limit");
    svg.text({kWidth - kNumbers + 12, middle + 4}, "start", bar.words(), "number");
}

}  // namespace

std::string bar_chart(const std::vector<PassResult>& passes, const std::string& title) {
    std::vector<Bar> bars;
    for (const PassResult& pass : passes)
        if (!pass.samples.empty()) bars.emplace_back(pass);
    double most = 0;
    for (const Bar& bar : bars) most = std::max(most, bar.reach());
    if (most <= 0) return "";
    const double bottom = kRow * static_cast<double>(bars.size());
    Svg svg(kWidth, bottom + kAxis, title);
    draw_axis(svg, most, bottom);
    for (std::size_t i = 0; i < bars.size(); ++i)
        draw_bar(svg, bars[i], most, kRow * static_cast<double>(i));
    return svg.finish();
}

std::string change_chart(const std::vector<PassComparison>& passes, const std::string& title) {
    // What is farther away is cut: 10 to 50 %.
    double most = 0.1;
    for (const PassComparison& pass : passes)
        for (const double end : {pass.low, pass.high, pass.change})
            if (std::isfinite(end)) most = std::max(most, std::abs(end));
    most = std::min(most, 0.5);
    const auto x = [most](double change) {
        return kLabels + kLength / 2 * (1 + std::clamp(change / most, -1.0, 1.0));
    };
    const double bottom = kRow * static_cast<double>(passes.size());
    Svg svg(kWidth, bottom + kAxis, title);
    const double step = tick_distance(2 * most);
    for (double at = -std::floor(most / step) * step; at <= most * 1.0001; at += step) {
        svg.line({x(at), 0}, {x(at), bottom}, std::abs(at) < step / 2 ? "zero" : "grid");
        svg.text({x(at), bottom + 16}, "middle", fmt::format("{:+.3g} %", 100 * at), "tick");
    }
    double top = 0;
    for (const PassComparison& pass : passes) {
        const double middle = top + kRow / 2;
        const char* const style = pass.verdict == Verdict::kSlower   ? "slower"
                                  : pass.verdict == Verdict::kFaster ? "faster"
                                                                     : "same";
        svg.text({kLabels - 8, middle + 4}, "end", pass.pass, "label");
        svg.line({x(pass.low), middle}, {x(pass.high), middle}, style);
        svg.circle({x(pass.change), middle}, 5, style, fmt::format("{:+.1f} %", 100 * pass.change));
        svg.text({kWidth - kNumbers + 12, middle + 4}, "start",
                 fmt::format("{:+.1f} % {}", 100 * pass.change, name(pass.verdict)), "number");
        top += kRow;
    }
    return svg.finish();
}

}  // namespace penumbra::bench
