#include "apps/cli/help_format.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>

#include "apps/cli/command_table.h"

namespace penumbra::cli {
namespace {

constexpr std::size_t kIndent = 2;
constexpr std::size_t kColumn = 32;  // where explanations begin

std::size_t line_width() {
    constexpr std::size_t kNarrowest = 60, kWidest = 100;
    winsize size{};
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kWidest;
    return std::clamp<std::size_t>(size.ws_col, kNarrowest, kWidest);
}

// `text` in lines of at most `width` bytes, all but the first behind `indent` blanks.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width) {
    std::string result;
    std::size_t column = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (column > 0 && column + 1 + word.size() > width - indent) {
            result += "\n" + std::string(indent, ' ');
            column = 0;
        } else if (column > 0) {
            result += ' ';
            ++column;
        }
        result += word;
        column += word.size();
    }
    return result;
}

std::string row(const std::string& name, const std::string& explanation, std::size_t width) {
    std::string text = std::string(kIndent, ' ') + name;
    const bool fits = text.size() + 2 <= kColumn;
    text += fits ? std::string(kColumn - text.size(), ' ') : "\n" + std::string(kColumn, ' ');
    return text + wrapped(explanation, kColumn, width) + "\n";
}

std::string name_of(const OptionEntry& option) {
    return fmt::format("{}{}{}", fmt::join(option.names, ", "), option.value.empty() ? "" : " ",
                       option.value);
}

// Groups in the order of their first options; the one of --help alone stands last.
std::vector<std::string> groups_of(const CommandEntry& command) {
    std::vector<std::string> groups;
    for (const OptionEntry& option : command.options)
        if (std::find(groups.begin(), groups.end(), option.group) == groups.end())
            groups.push_back(option.group);
    const auto is_alone =
        std::count_if(command.options.begin(), command.options.end(),
                      [&](const OptionEntry& option) { return option.group == groups.front(); });
    if (is_alone == 1) std::rotate(groups.begin(), groups.begin() + 1, groups.end());
    return groups;
}

}  // namespace

std::string HelpFormat::make_help(const CLI::App* app, std::string name,
                                  CLI::AppFormatMode /*mode*/) const {
    const CommandEntry command = describe(*app);
    const std::size_t width = line_width();
    std::string text = wrapped(command.description, 0, width) +
                       "\n\nUsage: " + wrapped(command.usage(name), 7, width) + "\n";
    if (!command.commands.empty()) text += "\nCommands:\n";
    for (const CommandEntry& each : command.commands)
        text += row(each.name, each.description, width);
    if (!command.positionals.empty()) text += "\n";
    for (const OptionEntry& positional : command.positionals)
        text += row(positional.names.front(), positional.explanation(), width);
    for (const std::string& group : groups_of(command)) {
        text += fmt::format("\n{}:\n", group);
        for (const OptionEntry& option : command.options)
            if (option.group == group) text += row(name_of(option), option.explanation(), width);
    }
    if (!command.footer.empty()) text += "\n" + command.footer + "\n";
    return text;
}

}  // namespace penumbra::cli
