#include "apps/check/outcome.h"

#include <fmt/format.h>

#include <algorithm>

namespace penumbra::check {
namespace {

std::string prefix(const FrameOutcome& frame) {
    return frame.frame.empty() ? "" : fmt::format("frame {}: ", frame.frame);
}

// ", max 0.1, psnr 38.4": the layer's numbers, as far as it has them.
std::string numbers(const diff::PairReport& comparison, const std::string& layer_name) {
    std::string text;
    for (const diff::LayerReport& layer : comparison.layers) {
        if (layer.name != layer_name) continue;
        for (const diff::Metric metric :
             {diff::Metric::kMax, diff::Metric::kRmse, diff::Metric::kPsnr, diff::Metric::kSsim,
              diff::Metric::kFlip})
            if (const auto& value = layer.metrics[metric])
                text += fmt::format(", {} {:.4g}", diff::info(metric).name, *value);
    }
    return text;
}

void add_comparison(const FrameOutcome& frame, std::vector<std::string>& lines) {
    if (!frame.comparison) return;
    for (const diff::Failure& failure : frame.comparison->failures) {
        const bool is_difference = failure.kind == diff::FailureKind::kDiffers;
        lines.push_back(
            fmt::format("{}{}: {}{}{}{}", prefix(frame), diff::name(failure.kind), failure.layer,
                        failure.layer.empty() ? "" : ": ", failure.message,
                        is_difference ? numbers(*frame.comparison, failure.layer) : ""));
    }
    const std::string worst = worst_place(*frame.comparison);
    if (!worst.empty()) lines.push_back(prefix(frame) + worst);
}

}  // namespace

std::string_view name(Verdict verdict) {
    constexpr std::string_view kNames[] = {"passed", "blessed", "updated", "missing",
                                           "failed", "unfit",   "error"};
    return kNames[static_cast<int>(verdict)];
}

bool is_good(Verdict verdict) {
    return verdict == Verdict::kPassed || verdict == Verdict::kBlessed ||
           verdict == Verdict::kUpdated;
}

std::string_view name(ErrorKind kind) {
    constexpr std::string_view kNames[] = {"settings", "scene",   "render",
                                           "crash",    "timeout", "comparison"};
    return kNames[static_cast<int>(kind)];
}

int Error::exit_code() const {
    return kind == ErrorKind::kSettings || kind == ErrorKind::kScene ? 2 : 3;
}

Verdict CheckOutcome::verdict() const {
    if (error) return Verdict::kError;
    Verdict gravest = Verdict::kPassed;
    for (const FrameOutcome& frame : frames) gravest = std::max(gravest, frame.verdict);
    return gravest;
}

int CheckOutcome::exit_code() const {
    if (error) return error->exit_code();
    return is_good(verdict()) ? 0 : 1;
}

int exit_code(const std::vector<CheckOutcome>& outcomes) {
    int gravest = 0;
    for (const CheckOutcome& outcome : outcomes) gravest = std::max(gravest, outcome.exit_code());
    return gravest;
}

std::vector<std::string> problems(const CheckOutcome& outcome) {
    std::vector<std::string> lines;
    if (outcome.error)
        lines.push_back(fmt::format("{}: {}", name(outcome.error->kind), outcome.error->message));
    for (const FrameOutcome& frame : outcome.frames) {
        if (frame.verdict == Verdict::kMissing)
            lines.push_back(
                fmt::format("{}there is no golden {}", prefix(frame), frame.golden.string()));
        if (frame.verdict == Verdict::kUnfit)
            lines.push_back(fmt::format("{}unfit golden: {}", prefix(frame), frame.message));
        if (frame.verdict != Verdict::kPassed) add_comparison(frame, lines);
    }
    return lines;
}

std::string worst_place(const diff::PairReport& comparison) {
    const diff::LayerReport* worst = nullptr;
    for (const diff::LayerReport& layer : comparison.layers) {
        if (layer.worst.empty()) continue;
        if (worst == nullptr || layer.worst.front().error > worst->worst.front().error)
            worst = &layer;
    }
    if (worst == nullptr) return "";
    const diff::Block& block = worst->worst.front();
    return fmt::format("worst tile at {},{} ({} x {}) of {}: mean error {:.4g}", block.x, block.y,
                       block.width, block.height, worst->name, block.error);
}

}  // namespace penumbra::check
