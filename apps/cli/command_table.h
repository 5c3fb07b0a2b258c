#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

// What the program understands, as plain data: read off the declared commands and options, so that
// help, completions and the manual page say the same of all of them, of later ones too.

namespace penumbra::cli {

enum class ValueKind {
    kNone,        // a flag
    kText,        // anything
    kWord,        // one of `words`
    kWords,       // several of `words`, with commas
    kAssignment,  // WORD=VALUE
    kFile,        // with one of `endings`, or any
    kFolder,
};

struct OptionEntry {
    std::vector<std::string> names;  // "-o", "--output"; of a positional its name
    std::string value;               // what stands for its value: "PATTERN.exr"; "" for flags
    ValueKind kind = ValueKind::kNone;
    std::vector<std::string> words;
    std::vector<std::string> endings;  // without dots
    std::string range;                 // "1 to 64"
    std::string default_value;
    std::string description;
    std::string group;
    bool is_required = false;
    bool repeats = false;

    // The description with what else is to be known: words, range and default.
    [[nodiscard]] std::string explanation() const;
};

struct CommandEntry {
    std::string name;  // "penumbra", "render"
    std::string description;
    std::string footer;  // lines that are set as they are: examples, exit codes
    std::vector<OptionEntry> positionals;
    std::vector<OptionEntry> options;
    std::vector<CommandEntry> commands;

    [[nodiscard]] std::vector<std::string> option_names() const;
    [[nodiscard]] std::vector<std::string> command_names() const;
    // "penumbra render [OPTION]... [SCENE]"; `path` is what stands before the options.
    [[nodiscard]] std::string usage(const std::string& path) const;
};

// How an option's type name tells its kind: one or more words in braces ("{a,b}", "{a,b},...",
// "{a,b}=VALUE", as CLI::IsMember and option_checks.h say it); FOLDER; FILE; SCENE; IMAGE; or a
// name that ends in those of files ("FILE.json", "PATTERN.exr", "FILE.json|obj").
[[nodiscard]] CommandEntry describe(const CLI::App& app);

}  // namespace penumbra::cli
