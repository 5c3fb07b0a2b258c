#include "apps/cli/manual_page.h"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>

namespace penumbra::cli {
namespace {

// The code point at the begin of `text`, which loses it. Not UTF-8: the byte.
std::uint32_t take_code_point(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t length = byte(0) < 0xc0 ? 1 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
    std::uint32_t point = length == 1 ? byte(0) : byte(0) & (0x7fu >> length);
    if (length > text.size()) {
        text = {};
        return '?';
    }
    for (std::size_t i = 1; i < length; ++i) point = point << 6 | (byte(i) & 0x3f);
    text.remove_prefix(length);
    return point;
}

// Text as roff shows it: hyphens that can be copied, nothing taken for a request.
std::string roff(std::string_view text) {
    std::string result;
    bool begins_line = true;
    while (!text.empty()) {
        const std::uint32_t c = take_code_point(text);
        if (begins_line && (c == '.' || c == '\'')) result += "\\&";
        begins_line = c == '\n';
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else if (c == '\'')
            result += "\\(aq";
        else if (c == '`')
            result += "\\(ga";
        else if (c >= 128)
            result += fmt::format("\\[u{:04X}]", c);
        else
            result += static_cast<char>(c);
    }
    return result;
}

std::string tagged(const OptionEntry& option) {
    std::string names;
    for (const std::string& name : option.names)
        names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
    if (!option.value.empty() && option.names.front().starts_with('-'))
        names += fmt::format(" \\fI{}\\fR", roff(option.value));
    return fmt::format(".TP\n{}\n{}\n", names, roff(option.explanation()));
}

// Lines that are set as they are.
std::string verbatim(const std::string& text) {
    return text.empty() ? "" : ".PP\n.nf\n" + roff(text) + "\n.fi\n";
}

std::string options_of(const CommandEntry& command) {
    std::string text;
    for (const OptionEntry& positional : command.positionals) text += tagged(positional);
    for (const OptionEntry& option : command.options) text += tagged(option);
    return text;
}

std::string sections_of(const CommandEntry& command, const std::string& path) {
    std::string text;
    for (const CommandEntry& each : command.commands) {
        const std::string name = path + " " + each.name;
        text += fmt::format(".SS {}\n{}.\n.PP\n.B {}\n{}{}", roff(name), roff(each.description),
                            roff(each.usage(name)), options_of(each), verbatim(each.footer));
        text += sections_of(each, name);
    }
    return text;
}

}  // namespace

std::string manual_page(const CommandEntry& program, const std::string& version) {
    return fmt::format(
        ".\\\" Written by `penumbra manual`.\n"
        ".TH PENUMBRA 1 \"\" \"penumbra {}\" \"User Commands\"\n"
        ".SH NAME\npenumbra \\- direct light from area lights with soft shadows\n"
        ".SH SYNOPSIS\n.B {}\n"
        ".SH DESCRIPTION\n{}\n{}"
        ".SH OPTIONS\n{}"
        ".SH COMMANDS\n{}",
        roff(version), roff(program.usage(program.name)), roff(program.description),
        verbatim(program.footer), options_of(program), sections_of(program, program.name));
}

}  // namespace penumbra::cli
