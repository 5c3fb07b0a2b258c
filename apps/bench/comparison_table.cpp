#include <fmt/format.h>

#include <cmath>

#include "apps/bench/comparison.h"
#include "apps/page/append.h"

namespace penumbra::bench {
namespace {

using page::append;

std::string percent(double change) {
    return std::isfinite(change) ? fmt::format("{:+.1f} %", 100 * change) : "?";
}

std::string probability(double value) {
    return value < 0.0001 ? "< 0.0001" : fmt::format("{:.4f}", value);
}

void append_notes(const Comparison& comparison, std::string& text) {
    for (const std::string& difference : comparison.differences)
        append(text, "  note: {}\n", difference);
    for (const std::string& reason : comparison.left_out)
        append(text, "  not compared: {}\n", reason);
    if (comparison.least_probability > kFalseAlarms)
        append(text,
               "  so few launches can show nothing: their least probability is {}, and {} is "
               "needed; measure with more --launches\n",
               probability(comparison.least_probability), kFalseAlarms);
}

void append_row(const PassComparison& pass, std::string& text) {
    append(text, "  {:<11} {:>9.3f} {:>9.3f} {:>9} {:>20} {:>9} {:>9} {:>9.1f}  {:<13} {}\n",
           pass.pass, pass.old_fraction, pass.new_fraction, percent(pass.change),
           fmt::format("{} to {}", percent(pass.low), percent(pass.high)),
           probability(pass.rank_probability), probability(pass.probability), pass.strength,
           name(pass.reference), name(pass.verdict));
}

int count(const Comparison& comparison, Verdict verdict) {
    int passes = 0;
    for (const PassComparison& pass : comparison.passes) passes += pass.verdict == verdict ? 1 : 0;
    return passes;
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
    std::string text = fmt::format(
        "comparison of {} launches then and {} now; change of a pass's time where its "
        "limit's stays the same\n",
        comparison.old_launches, comparison.new_launches);
    append_notes(comparison, text);
    const PassComparison* above = nullptr;
    for (const PassComparison& pass : comparison.passes) {
        if (!above || above->scene != pass.scene || above->threads != pass.threads)
            append(text,
                   "\n  {}, {} thread{}\n  {:<11} {:>9} {:>9} {:>9} {:>20} {:>9} {:>9} {:>9}  {}\n",
                   pass.scene, pass.threads, pass.threads == 1 ? "" : "s", "of limit:", "then",
                   "now", "change", "95 % interval", "p alone", "p of all", "strength", "against");
        append_row(pass, text);
        above = &pass;
    }
    append(text, "\n  {} slower, {} faster, {} without a change that shows\n",
           count(comparison, Verdict::kSlower), count(comparison, Verdict::kFaster),
           count(comparison, Verdict::kNoChange));
    return text;
}

}  // namespace penumbra::bench
