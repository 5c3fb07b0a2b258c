#include "apps/check/accept.h"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "core/error.h"
#include "core/image/publish.h"
#include "core/scene/input_files.h"

namespace penumbra::check {
namespace {

// A golden of the run as it is, or as it would be.
struct Entry {
    CheckOutcome* outcome;
    FrameOutcome* frame;
    bool is_candidate;  // the render is to become the golden

    [[nodiscard]] const std::optional<Fitness>& fitness() const {
        return is_candidate ? frame->render_fitness : frame->golden_fitness;
    }
    void refuse(const std::string& why) const {
        frame->verdict = Verdict::kUnfit;
        frame->is_render_refused = is_candidate;
        frame->message = is_candidate ? fmt::format("the new render {}: it is not taken", why)
                                      : fmt::format("{} {}", frame->golden.string(), why);
    }
};

std::vector<Entry> entries_of(const Acceptance& acceptance, std::vector<CheckOutcome>& outcomes) {
    std::vector<Entry> entries;
    for (CheckOutcome& outcome : outcomes) {
        if (outcome.error) continue;
        for (FrameOutcome& frame : outcome.frames) {
            const bool is_candidate = (frame.verdict == Verdict::kFailed && acceptance.update) ||
                                      (frame.verdict == Verdict::kMissing && acceptance.bless);
            const Entry entry{&outcome, &frame, is_candidate};
            if (entry.fitness()) entries.push_back(entry);
        }
    }
    return entries;
}

using Twins = std::map<std::pair<std::uint64_t, std::uint64_t>, std::vector<Entry>>;

// A render that would repeat a golden is refused and the golden stays what it is.
void refuse_twins(const Twins& twins) {
    for (const auto& [digest, group] : twins)
        for (const Entry& entry : group)
            for (const Entry& other : group) {
                if (entry.frame == other.frame) continue;
                if (!entry.is_candidate && other.is_candidate) continue;
                entry.refuse(
                    fmt::format("has the same pixels as {}", other.frame->golden.string()));
                break;
            }
}

void write_golden(const Entry& entry) {
    InputFiles files;
    const std::string bytes = files.read(entry.frame->render);
    image::write_file_atomically(entry.frame->golden, std::string_view(bytes));
    entry.frame->verdict =
        entry.frame->verdict == Verdict::kMissing ? Verdict::kBlessed : Verdict::kUpdated;
}

}  // namespace

void accept(const Acceptance& acceptance, std::vector<CheckOutcome>& outcomes,
            const std::atomic<bool>& cancelled) {
    const std::vector<Entry> entries = entries_of(acceptance, outcomes);
    Twins twins;
    for (const Entry& entry : entries) {
        const Fitness& fitness = *entry.fitness();
        if (!fitness.problem.empty())
            entry.refuse(fitness.problem);
        else
            twins[{fitness.pixels.high, fitness.pixels.low}].push_back(entry);
    }
    refuse_twins(twins);
    for (const Entry& entry : entries) {
        if (cancelled) return;
        if (!entry.is_candidate || entry.frame->verdict == Verdict::kUnfit) continue;
        try {
            write_golden(entry);
        } catch (const std::runtime_error& error) {
            entry.outcome->error = Error{ErrorKind::kComparison, error.what()};
        }
    }
}

}  // namespace penumbra::check
