#include "apps/cli/command_table.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <string_view>

namespace penumbra::cli {
namespace {

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> pieces;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(separator), text.size());
        if (end > 0) pieces.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return pieces;
}

// Names of values that say which files are meant.
const std::map<std::string, std::vector<std::string>, std::less<>>& known_files() {
    static const std::vector<std::string> kScenes = {"json", "obj"};
    static const std::map<std::string, std::vector<std::string>, std::less<>> kFiles = {
        {"FILE", {}},       {"PATH", {}},        {"PATHS", {}},
        {"SCENE", kScenes}, {"SCENES", kScenes}, {"IMAGE", {"exr", "hdr", "png", "jpg", "jpeg"}}};
    return kFiles;
}

void find_files(OptionEntry& entry) {
    const std::size_t dot = entry.value.rfind('.');
    const auto known = known_files().find(entry.value);
    if (entry.value == "FOLDER") {
        entry.kind = ValueKind::kFolder;
    } else if (known != known_files().end()) {
        entry.kind = ValueKind::kFile;
        entry.endings = known->second;
    } else if (dot != std::string::npos && dot + 1 < entry.value.size()) {
        entry.kind = ValueKind::kFile;
        entry.endings = split(std::string_view(entry.value).substr(dot + 1), '|');
    }
}

// `rest` is what the validators say: words in braces, or a range.
void find_words(OptionEntry& entry, std::string_view rest) {
    const std::size_t open = rest.find('{'), close = rest.find('}');
    if (open == std::string_view::npos || close == std::string_view::npos) {
        entry.range = rest;
        return;
    }
    entry.words = split(rest.substr(open + 1, close - open - 1), ',');
    const std::string_view after = rest.substr(close + 1);
    entry.kind = after.starts_with('=')   ? ValueKind::kAssignment
                 : after.starts_with(',') ? ValueKind::kWords
                                          : ValueKind::kWord;
}

// The library's names of types, in words for users.
std::string value_name(const std::string& type, ValueKind kind) {
    static const std::map<std::string, std::string> kNames = {
        {"INT", "N"}, {"UINT", "N"}, {"FLOAT", "X"}};
    if (const auto name = kNames.find(type); name != kNames.end()) return name->second;
    if (type != "TEXT" || kind == ValueKind::kText) return type;
    return kind == ValueKind::kWord ? "NAME" : kind == ValueKind::kWords ? "LIST" : "NAME=VALUE";
}

OptionEntry describe_option(const CLI::Option& option) {
    OptionEntry entry;
    if (option.nonpositional()) {
        for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
        for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
    } else {
        entry.names.push_back(option.get_name(true));
    }
    entry.description = option.get_description();
    entry.group = option.get_group();
    entry.is_required = option.get_required();
    if (option.get_items_expected_max() == 0) return entry;

    const std::string type = option.get_type_name();
    const std::size_t colon = std::min(type.find(':'), type.size());
    entry.kind = ValueKind::kText;
    if (colon < type.size()) find_words(entry, std::string_view(type).substr(colon + 1));
    entry.value = value_name(type.substr(0, colon), entry.kind);
    if (!option.nonpositional() && entry.value == "TEXT") entry.value = entry.names.front();
    if (entry.kind == ValueKind::kText) find_files(entry);
    entry.repeats = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
    if (option.get_default_str() != "[]") entry.default_value = option.get_default_str();
    return entry;
}

bool mentions_all(const std::string& text, const std::vector<std::string>& words) {
    return std::all_of(words.begin(), words.end(), [&](const std::string& word) {
        return text.find(word) != std::string::npos;
    });
}

}  // namespace

// A description may end in a default that is no value, in brackets: what is added stands before it.
std::string OptionEntry::explanation() const {
    const std::size_t bracket =
        description.ends_with(']') ? description.rfind(" [") : description.size();
    std::string text = description.substr(0, bracket);
    if (!words.empty() && !mentions_all(description, words))
        text += fmt::format(": {}", fmt::join(words, ", "));
    if (!range.empty() && description.find(range) == std::string::npos)
        text += fmt::format(", {}", range);
    if (bracket < description.size()) return text + description.substr(bracket);
    if (!default_value.empty()) text += fmt::format(" [{}]", default_value);
    return text;
}

std::vector<std::string> CommandEntry::option_names() const {
    std::vector<std::string> all;
    for (const OptionEntry& option : options)
        all.insert(all.end(), option.names.begin(), option.names.end());
    return all;
}

std::vector<std::string> CommandEntry::command_names() const {
    std::vector<std::string> all;
    for (const CommandEntry& command : commands) all.push_back(command.name);
    return all;
}

std::string CommandEntry::usage(const std::string& path) const {
    std::string text = path;
    if (!commands.empty()) text += " COMMAND";
    text += " [OPTION]...";
    for (const OptionEntry& positional : positionals)
        text += fmt::format(fmt::runtime(positional.is_required ? " {}{}" : " [{}]{}"),
                            positional.names.front(), positional.repeats ? "..." : "");
    return text;
}

CommandEntry describe(const CLI::App& app) {
    CommandEntry entry;
    entry.name = app.get_name();
    entry.description = app.get_description();
    entry.footer = app.get_footer();
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_group().empty()) continue;  // hidden
        (option->nonpositional() ? entry.options : entry.positionals)
            .push_back(describe_option(*option));
    }
    for (const CLI::App* command : app.get_subcommands({}))
        if (!command->get_name().empty() && !command->get_group().empty())
            entry.commands.push_back(describe(*command));
    return entry;
}

}  // namespace penumbra::cli
