#include "apps/bench/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/bench/launch_values.h"
#include "apps/bench/matched_runs.h"
#include "apps/bench/rank_test.h"
#include "apps/bench/relabelling.h"
#include "apps/bench/undisturbed.h"
#include "core/error.h"

namespace penumbra::bench {
namespace {

// A pass that is in both reports, with the values of the old launches and then of the new ones.
struct Candidate {
    PassComparison shown;
    Quantity values;
};

const SceneResult* find_scene(const Report& report, const std::string& name) {
    const auto found = std::find_if(report.scenes.begin(), report.scenes.end(),
                                    [&](const SceneResult& s) { return s.name == name; });
    return found == report.scenes.end() ? nullptr : &*found;
}

const ThreadRun* find_run(const SceneResult& scene, int threads) {
    const auto found = std::find_if(scene.runs.begin(), scene.runs.end(),
                                    [&](const ThreadRun& r) { return r.threads == threads; });
    return found == scene.runs.end() ? nullptr : &*found;
}

// Why two results are not of the same work, or "".
std::string mismatch(const SceneResult& then, const SceneResult& now) {
    std::string text;
    const auto require = [&](const char* what, const auto& a, const auto& b) {
        if (a == b) return;
        if (!text.empty()) text += ", ";
        text += fmt::format("{} {} then, {} now", what, a, b);
    };
    require("size", fmt::format("{} x {}", then.width, then.height),
            fmt::format("{} x {}", now.width, now.height));
    require("frame", then.frame, now.frame);
    require("samples per pixel", then.samples_per_pixel, now.samples_per_pixel);
    require("triangles", then.triangles, now.triangles);
    require("lights", then.lights, now.lights);
    return text;
}

[[noreturn]] void refuse(const std::vector<std::string>& reasons) {
    std::string why;
    for (const std::string& reason : reasons) why += "; " + reason;
    throw InputError("the reports have nothing in common that can be compared" + why);
}

class Comparer {
  public:
    Comparer(const Report& old_report, const Report& new_report)
        : old_(old_report), new_(new_report) {}

    Comparison run() {
        result_.old_launches = require_launches(old_, "old report");
        result_.new_launches = require_launches(new_, "new report");
        add_machines();
        for (const SceneResult& scene : new_.scenes) add_scene(scene);
        for (const SceneResult& scene : old_.scenes)
            if (!find_scene(new_, scene.name)) leave_out(scene.name, "only in the old report");
        if (candidates_.empty()) refuse(result_.left_out);
        judge();
        return std::move(result_);
    }

  private:
    void leave_out(const std::string& what, const std::string& why) {
        result_.left_out.push_back(fmt::format("{}: {}", what, why));
    }

    template <class T>
    void note(const std::string& what, const T& then, const T& now) {
        if (then != now)
            result_.differences.push_back(fmt::format("{}: {} then, {} now", what, then, now));
    }

    void add_machines() {
        const Machine& then = old_.machine;
        const Machine& now = new_.machine;
        note("processor", then.processor, now.processor);
        note("processors", then.processors, now.processors);
        note("host", then.host, now.host);
        note("instruction set of the kernels", then.kernel_isa, now.kernel_isa);
        note("instruction set of the ray tracer", then.trace_isa, now.trace_isa);
        note("software", then.software, now.software);
        note("repetitions", old_.repetitions, new_.repetitions);
        add_load("old report", then);
        add_load("new report", now);
    }

    // Who else was there may have slowed down one pass and not its limit.
    void add_load(const char* which, const Machine& machine) {
        if (!machine.load.empty() && machine.load.front() > 0.5 * machine.processors)
            result_.differences.push_back(
                fmt::format("{}: others kept {:.1f} of {} processors busy when it began", which,
                            machine.load.front(), machine.processors));
    }

    void add_scene(const SceneResult& now) {
        const SceneResult* const then = find_scene(old_, now.name);
        if (!then) return leave_out(now.name, "only in the new report");
        const std::string different = mismatch(*then, now);
        if (!different.empty()) return leave_out(now.name, different);
        note(now.name + ": shadow rays", then->shadow_rays, now.shadow_rays);
        for (const ThreadRun& run : now.runs) {
            if (const ThreadRun* const same = find_run(*then, run.threads))
                add_run(now, *same, run);
            else
                leave_out(fmt::format("{}/threads:{}", now.name, run.threads),
                          "only in the new report");
        }
    }

