#include <fmt/format.h>

#include "apps/cli/completion.h"

namespace penumbra::cli {
namespace {

// Within single quotes, in the language of _arguments: what is special there gets a backslash.
std::string escaped(const std::string& text, std::string_view special) {
    std::string result;
    for (const char c : text) {
        if (c == '\'')
            result += "'\\''";
        else if (c == '\\' || special.find(c) != std::string_view::npos)
            result += std::string("\\") + c;
        else
            result += c;
    }
    return result;
}

// A single ending in parentheses would be a qualifier.
std::string files_of(const std::vector<std::string>& endings) {
    if (endings.empty()) return "_files";
    if (endings.size() == 1) return fmt::format("_files -g \"*.(#i){}\"", endings.front());
    return fmt::format("_files -g \"*.(#i)({})\"", fmt::join(endings, "|"));
}

std::string zsh_action(const OptionEntry& option) {
    switch (option.kind) {
        case ValueKind::kWord:
            return fmt::format("({})", fmt::join(option.words, " "));
        case ValueKind::kWords:
            return fmt::format("_sequence compadd - {}", fmt::join(option.words, " "));
        case ValueKind::kAssignment:
            return fmt::format(" compadd -S = -- {}", fmt::join(option.words, " "));
        case ValueKind::kFile:
            return files_of(option.endings);
        case ValueKind::kFolder:
            return "_files -/";
        case ValueKind::kNone:
        case ValueKind::kText:
            break;
    }
    return " ";
}

std::string zsh_value(const OptionEntry& option) {
    return fmt::format(":{}:{}", escaped(option.value, ":"), escaped(zsh_action(option), ":"));
}

// An option that is not repeatable is offered once: its names exclude each other and themselves.
std::string option_lines(const OptionEntry& option) {
    const bool has_value = option.kind != ValueKind::kNone;
    const std::string before =
        option.repeats ? "*" : fmt::format("({})", fmt::join(option.names, " "));
    std::string lines;
    for (const std::string& name : option.names) {
        const char* const attach = !has_value ? "" : name.starts_with("--") ? "=" : "+";
        lines +=
            fmt::format("        '{}{}{}[{}]{}' \\\n", before, name, attach,
                        escaped(option.explanation(), "[]"), has_value ? zsh_value(option) : "");
    }
    return lines;
}

std::string positional_line(const OptionEntry& positional) {
    const char* const count = positional.repeats ? "*" : positional.is_required ? "" : ":";
    return fmt::format("        '{}:{}:{}' \\\n", count, escaped(positional.names.front(), ":"),
                       escaped(zsh_action(positional), ":"));
}

std::string function_name(const std::string& path) {
    std::string name = "_penumbra";
    for (const char c : path) name += c == ' ' || c == '-' ? '_' : c;
    return name;
}

// After the options of a command that has others below it.
std::string dispatch(const CommandEntry& command, const std::string& path) {
    std::string names, cases;
    for (const CommandEntry& each : command.commands) {
        names += fmt::format("                '{}:{}'\n", each.name, escaped(each.description, ""));
        cases += fmt::format("                {}) {} && result=0 ;;\n", each.name,
                             function_name(path + " " + each.name));
    }
    return fmt::format(
        "    case $state in\n"
        "        command)\n"
        "            local -a commands=(\n{}            )\n"
        "            _describe -t commands command commands && result=0 ;;\n"
        "        arguments)\n"
        "            case $line[1] in\n{}            esac ;;\n"
        "    esac\n",
        names, cases);
}

std::string functions_of(const CommandEntry& command, const std::string& path) {
    std::string text;
    for (const CommandEntry& each : command.commands)
        text += functions_of(each, path + " " + each.name);
    const bool has_commands = !command.commands.empty();
    text += fmt::format(
        "\n{}() {{\n    local context state state_descr result=1\n    local -a line\n"
        "    local -A opt_args\n    _arguments -s {}\\\n",
        function_name(path), has_commands ? "-C " : "");
    for (const OptionEntry& option : command.options) text += option_lines(option);
    for (const OptionEntry& positional : command.positionals) text += positional_line(positional);
    if (has_commands) text += "        '1: :->command' \\\n        '*:: :->arguments' \\\n";
    text += "        && result=0\n";
    if (has_commands) text += dispatch(command, path);
    return text + "    return result\n}\n";
}

}  // namespace

std::string zsh_completion(const CommandEntry& program) {
    return "#compdef penumbra\n\n"
           "# Completes the command line of penumbra in zsh. Written by `penumbra completion "
           "zsh`.\n" +
           functions_of(program, "") + "\n_penumbra \"$@\"\n";
}

}  // namespace penumbra::cli
