#include "apps/check/accept_command.h"

#include <fmt/format.h>

#include <algorithm>

namespace penumbra::check {
namespace {

// More than so many checks are not named one by one: the run's own paths do it, and goldens that
// pass are left alone anyway.
constexpr std::size_t kMostNamed = 8;

bool is_plain(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=:,+@%").find(c) != std::string_view::npos;
}

// What find_checks() takes for this check.
std::string path_of(const Check& check) {
    const std::string path =
        check.settings.empty() ? check.scene.string() : check.settings.string();
    return path.starts_with('-') ? fmt::format("./{}", path) : path;  // no option
}

struct Needs {
    bool update = false, bless = false;
    [[nodiscard]] bool any() const { return update || bless; }
    void add(const Needs& other) {
        update = update || other.update;
        bless = bless || other.bless;
    }
};

Needs needs_of(const CheckOutcome& outcome) {
    Needs needs;
    if (outcome.error) return needs;
    for (const FrameOutcome& frame : outcome.frames) {
        const bool is_sound = frame.render_fitness && frame.render_fitness->problem.empty();
        if (!is_sound || frame.is_render_refused) continue;
        needs.bless = needs.bless || frame.verdict == Verdict::kMissing;
        // An unfit golden can be replaced where the new picture is another one.
        needs.update = needs.update ||
                       (frame.comparison && !frame.comparison->passed() && !is_good(frame.verdict));
    }
    return needs;
}

std::string command(const Invocation& invocation, const std::vector<std::string>& selection,
                    const Needs& needs) {
    if (!needs.any()) return "";
    std::vector<std::string> words{invocation.program, "check"};
    if (needs.update) words.emplace_back("--update");
    if (needs.bless) words.emplace_back("--bless-missing");
    words.insert(words.end(), invocation.options.begin(), invocation.options.end());
    words.insert(words.end(), selection.begin(), selection.end());
    return shell_line(words);
}

}  // namespace

std::string shell_quoted(std::string_view word) {
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return std::string(word);
    std::string quoted = "'";
    for (const char c : word) {
        if (c == '\'')
            quoted += "'\\''";
        else
            quoted += c;
    }
    quoted += '\'';
    return quoted;
}

std::string shell_line(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) {
        if (!line.empty()) line += ' ';
        line += shell_quoted(word);
    }
    return line;
}

std::string accept_command(const Invocation& invocation,
                           const std::vector<CheckOutcome>& outcomes) {
    Needs needs;
    std::vector<std::string> paths;
    for (const CheckOutcome& outcome : outcomes) {
        const Needs own = needs_of(outcome);
        needs.add(own);
        if (own.any()) paths.push_back(path_of(outcome.check));
    }
    return command(invocation, paths.size() > kMostNamed ? invocation.selection : paths, needs);
}

std::string accept_command(const Invocation& invocation, const CheckOutcome& outcome) {
    return command(invocation, {path_of(outcome.check)}, needs_of(outcome));
}

}  // namespace penumbra::check
