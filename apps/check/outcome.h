#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/check/fitness.h"
#include "apps/check/selection.h"
#include "apps/check/settings.h"
#include "apps/diff/report.h"

// What became of the checks: plain data for the console, HTML, JUnit and JSON.

namespace penumbra::check {

// The gravest of a check's frames is the check's, in this order.
enum class Verdict {
    kPassed,
    kBlessed,  // there was no golden: the new render is it now
    kUpdated,  // the golden failed: the new render is it now
    kMissing,  // there is no golden
    kFailed,   // the comparison
    kUnfit,    // the golden, or the render that was to be one, proves nothing
    kError,    // nothing could be compared
};
[[nodiscard]] std::string_view name(Verdict verdict);
[[nodiscard]] bool is_good(Verdict verdict);

// Why nothing could be compared, each a kind of its own.
enum class ErrorKind {
    kSettings,   // NAME.check.json is wrong: exit code 2
    kScene,      // the scene, or an option of its rendering, is wrong: 2
    kRender,     // reading, writing or memory failed while rendering: 3
    kCrash,      // the renderer ended by a signal or with a code that means nothing: 3
    kTimeout,    // 3
    kComparison  // the images could not be read, or the golden not be written: 3
};
[[nodiscard]] std::string_view name(ErrorKind kind);

struct Error {
    ErrorKind kind;
    std::string message;  // one line
    [[nodiscard]] int exit_code() const;
};

struct FrameOutcome {
    std::string frame;  // "0012"; "" for the only one
    std::filesystem::path golden, render;
    Verdict verdict = Verdict::kPassed;
    std::string message{};                         // why it is unfit
    bool is_render_refused = false;                // the new picture cannot be the golden
    std::optional<diff::PairReport> comparison{};  // without pictures
    std::optional<Fitness> golden_fitness{}, render_fitness{};
    std::filesystem::path pictures{};  // a piece of HTML, where the run was asked for it
};

struct CheckOutcome {
    Check check;
    CheckSettings settings;
    std::vector<std::string> command;  // that rendered it
    double seconds = 0;                // of rendering
    std::vector<FrameOutcome> frames;
    std::optional<Error> error;
    std::string log;                    // what the renderer said
    std::vector<std::string> warnings;  // goldens without a frame

    [[nodiscard]] Verdict verdict() const;
    [[nodiscard]] int exit_code() const;  // 0, 1, 2 or 3
};

// The gravest code of all.
[[nodiscard]] int exit_code(const std::vector<CheckOutcome>& outcomes);

// What is wrong with a check, one line each, without its name: "flip of beauty is 0.1, above 0.02".
[[nodiscard]] std::vector<std::string> problems(const CheckOutcome& outcome);

// Where a picture differs most: "worst at 64,128 (64 x 64) of beauty: mean error 0.2"; "" if
// nothing does.
[[nodiscard]] std::string worst_place(const diff::PairReport& comparison);

}  // namespace penumbra::check
