#include "apps/check/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace penumbra::check {
namespace {

// Length of the UTF-8 sequence that begins here and stands for a character of XML; 0 if none does.
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return lead >= 0x20 || lead == '\t' || lead == '\n' || lead == '\r' ? 1 : 0;
    const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return 0;
    std::uint32_t code = lead & (0xffu >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
        code = code << 6 | (byte(i) & 0x3fu);
    }
    constexpr std::uint32_t kFirstOf[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
    const bool is_excluded = code == 0xfffe || code == 0xffff || code > 0x10ffff;
    return code < kFirstOf[length] || is_surrogate || is_excluded ? 0 : length;
}

std::string entity(char c) {
    switch (c) {
        case '&':
            return "&amp;";
        case '<':
            return "&lt;";
        case '>':
            return "&gt;";
        case '"':
            return "&quot;";
        case '\'':
            return "&apos;";
        case '\n':
            return "&#10;";
        case '\r':
            return "&#13;";
        case '\t':
            return "&#9;";
        default:
            return {c};
    }
}

struct Counts {
    int failures = 0, errors = 0;
};

Counts count(const std::vector<CheckOutcome>& outcomes) {
    Counts counts;
    for (const CheckOutcome& outcome : outcomes) {
        if (outcome.error)
            ++counts.errors;
        else if (!is_good(outcome.verdict()))
            ++counts.failures;
    }
    return counts;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
    return text;
}

std::string verdict_of(const CheckOutcome& outcome) {
    if (is_good(outcome.verdict())) return "";
    const std::vector<std::string> lines = problems(outcome);
    const std::string body =
        outcome.error && !outcome.log.empty() ? joined(lines) + "\n" + outcome.log : joined(lines);
    const std::string_view element = outcome.error ? "error" : "failure";
    const std::string_view type =
        outcome.error ? name(outcome.error->kind) : name(outcome.verdict());
    return fmt::format("      <{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n", element, type,
                       xml_escaped(lines.empty() ? "" : lines.front()), xml_escaped(body));
}

std::string test_case(const CheckOutcome& outcome) {
    const std::filesystem::path path(outcome.check.name);
    std::string folder = path.parent_path().generic_string();
    std::replace(folder.begin(), folder.end(), '/', '.');
    const std::string file = outcome.check.settings.empty() ? outcome.check.scene.string()
                                                            : outcome.check.settings.string();
    return fmt::format(
        "    <testcase classname=\"{}\" name=\"{}\" file=\"{}\" time=\"{:.3f}\">\n{}"
        "    </testcase>\n",
        xml_escaped(folder.empty() ? "penumbra" : folder), xml_escaped(path.filename().string()),
        xml_escaped(file), outcome.seconds, verdict_of(outcome));
}

}  // namespace

std::string xml_escaped(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        if (length == 0)
            result += "\xef\xbf\xbd";
        else if (length == 1)
            result += entity(text.front());
        else
            result += text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(1, length));
    }
    return result;
}

std::string junit_xml(const std::vector<CheckOutcome>& outcomes, double seconds) {
    const Counts counts = count(outcomes);
    const std::string totals =
        fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\" time=\"{:.3f}\"",
                    outcomes.size(), counts.failures, counts.errors, seconds);
    std::string xml = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"penumbra check\" {0}>\n"
        "  <testsuite name=\"penumbra check\" {0}>\n",
        totals);
    for (const CheckOutcome& outcome : outcomes) xml += test_case(outcome);
    return xml + "  </testsuite>\n</testsuites>\n";
}

}  // namespace penumbra::check
