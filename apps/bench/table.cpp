#include "apps/bench/table.h"

#include <fmt/format.h>

#include <iterator>
#include <vector>

#include "apps/bench/undisturbed.h"
#include "apps/page/append.h"

namespace penumbra::bench {
namespace {

using page::append;

// Three digits that matter: "0.123", "1.23", "123".
std::string short_number(double value) {
    const int digits = value >= 99.95 ? 0 : value >= 9.995 ? 1 : value >= 0.9995 ? 2 : 3;
    return fmt::format("{:.{}f}", value, digits);
}

std::string machine_lines(const Report& report) {
    const Machine& machine = report.machine;
    std::string text =
        fmt::format("{}: {}, {} processors, kernels {}, ray tracer {}\n", machine.software,
                    machine.processor, machine.processors, machine.kernel_isa, machine.trace_isa);
    append(text, "{} warm-up and {} measured frames per row; median and distance of quartiles\n",
           report.warmups, report.repetitions);
    append(text, "hardware counters: {}\n", machine.counters);
    return text;
}

std::string scene_line(const SceneResult& scene) {
    const double pixels = static_cast<double>(scene.width) * scene.height;
    return fmt::format(
        "{}, frame {}: {} x {}, {:.0f} % covered, {} triangles, {} lights, {:.2f} Mray, peak "
        "memory {}\n",
        scene.name, scene.frame, scene.width, scene.height,
        100 * static_cast<double>(scene.covered_pixels) / pixels, scene.triangles, scene.lights,
        1e-6 * static_cast<double>(scene.shadow_rays), binary_bytes(scene.peak_memory_bytes));
}

std::string limit_cell(const PassResult& pass) {
    if (pass.limit == LimitKind::kNone) return "";
    const std::string call = pass.limit_call.empty() ? "" : " (" + pass.limit_call + ")";
    return fmt::format("{} ms, {}{}", short_number(summarize(limit_milliseconds(pass)).median),
                       name(pass.limit), call);
}

void append_row(const ThreadRun& run, const PassResult& pass, std::string& text) {
    const Summary time = summarize(milliseconds(pass));
    const std::vector<double> ratio = fractions(pass);
    append(text, "  {:<11} {:>8} {:>7} {:>8} {:>6.1f} {:>9}  {:<34} {}\n", pass.name,
           short_number(time.median), short_number(time.spread()),
           short_number(summarize(thread_milliseconds(pass)).median), 100 * share(run, pass),
           ratio.empty() ? "" : fmt::format("{:.2f}", summarize(ratio).median), rates(pass),
           limit_cell(pass));
}

void append_run(const ThreadRun& run, std::string& text) {
    append(text, "\n  {:<11} {:>8} {:>7} {:>8} {:>6} {:>9}  {:<34} {}\n",
           fmt::format("{} thread{}", run.threads, run.threads == 1 ? "" : "s"), "ms", "spread",
           "CPU ms", "share", "of limit", "throughput", "limit");
    for (const PassResult& pass : run.passes)
        if (!pass.samples.empty()) append_row(run, pass, text);
    if (const std::string others = disturbance(run); !others.empty())
        append(text, "  {}\n", others);
    if (run.counters)
        append(text,
               "  per frame: {:.3f} Gcycle, {:.3f} Ginstruction ({:.2f} per cycle), {:.2f} M "
               "misses of the last cache\n",
               1e-9 * static_cast<double>(run.counters->cycles),
               1e-9 * static_cast<double>(run.counters->instructions),
               static_cast<double>(run.counters->instructions) /
                   static_cast<double>(std::max<std::uint64_t>(run.counters->cycles, 1)),
               1e-6 * static_cast<double>(run.counters->cache_misses));
}

// Speed-up and efficiency per pass over the runs.
void append_scaling(const SceneResult& scene, std::string& text) {
    if (scene.runs.size() < 2) return;
    append(text, "\n  {:<11}", "speed-up");
    for (const ThreadRun& run : scene.runs)
        append(text, " {:>16}", fmt::format("{} threads", run.threads));
    text += '\n';
    for (const PassResult& pass : scene.runs.front().passes) {
        if (pass.samples.empty() || pass.name == "other") continue;
        append(text, "  {:<11}", pass.name);
        for (const ThreadRun& run : scene.runs)
            append(text, " {:>16}",
                   fmt::format("{:.2f} ({:.0f} %)", speed_up(scene, run, pass.name),
                               100 * efficiency(scene, run, pass.name)));
        text += '\n';
    }
}

}  // namespace

std::string binary_bytes(std::uint64_t bytes) {
    static constexpr const char* kUnits[] = {"B", "KiB", "MiB", "GiB", "TiB"};
    auto value = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (value >= 1000 && unit + 1 < std::size(kUnits)) {
        value /= 1024;
        ++unit;
    }
    return fmt::format("{} {}", short_number(value), kUnits[unit]);
}

std::string rates(const PassResult& pass) {
    const Throughput t = throughput(pass);
    std::string text;
    const auto add = [&](double rate, const char* unit) {
        if (rate <= 0) return;
        if (!text.empty()) text += ", ";
        text += short_number(rate) + " " + unit;
    };
    add(1e-6 * t.pixels, "Mpixel/s");
    add(1e-6 * t.triangles, "Mtriangle/s");
    add(1e-6 * t.rays, "Mray/s");
    add(1e-9 * t.bytes, "GB/s");
    return text;
}

std::string table(const Report& report) {
    std::string text = machine_lines(report);
    for (const SceneResult& scene : report.scenes) {
        text += '\n';
        text += scene_line(scene);
        for (const ThreadRun& run : scene.runs) append_run(run, text);
        append_scaling(scene, text);
    }
    return text;
}

}  // namespace penumbra::bench
