#include "apps/cli/option_checks.h"

#include <fmt/format.h>

#include <limits>
#include <map>

#include "core/error.h"

namespace penumbra::cli {
namespace {

// One name for a file, whatever links and dots lead to it.
std::string identity(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(path, error);
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(absolute, error);
    return (error ? absolute.lexically_normal() : canonical).string();
}

CLI::Validator only_said(const std::vector<std::string>& words, const char* after) {
    return CLI::Validator([](const std::string&) { return std::string(); },
                          fmt::format("{{{}}}{}", fmt::join(words, ","), after));
}

}  // namespace

CLI::Validator in_range(double low, double high) {
    const std::string range = high < std::numeric_limits<double>::max()
                                  ? fmt::format("{} to {}", low, high)
                                  : fmt::format("{} or more", low);
    return CLI::Validator(
        [low, high, range](const std::string& text) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return {};
            return fmt::format("expected a number, {}, got \"{}\"", range, text);
        },
        range);
}

CLI::Validator list_of(const std::vector<std::string>& words) {
    return only_said(words, ",...");
}

CLI::Validator value_of(const std::vector<std::string>& words) {
    return only_said(words, "=VALUE");
}

void refuse_empty_values(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options())
        for (const std::string& value : option->results())
            if (value.empty())
                throw InputError(
                    fmt::format("{}: expected a value, got an empty text", option->get_name()));
}

void require_distinct(const std::vector<PlannedFile>& outputs,
                      const std::vector<std::filesystem::path>& inputs) {
    std::map<std::string, std::string> taken;  // identity -> who has it
    for (const std::filesystem::path& input : inputs) taken.emplace(identity(input), "an input");
    for (const auto& [option, path] : outputs) {
        const auto [place, is_new] = taken.emplace(identity(path), "written by " + option);
        if (!is_new)
            throw InputError(fmt::format(
                "{}: expected a file of its own, but {} is {}", option, path.string(),
                place->second == "written by " + option ? "named twice" : place->second));
    }
}

void require_endings(const std::vector<PlannedFile>& reports) {
    static const std::map<std::string, std::string> kEndings = {{"--html", ".html"},
                                                                {"--json", ".json"},
                                                                {"--trace", ".json"},
                                                                {"--junit", ".xml"},
                                                                {"--csv", ".csv"}};
    for (const auto& [option, path] : reports) {
        const auto ending = kEndings.find(option);
        if (ending != kEndings.end() && !path.string().ends_with(ending->second))
            throw InputError(fmt::format("{}: expected a name that ends in {}, got \"{}\"", option,
                                         ending->second, path.string()));
    }
}

}  // namespace penumbra::cli
