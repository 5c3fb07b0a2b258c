#include "apps/check/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <span>

#include "apps/diff/html_parts.h"
#include "apps/page/html.h"
#include "core/embedded_file.h"
#include "core/error.h"
#include "core/image/publish.h"

namespace penumbra::check {

// The files of apps/check/page; the build writes this function (cmake/EmbedFiles.cmake).
[[nodiscard]] std::span<const EmbeddedFile> embedded_files();

namespace {

using page::html_escaped;

std::string command_box(std::string_view label, const std::string& command) {
    if (command.empty()) return "";
    return fmt::format(
        "<div class=\"command\"><span>{}</span><code>{}</code><button class=\"copy\">Copy</button>"
        "</div>\n",
        label, html_escaped(command));
}

constexpr std::array<Verdict, 7> kGravestFirst = {
    Verdict::kError,   Verdict::kUnfit,   Verdict::kFailed, Verdict::kMissing,
    Verdict::kUpdated, Verdict::kBlessed, Verdict::kPassed};

// Buttons that show or hide the checks of a verdict.
std::string filter_bar(const std::vector<CheckOutcome>& outcomes) {
    std::string html = "<div class=\"bar filter\">";
    for (const Verdict verdict : kGravestFirst) {
        const auto count =
            std::count_if(outcomes.begin(), outcomes.end(),
                          [&](const CheckOutcome& each) { return each.verdict() == verdict; });
        if (count > 0)
            html += fmt::format(
                "<button data-verdict=\"{0}\" aria-pressed=\"true\"><span class=\"dot {0}\"></span>"
                "{1} {0}</button>",
                name(verdict), count);
    }
    return html + "<input type=\"search\" placeholder=\"name\" aria-label=\"name\"></div>\n";
}

std::string tolerance_of(const CheckSettings& settings) {
    if (!settings.tolerates_anything()) return "no difference at all";
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    for (const diff::Threshold& threshold : settings.thresholds)
        add(fmt::format("{} {} {:g}", diff::info(threshold.metric).name,
                        diff::info(threshold.metric).is_similarity ? "at least" : "at most",
                        threshold.limit));
    if (settings.pixel_threshold > 0)
        add(fmt::format("pixels count beyond {:g}", settings.pixel_threshold));
    for (const std::string& layer : settings.ignored_layers)
        add("layer " + layer + " not compared");
    if (!settings.mask.empty()) add("mask " + settings.mask.string());
    return fmt::format("{} &mdash; {}", html_escaped(text), html_escaped(settings.reason));
}

std::string facts_of(const CheckOutcome& outcome) {
    const std::string scene = outcome.settings.scene.empty() ? outcome.check.scene.string()
                                                             : outcome.settings.scene.string();
    std::string html = "<div class=\"files\">";
    if (!scene.empty()) html += fmt::format("scene {}, ", html_escaped(scene));
    html += "allowed: " + tolerance_of(outcome.settings);
    if (!outcome.command.empty())
        html +=
            fmt::format("<details><summary>rendered in {:.2f} s</summary><code>{}</code></details>",
                        outcome.seconds, html_escaped(shell_line(outcome.command)));
    return html + "</div>\n";
}

std::string troubles_of(const CheckOutcome& outcome) {
    std::string html;
    if (outcome.error)
        html += fmt::format("<p><b>{}</b> {}</p>\n", name(outcome.error->kind),
                            html_escaped(outcome.error->message));
    const bool is_said = outcome.error && outcome.error->exit_code() == 2;
    if (!outcome.log.empty() && !is_said)
        html += fmt::format("<pre>{}</pre>\n", html_escaped(outcome.log));
    for (const std::string& warning : outcome.warnings)
        html += fmt::format("<p>warning: {}</p>\n", html_escaped(warning));
    return html;
}

std::string frame_head(const FrameOutcome& frame) {
    std::string html;
    if (frame.verdict == Verdict::kMissing)
        html += fmt::format("<p><b>missing</b> there is no golden {}</p>\n",
                            html_escaped(frame.golden.string()));
    if (frame.verdict == Verdict::kUnfit)
        html += fmt::format("<p><b>unfit golden</b> {}</p>\n", html_escaped(frame.message));
    if (frame.verdict == Verdict::kUpdated || frame.verdict == Verdict::kBlessed)
        html += fmt::format("<p><b>{}</b> {} is the new picture now</p>\n", name(frame.verdict),
                            html_escaped(frame.golden.string()));
    return html;
}

void write_frame(const FrameOutcome& frame, image::PendingFile& file) {
    const auto write = [&](std::string_view text) {
        file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    };
    write("<section class=\"frame\" data-labels=\"golden,new,difference\">" + frame_head(frame));
    if (!frame.pictures.empty()) {
        std::ifstream stream(frame.pictures, std::ios::binary);
        if (!stream) throw OutputError(frame.pictures, "cannot be read any more");
        write(std::string{std::istreambuf_iterator<char>(stream), {}});
    }
    write("</section>\n");
}

void write_check(const CheckOutcome& outcome, const Invocation& invocation,
                 image::PendingFile& file) {
    const auto write = [&](const std::string& text) {
        file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    };
    const std::string_view verdict = name(outcome.verdict());
    write(
        fmt::format("<section class=\"check\" data-verdict=\"{0}\" data-name=\"{1}\">"
                    "<h2><span class=\"badge {0}\">{0}</span> {1}</h2>\n",
                    verdict, html_escaped(outcome.check.name)));
    write(facts_of(outcome) + troubles_of(outcome));
    write(command_box("accept:", accept_command(invocation, outcome)));
    write("<div class=\"frames\">");
    for (const FrameOutcome& frame : outcome.frames) write_frame(frame, file);
    write("</div></section>\n");
}

}  // namespace

void write_html_report(const std::filesystem::path& target,
                       const std::vector<CheckOutcome>& outcomes, const Invocation& invocation) {
    image::PendingFile file(target);
    const auto write = [&](const std::string& text) {
        file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    };
    write(diff::html_begin("penumbra check"));
    write(fmt::format("<style>\n{}</style>\n", content_of(embedded_files(), "check.css")));
    write(filter_bar(outcomes));
    write(command_box("to accept all of this:", accept_command(invocation, outcomes)));
    for (const Verdict verdict : kGravestFirst) {
        if (verdict == Verdict::kPassed) write("<div class=\"gallery\">\n");
        for (const CheckOutcome& outcome : outcomes)
            if (outcome.verdict() == verdict) write_check(outcome, invocation, file);
    }
    write("</div>\n");
    write(fmt::format("<script>\n{}</script>\n", content_of(embedded_files(), "check.js")));
    write(diff::html_end());
    file.publish();
}

}  // namespace penumbra::check
