#include "apps/check/run.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "apps/check/accept.h"
#include "apps/check/compare.h"
#include "apps/check/memory.h"
#include "core/error.h"

namespace penumbra::check {
namespace {

namespace fs = std::filesystem;

// Between two looks at the renders; short against what any of them takes.
constexpr std::chrono::milliseconds kPollInterval{4};

// Where the new renders of each check go: below `folder` as the checks lie below the deepest folder
// they have in common.
std::vector<fs::path> stems_in(const fs::path& folder, const std::vector<Check>& checks) {
    std::vector<fs::path> names;
    for (const Check& check : checks) names.push_back(fs::weakly_canonical(check.name));
    fs::path common = names.front().parent_path();
    for (const fs::path& name : names)
        while (*name.lexically_relative(common).begin() == "..") common = common.parent_path();
    for (fs::path& name : names) {
        std::string file;  // '#' would become the frame number
        for (const char c : name.filename().string()) file += c == '#' ? "%23" : std::string(1, c);
        name = folder / name.lexically_relative(common).parent_path() / file;
    }
    return names;
}

class Run {
  public:
    Run(const std::vector<Check>& checks, const RunSettings& settings,
        const std::function<void(const CheckOutcome&)>& on_outcome)
        : settings_(settings),
          on_outcome_(on_outcome),
          stems_(stems_in(settings.renders, checks)),
          scratch_stems_(stems_in(settings.scratch, checks)),
          is_done_(checks.size(), false),
          arena_(parallel::default_thread_count()) {
        for (const Check& check : checks) outcomes_.push_back({.check = check});
        for (std::size_t i = 0; i < outcomes_.size(); ++i) prepare(i);
        choose_jobs();
    }

    std::vector<CheckOutcome> finish(const std::atomic<bool>& cancelled) {
        while (!cancelled.load() && (next_ < outcomes_.size() || !running_.empty())) {
            start_some();
            if (!poll_all()) std::this_thread::sleep_for(kPollInterval);
            report_in_order();
        }
        running_.clear();
        outcomes_.resize(reported_);
        return std::move(outcomes_);
    }

  private:
    struct Running {
        std::size_t index;
        std::unique_ptr<RenderJob> job;
    };

    void fail(std::size_t index, ErrorKind kind, const std::string& message) {
        outcomes_[index].error = Error{kind, message};
        is_done_[index] = true;
    }

    void prepare(std::size_t index) {
        CheckOutcome& outcome = outcomes_[index];
        const Check& check = outcome.check;
        try {
            if (!check.settings.empty())
                outcome.settings = read_settings(check.settings, settings_.render.options);
            if (check.scene.empty() && outcome.settings.scene.empty())
                throw InputError(check.name + ".json", "there is no such scene, nor a .obj");
        } catch (const InputError& error) {
            fail(index, ErrorKind::kSettings, error.what());
        } catch (const OutputError& error) {
            fail(index, ErrorKind::kRender, error.what());
        }
    }

    void choose_jobs() {
        const int allowed = arena_.threads();
        const int checks = static_cast<int>(outcomes_.size());
        std::uint64_t largest = 1;
        for (const CheckOutcome& outcome : outcomes_)
            largest = std::max(largest, estimated_bytes(outcome.check, outcome.settings));
        const auto fitting =
            static_cast<int>(std::clamp<std::uint64_t>(available_bytes() / largest, 1, 1024));
        jobs_ = settings_.jobs;
        if (jobs_ == 0)
            jobs_ = std::min({fitting, checks, allowed / std::max(1, settings_.threads)});
        jobs_ = std::max(1, jobs_);
        how_ = settings_.render;
        how_.threads = settings_.threads > 0 ? settings_.threads : std::max(1, allowed / jobs_);
    }

    void start_some() {
        for (; next_ < outcomes_.size() && static_cast<int>(running_.size()) < jobs_; ++next_) {
            if (is_done_[next_]) continue;
            const CheckOutcome& outcome = outcomes_[next_];
            try {
                running_.push_back(
                    {next_, std::make_unique<RenderJob>(outcome.check, outcome.settings, how_,
                                                        stems_[next_])});
            } catch (const OutputError& error) {
                fail(next_, ErrorKind::kRender, error.what());
            }
        }
    }

    // Has any come to its end?
    bool poll_all() {
        const auto is_ended = [](const Running& running) { return running.job->poll(); };
        const auto ended = std::find_if(running_.begin(), running_.end(), is_ended);
        if (ended == running_.end()) return false;
        const Running done = std::move(*ended);
        running_.erase(ended);
        start_some();  // the next one renders while this one is compared
        CheckOutcome& outcome = outcomes_[done.index];
        done.job->describe(outcome);
        if (!outcome.error) compare(done, outcome);
        is_done_[done.index] = true;
        return true;
    }

    void compare(const Running& done, CheckOutcome& outcome) const {
        PictureWish pictures;
        if (settings_.wants_pictures) pictures.stem = scratch_stems_[done.index];
        try {
            compare_frames(done.job->frames(), pictures, arena_, outcome);
        } catch (const InputError& error) {
            outcome.error = Error{ErrorKind::kSettings, error.what()};
        } catch (const OutputError& error) {
            outcome.error = Error{ErrorKind::kComparison, error.what()};
        }
    }

    void report_in_order() {
        for (; reported_ < outcomes_.size() && is_done_[reported_]; ++reported_)
            if (on_outcome_) on_outcome_(outcomes_[reported_]);
    }

    const RunSettings& settings_;
    const std::function<void(const CheckOutcome&)>& on_outcome_;
    std::vector<fs::path> stems_, scratch_stems_;
    std::vector<CheckOutcome> outcomes_;
    std::vector<bool> is_done_;
    std::vector<Running> running_;
    RenderSettings how_;
    parallel::Arena arena_;
    int jobs_ = 1;
    std::size_t next_ = 0, reported_ = 0;
};

}  // namespace

std::vector<CheckOutcome> run_checks(const std::vector<Check>& checks, const RunSettings& settings,
                                     const std::function<void(const CheckOutcome&)>& on_outcome,
                                     const std::atomic<bool>& cancelled) {
    Run run(checks, settings, on_outcome);
    std::vector<CheckOutcome> outcomes = run.finish(cancelled);
    if (!cancelled.load())
        accept({.update = settings.may_update, .bless = settings.may_bless}, outcomes, cancelled);
    return outcomes;
}

}  // namespace penumbra::check
