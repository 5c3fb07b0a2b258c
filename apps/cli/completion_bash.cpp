#include <fmt/format.h>

#include "apps/cli/completion.h"

namespace penumbra::cli {
namespace {

// Functions that the rest calls: they fill COMPREPLY from `current`, the word up to the cursor.
constexpr const char* kFunctions =
    R"bash(# Completes the command line of penumbra in bash. Written by `penumbra completion bash`.

# Those of the words that begin like the current one.
_penumbra_words() {
    mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current")
}

# The same for the last item of a list with commas.
_penumbra_list() {
    local before=
    [[ $current == *,* ]] && before=${current%,*},
    mapfile -t COMPREPLY < <(compgen -P "$before" -W "$1" -- "${current##*,}")
    compopt -o nospace 2>/dev/null
}

# WORD=, to be followed by a number.
_penumbra_assignment() {
    mapfile -t COMPREPLY < <(compgen -S = -W "$1" -- "$current")
    compopt -o nospace 2>/dev/null
}

# Folders, and files with one of these endings; any files where there is none.
_penumbra_files() {
    local file ending begin=${current//\\/}
    begin=${begin#[\"\']}
    compopt -o filenames 2>/dev/null
    while IFS= read -r file; do
        if [[ -z $1 || -d ${file/#\~/$HOME} ]]; then
            COMPREPLY+=("$file")
            continue
        fi
        for ending in $1; do
            [[ ${file,,} == *."$ending" ]] && COMPREPLY+=("$file")
        done
    done < <(compgen -f -- "$begin")
}

_penumbra_folders() {
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -d -- "$current")
}
)bash";

// Before the tables: finds the command, the number of the positional argument, and the option whose
// value is being written. A '=' is a word of its own in COMP_WORDS.
constexpr const char* kMain = R"bash(
_penumbra() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
    local command= position=0 i word
    COMPREPLY=()
    if [[ $current == = ]]; then
        current=
    elif [[ $previous == = ]]; then
        previous=${COMP_WORDS[COMP_CWORD-2]}
    fi
    for ((i = 1; i < COMP_CWORD; i++)); do
        word=${COMP_WORDS[i]}
        if _penumbra_has_value "$command" "$word"; then
            [[ ${COMP_WORDS[i+1]} == = ]] && ((i++))
            ((i++))
        elif [[ $word != -* ]]; then
            _penumbra_enter "$command" "$word" && position=0 || ((position++))
        fi
    done
    if _penumbra_has_value "$command" "$previous"; then
        _penumbra_value "$command" "$previous"
    elif [[ $current == -* ]]; then
        _penumbra_options "$command"
    else
        _penumbra_argument "$command" "$position"
    fi
}

complete -F _penumbra penumbra
)bash";

std::string joined(const std::vector<std::string>& words, const char* separator = " ") {
    return fmt::format("{}", fmt::join(words, separator));
}

std::string action_of(const OptionEntry& option) {
    switch (option.kind) {
        case ValueKind::kWord:
            return fmt::format("_penumbra_words '{}'", joined(option.words));
        case ValueKind::kWords:
            return fmt::format("_penumbra_list '{}'", joined(option.words));
        case ValueKind::kAssignment:
            return fmt::format("_penumbra_assignment '{}'", joined(option.words));
        case ValueKind::kFile:
            return fmt::format("_penumbra_files '{}'", joined(option.endings));
        case ValueKind::kFolder:
            return "_penumbra_folders";
        case ValueKind::kNone:
        case ValueKind::kText:
            break;
    }
    return ":";
}

// The bodies of the tables' `case`s; a command is called by its path: "", "render", "a b".
struct Tables {
    std::string commands, values, options, arguments;
};

void add_values(const CommandEntry& command, const std::string& path, Tables& tables) {
    for (const OptionEntry& option : command.options) {
        if (option.kind == ValueKind::kNone) continue;
        std::vector<std::string> patterns;
        for (const std::string& name : option.names)
            patterns.push_back(fmt::format("'{}:{}'", path, name));
        tables.values +=
            fmt::format("        {}) {} ;;\n", joined(patterns, " | "), action_of(option));
    }
}

void add_arguments(const CommandEntry& command, const std::string& path, Tables& tables) {
    if (!command.commands.empty())
        tables.arguments += fmt::format("        '{}:0') _penumbra_words '{}' ;;\n", path,
                                        joined(command.command_names()));
    for (std::size_t i = 0; i < command.positionals.size(); ++i) {
        const OptionEntry& positional = command.positionals[i];
        const std::string place =
            positional.repeats ? fmt::format("'{}:'*", path) : fmt::format("'{}:{}'", path, i);
        tables.arguments += fmt::format("        {}) {} ;;\n", place, action_of(positional));
    }
}

void add(const CommandEntry& command, const std::string& path, Tables& tables) {
    tables.options += fmt::format("        '{}') _penumbra_words '{}' ;;\n", path,
                                  joined(command.option_names()));
    add_values(command, path, tables);
    add_arguments(command, path, tables);
    for (const CommandEntry& each : command.commands) {
        const std::string inner = path.empty() ? each.name : path + " " + each.name;
        tables.commands +=
            fmt::format("        '{}:{}') command='{}' ;;\n", path, each.name, inner);
        add(each, inner, tables);
    }
}

std::string function(const char* comment, const char* name, const char* subject,
                     const std::string& cases) {
    return fmt::format("\n# {}\n{}() {{\n    case {} in\n{}        *) return 1 ;;\n    esac\n}}\n",
                       comment, name, subject, cases);
}

// The patterns of the options that take a value, with nothing to do.
std::string without_actions(const std::string& cases) {
    std::string result;
    for (std::size_t begin = 0; begin < cases.size();) {
        const std::size_t end = cases.find('\n', begin);
        result += cases.substr(begin, cases.find(')', begin) - begin) + ") ;;\n";
        begin = end + 1;
    }
    return result;
}

}  // namespace

std::string bash_completion(const CommandEntry& program) {
    Tables tables;
    add(program, "", tables);
    return kFunctions +
           function("COMMAND WORD: goes into the command that the word names.", "_penumbra_enter",
                    "$1:$2", tables.commands) +
           function("COMMAND OPTION: does the option take a value?", "_penumbra_has_value", "$1:$2",
                    without_actions(tables.values)) +
           function("COMMAND OPTION: completes its value.", "_penumbra_value", "$1:$2",
                    tables.values) +
           function("COMMAND: completes the name of an option.", "_penumbra_options", "$1",
                    tables.options) +
           function("COMMAND NUMBER: completes an argument that is no option.",
                    "_penumbra_argument", "$1:$2", tables.arguments) +
           kMain;
}

}  // namespace penumbra::cli