    void add_run(const SceneResult& scene, const ThreadRun& old_run, const ThreadRun& new_run) {
        const MatchedRuns runs =
            match(old_run, new_run, old_.machine.processor == new_.machine.processor);
        if (!runs.note.empty())
            result_.differences.push_back(
                fmt::format("{}/threads:{}: {}", scene.name, new_run.threads, runs.note));
        result_.least_probability =
            std::max(result_.least_probability,
                     least_probability(runs.then.places.size(), runs.now.places.size()));
        const ThreadRun& then = runs.then.kept;
        const ThreadRun& now = runs.now.kept;
        for (const PassResult& pass : now.passes) {
            // Groups repeat their passes, and "other" is what no pass did.
            if (!pass.parts.empty() || pass.name == "other") continue;
            if (pass.limit == LimitKind::kNone) continue;  // times of another day say nothing
            const std::string name = benchmark_name(scene, now, pass);
            const PassResult* const before = find(then, pass.name);
            if (!before)
                leave_out(name, "only in the new report");
            else if (before->limit != pass.limit)
                leave_out(name, "measured against another limit");
            else
                add_pass(name,
                         {.scene = scene.name,
                          .threads = now.threads,
                          .pass = pass.name,
                          .old_fraction = summarize(fractions(*before)).median,
                          .new_fraction = summarize(fractions(pass)).median},
                         runs);
            if (before) note(name + ": limit", before->limit_call, pass.limit_call);
        }
    }

    void add_pass(const std::string& name, PassComparison shown, const MatchedRuns& runs) {
        const LaunchValues values = steadiest_values(runs.then.kept, runs.now.kept, shown.pass);
        if (values.then.empty() || values.now.empty())
            return leave_out(name, "too short for the clock");
        shown.reference = values.reference;
        const Shift shift = hodges_lehmann(values.then, values.now, kIntervalConfidence);
        shown.change = std::expm1(shift.estimate);
        shown.low = std::expm1(shift.low);
        shown.high = std::expm1(shift.high);
        shown.rank_probability = mann_whitney(values.then, values.now).probability;
        candidates_.push_back({std::move(shown), runs.among_all(values)});
    }

    void judge() {
        const auto old_count = static_cast<std::size_t>(result_.old_launches);
        std::vector<Quantity> quantities;
        for (const Candidate& candidate : candidates_) quantities.push_back(candidate.values);
        const std::vector<double> corrected = corrected_probabilities(quantities, old_count);
        for (std::size_t i = 0; i < candidates_.size(); ++i) {
            PassComparison pass = candidates_[i].shown;
            pass.probability = corrected[i];
            pass.strength = shift_strength(candidates_[i].values, old_count);
            const bool is_certain =
                pass.probability <= kFalseAlarms && pass.rank_probability <= kRankLevel;
            const bool is_large =
                std::abs(pass.change) >= kLeastChange && pass.strength >= kLeastStrength;
            if (is_certain && is_large)
                pass.verdict = pass.change > 0 ? Verdict::kSlower : Verdict::kFaster;
            result_.passes.push_back(std::move(pass));
        }
    }

    const Report& old_;
    const Report& new_;
    Comparison result_;
    std::vector<Candidate> candidates_;
};

}  // namespace

std::string name(Verdict verdict) {
    switch (verdict) {
        case Verdict::kSlower:
            return "SLOWER";
        case Verdict::kFaster:
            return "faster";
        case Verdict::kNoChange:
            break;
    }
    return "";
}

int require_launches(const Report& report, const std::string& which) {
    int launches = 0;
    for (const SceneResult& scene : report.scenes)
        for (const ThreadRun& run : scene.runs)
            for (const PassResult& pass : run.passes) {
                const int count = static_cast<int>(bench::launches(pass).size());
                if (launches != 0 && count != launches)
                    throw InputError(fmt::format("{}: {} has {} launches, others have {}", which,
                                                 benchmark_name(scene, run, pass), count,
                                                 launches));
                launches = count;
            }
    if (launches < kFewestLaunches)
        throw InputError(fmt::format(
            "{}: expected at least {} launches of the program, got {}: one launch's frames "
            "do not tell how another one's would be; measure with --launches",
            which, kFewestLaunches, launches));
    return launches;
}

void require_common(const Report& old_report, const Report& new_report) {
    std::vector<std::string> reasons;
    for (const SceneResult& now : new_report.scenes) {
        const SceneResult* const then = find_scene(old_report, now.name);
        const std::string why = then ? mismatch(*then, now) : "only in the new report";
        if (!why.empty()) {
            reasons.push_back(fmt::format("{}: {}", now.name, why));
            continue;
        }
        for (const ThreadRun& run : now.runs) {
            if (find_run(*then, run.threads)) return;
            reasons.push_back(
                fmt::format("{}/threads:{}: only in the new report", now.name, run.threads));
        }
    }
    refuse(reasons);
}

Comparison compare(const Report& old_report, const Report& new_report) {
    return Comparer(old_report, new_report).run();
}

std::vector<PassComparison> slower_beyond(const Comparison& comparison, double percent) {
    std::vector<PassComparison> slower;
    for (const PassComparison& pass : comparison.passes)
        if (pass.verdict == Verdict::kSlower && 100 * pass.change > percent) slower.push_back(pass);
    return slower;
}

}  // namespace penumbra::bench
