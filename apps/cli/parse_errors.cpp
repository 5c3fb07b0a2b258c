#include "apps/cli/parse_errors.h"

#include <fmt/format.h>

#include <string_view>

#include "apps/cli/command_table.h"
#include "core/json/node.h"

namespace penumbra::cli {
namespace {

// The command that was named, or else the program.
struct Place {
    CommandEntry entry;
    std::string path;  // "penumbra render"
    std::vector<std::string> extras;
    bool is_program = true;
};

Place place_of(const CLI::App& app) {
    const std::vector<CLI::App*> named = app.get_subcommands();
    if (named.empty()) return {describe(app), app.get_name(), app.remaining(), true};
    const CLI::App& command = *named.front();
    Place place{describe(command), app.get_name() + " " + command.get_name(), command.remaining(),
                false};
    if (place.extras.empty()) place.extras = app.remaining();  // what the command passed on
    return place;
}

std::string explain_extra(const Place& place) {
    const std::string& extra = place.extras.front();
    const std::string name = extra.substr(0, extra.find('='));
    if (extra.starts_with('-'))
        return fmt::format("{}: {} has no such option{}", name, place.path,
                           json::suggestion(name, place.entry.option_names()));
    if (place.is_program)
        return fmt::format("expected a command ({}), got \"{}\"{}",
                           fmt::join(place.entry.command_names(), ", "), extra,
                           json::suggestion(extra, place.entry.command_names()));
    return fmt::format("expected {}, got \"{}\" as well", place.entry.usage(place.path), extra);
}

std::string explain_missing(const Place& place, const std::string& message) {
    if (place.is_program)
        return fmt::format("expected a command: {}; {} --help explains them",
                           fmt::join(place.entry.command_names(), ", "), place.path);
    const std::string name = message.substr(0, message.find(" is required"));
    return fmt::format("{}: is missing, expected {}", name, place.entry.usage(place.path));
}

const OptionEntry* find_option(const Place& place, const std::string& name) {
    for (const OptionEntry& option : place.entry.options)
        for (const std::string& each : option.names)
            if (each == name) return &option;
    return nullptr;
}

// An option without its value, or with several: "--spp: At Most 1 required but received 2".
std::string explain_mismatch(const Place& place, const std::string& message) {
    constexpr std::string_view kAtMostOne = ": At Most 1 required but received ";
    if (const std::size_t at = message.find(kAtMostOne); at != std::string::npos)
        return fmt::format("{}: expected one value, got {}", message.substr(0, at),
                           message.substr(at + kAtMostOne.size()));
    const std::string name = message.substr(0, message.find(':'));
    const OptionEntry* const option = find_option(place, name);
    if (!option || !message.ends_with("missing")) return message;
    return fmt::format("{}: expected {}, got nothing", name, option->value);
}

// "Could not convert: --spp = 4.5"
std::string explain_conversion(const Place& place, const std::string& message) {
    constexpr std::string_view kBefore = ": ", kBetween = " = ";
    const std::size_t start = message.find(kBefore), end = message.find(kBetween);
    if (start == std::string::npos || end == std::string::npos || end < start) return message;
    const std::size_t name_start = start + kBefore.size();
    const std::string name = message.substr(name_start, end - name_start);
    const OptionEntry* const option = find_option(place, name);
    if (!option) return message;
    return fmt::format("{}: expected a {}number{}{}, got \"{}\"", name,
                       option->value == "N" ? "whole " : "", option->range.empty() ? "" : ", ",
                       option->range, message.substr(end + kBetween.size()));
}

// "--method: magic not in {ratio,stochastic}"
std::string explain_value(const std::string& message) {
    constexpr std::string_view kNotIn = " not in {";
    const std::size_t colon = message.find(": "), end = message.rfind(kNotIn);
    if (colon == std::string::npos || end == std::string::npos || end < colon) return message;
    std::string words = message.substr(end + kNotIn.size());
    if (words.ends_with('}')) words.pop_back();
    for (std::size_t comma = 0; (comma = words.find(',', comma)) != std::string::npos; comma += 2)
        words.insert(comma + 1, " ");
    return fmt::format("{}: expected one of {}, got \"{}\"", message.substr(0, colon), words,
                       message.substr(colon + 2, end - colon - 2));
}

}  // namespace

std::string explain(const CLI::ParseError& error, const CLI::App& app) {
    const Place place = place_of(app);
    std::string message = error.what();
    const std::string& kind = error.get_name();
    // Of this kind the library gives the program's name instead of the error's.
    const bool is_extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    // A misspelt option explains more than what is missing besides.
    const bool is_unknown = !place.extras.empty() &&
                            (is_extra || place.is_program || place.extras.front().starts_with('-'));
    if (is_unknown) return explain_extra(place);
    if (kind == "RequiredError") return explain_missing(place, message);
    if (kind == "ArgumentMismatch") return explain_mismatch(place, message);
    if (kind == "ConversionError") return explain_conversion(place, message);
    if (kind == "ValidationError") return explain_value(message);
    return message;
}

}  // namespace penumbra::cli
