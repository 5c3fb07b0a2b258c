#include "apps/bench/html_page.h"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "apps/bench/charts.h"
#include "apps/bench/table.h"
#include "apps/bench/undisturbed.h"
#include "apps/page/append.h"
#include "apps/page/html.h"
#include "core/embedded_file.h"

namespace penumbra::bench {

// The files of apps/bench/page; the build writes this function (cmake/EmbedFiles.cmake).
[[nodiscard]] std::span<const EmbeddedFile> embedded_files();

namespace {

using page::append;
using page::html_escaped;

std::string threads_in_words(int threads) {
    return fmt::format("{} thread{}", threads, threads == 1 ? "" : "s");
}

void append_fact(std::string& html, const char* what, const std::string& value) {
    if (!value.empty()) append(html, "<dt>{}</dt><dd>{}</dd>", what, html_escaped(value));
}

std::string caches(const Machine& machine) {
    std::string text;
    for (const Machine::Cache& cache : machine.caches)
        append(text, "{}L{} {} {}", text.empty() ? "" : ", ", cache.level, cache.type,
               binary_bytes(cache.bytes));
    return text;
}

std::string machine_facts(const Report& report) {
    const Machine& m = report.machine;
    std::string html = "<dl>";
    append_fact(html, "processor", fmt::format("{}, {} usable", m.processor, m.processors));
    if (m.megahertz > 0) append_fact(html, "clock", fmt::format("{:.0f} MHz", m.megahertz));
    append_fact(html, "caches", caches(m));
    append_fact(html, "instruction sets",
                fmt::format("kernels {}, ray tracer {}", m.kernel_isa, m.trace_isa));
    append_fact(html, "software", m.software);
    append_fact(html, "host", m.host);
    append_fact(html, "date", m.date);
    std::string load;
    for (const double average : m.load) append(load, "{}{:.2f}", load.empty() ? "" : ", ", average);
    append_fact(html, "load before", load);
    append_fact(html, "measured",
                fmt::format("{} warm-up and {} measured frames, {} launch{}", report.warmups,
                            report.repetitions, report.launches, report.launches == 1 ? "" : "es"));
    append_fact(html, "hardware counters", m.counters);
    return html + "</dl>\n";
}

std::string scene_facts(const SceneResult& scene) {
    const double pixels = static_cast<double>(scene.width) * scene.height;
    std::string html = "<dl>";
    append_fact(html, "file", scene.path);
    append_fact(html, "frame",
                fmt::format("{}, {} x {}, {:.0f} % covered", scene.frame, scene.width, scene.height,
                            100 * static_cast<double>(scene.covered_pixels) / pixels));
    append_fact(html, "holds",
                fmt::format("{} triangles, {} lights", scene.triangles, scene.lights));
    append_fact(
        html, "shadow rays",
        fmt::format("{:.2f} million, {} per pixel and light",
                    1e-6 * static_cast<double>(scene.shadow_rays), scene.samples_per_pixel));
    append_fact(html, "peak memory", binary_bytes(scene.peak_memory_bytes));
    return html + "</dl>\n";
}

std::string pass_row(const ThreadRun& run, const PassResult& pass) {
    const Summary time = summarize(milliseconds(pass));
    std::string html = fmt::format(
        "<tr{}><td>{}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.1f} %</td>",
        pass.parts.empty() ? "" : " class=\"group\"", pass.name, time.median, time.spread(),
        summarize(thread_milliseconds(pass)).median, 100 * share(run, pass));
    if (pass.limit == LimitKind::kNone)
        html += "<td></td><td></td>";
    else
        append(html, "<td>{:.2f}</td><td class=\"words\">{:.3f} ms, {}{}</td>",
               summarize(fractions(pass)).median, summarize(limit_milliseconds(pass)).median,
               name(pass.limit),
               pass.limit_call.empty() ? "" : fmt::format(" ({})", html_escaped(pass.limit_call)));
    append(html, "<td class=\"words\">{}</td></tr>\n", rates(pass));
    return html;
}

std::string pass_table(const ThreadRun& run) {
    std::string html =
        "<div class=\"scroll\"><table><tr><th>pass</th><th>ms</th><th>spread</th><th>CPU ms</th>"
        "<th>share</th><th>of limit</th><th class=\"words\">limit</th>"
        "<th class=\"words\">throughput</th></tr>\n";
    for (const PassResult& pass : run.passes)
        if (!pass.samples.empty()) html += pass_row(run, pass);
    return html + "</table></div>\n";
}

std::string run_details(const SceneResult& scene, const ThreadRun& run, bool is_open) {
    std::vector<PassResult> passes;
    std::vector<PassResult> groups;
    for (const PassResult& pass : run.passes)
        (pass.parts.empty() && pass.name != "frame" ? passes : groups).push_back(pass);
    const std::string others = disturbance(run);
    const std::string where = scene.name + ", " + threads_in_words(run.threads);
    return fmt::format(
        "<details{}><summary>{}</summary>\n{}<div class=\"scroll\">{}{}</div>\n{}</details>\n",
        is_open ? " open" : "", threads_in_words(run.threads),
        others.empty() ? "" : fmt::format("<p class=\"legend\">{}</p>\n", others),
        bar_chart(passes, where + ": passes"), bar_chart(groups, where + ": groups and frame"),
        pass_table(run));
}

std::string change_section(const SceneResult& scene, const Comparison& comparison) {
    std::string html;
    for (const ThreadRun& run : scene.runs) {
        std::vector<PassComparison> passes;
        for (const PassComparison& pass : comparison.passes)
            if (pass.scene == scene.name && pass.threads == run.threads) passes.push_back(pass);
        if (passes.empty()) continue;
        const std::string title = "Change with " + threads_in_words(run.threads);
        append(html, "<h3>{}</h3><div class=\"scroll\">{}</div>\n", title,
               change_chart(passes, scene.name + ": " + title));
    }
    return html;
}

std::string scene_section(const SceneResult& scene, std::size_t index,
                          const Comparison* comparison) {
    std::string html = fmt::format("<section id=\"scene{}\"><h2>{}</h2>\n{}", index,
                                   html_escaped(scene.name), scene_facts(scene));
    if (scene.runs.size() > 1)
        append(html, "<h3>Scaling</h3><div class=\"scroll\">{}{}</div>\n", speed_up_chart(scene),
               efficiency_chart(scene));
    if (comparison) html += change_section(scene, *comparison);
    html +=
        "<h3>Passes</h3>\n<p class=\"legend\"><span class=\"key bar\"></span> median, with the "
        "quartiles as whiskers <span class=\"key limit\"></span> the machine's limit for that "
        "work, measured in the same run. A fraction of 1 is as fast as the limit.</p>\n";
    for (const ThreadRun& run : scene.runs)
        html += run_details(scene, run, &run == &scene.runs.back());
    return html + "</section>\n";
}

// Radio buttons before the sections: the style sheet shows the section of the chosen one.
std::string scene_choice(const Report& report) {
    if (report.scenes.size() < 2) return "";
    std::string buttons;
    std::string rules = "<style>";
    for (std::size_t i = 0; i < report.scenes.size(); ++i) {
        append(buttons,
               "<input type=\"radio\" name=\"scene\" id=\"choose{0}\"{1}><label "
               "for=\"choose{0}\">{2}</label>\n",
               i, i == 0 ? " checked" : "", html_escaped(report.scenes[i].name));
        append(rules, "#choose{0}:not(:checked) ~ #scene{0} {{ display: none; }}\n", i);
    }
    return rules + "</style>\n" + buttons;
}

std::string comparison_notes(const Comparison& comparison) {
    std::string html = fmt::format(
        "<section><h2>Comparison</h2><p>{} launches then, {} now. Change of a pass's time where "
        "its "
        "limit's stays the same, with its 95 % interval.</p><ul>",
        comparison.old_launches, comparison.new_launches);
    for (const std::string& difference : comparison.differences)
        append(html, "<li>note: {}</li>", html_escaped(difference));
    for (const std::string& reason : comparison.left_out)
        append(html, "<li>not compared: {}</li>", html_escaped(reason));
    for (const PassComparison& pass : comparison.passes)
        if (pass.verdict != Verdict::kNoChange)
            append(html, "<li class=\"{}\">{}, {}, {}: {} by {:.1f} % ({:+.1f} to {:+.1f} %)</li>",
                   pass.verdict == Verdict::kSlower ? "failed" : "passed", html_escaped(pass.scene),
                   threads_in_words(pass.threads), pass.pass,
                   pass.verdict == Verdict::kSlower ? "slower" : "faster",
                   std::abs(100 * pass.change), 100 * pass.low, 100 * pass.high);
    return html + "</ul></section>\n";
}

}  // namespace

std::string html_page(const Report& report, const Comparison* comparison) {
    std::string html = page::html_begin("penumbra bench", page::Content::kStill,
                                        embedded_files().front().content());
    append(html, "<section>{}</section>\n", machine_facts(report));
    if (comparison) html += comparison_notes(*comparison);
    html += "<main>" + scene_choice(report);
    for (std::size_t i = 0; i < report.scenes.size(); ++i)
        html += scene_section(report.scenes[i], i, comparison);
    return html + "</main></body></html>\n";
}

}  // namespace penumbra::bench
