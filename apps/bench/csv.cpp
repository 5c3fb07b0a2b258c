#include "apps/bench/csv.h"

#include <fmt/format.h>

namespace penumbra::bench {
namespace {

constexpr const char* kHeader =
    "scene,threads,pass,repetitions,median_ms,lower_quartile_ms,upper_quartile_ms,lowest_ms,"
    "highest_ms,cpu_median_ms,share,speed_up,efficiency,pixels_per_second,triangles_per_second,"
    "rays_per_second,bytes_per_second,limit,limit_call,limit_median_ms,fraction_of_limit,"
    "peak_memory_bytes\n";

// RFC 4180: in quotes where the text holds what separates cells, quotes doubled.
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"') result += '"';
        result += c;
    }
    return result + "\"";
}

std::string rate(double value) {
    return value > 0 ? fmt::format("{:.6g}", value) : "";
}

std::string limit_cells(const PassResult& pass) {
    if (pass.limit == LimitKind::kNone) return ",,,";
    return fmt::format("{},{},{:.6g},{:.6g}", name(pass.limit), quoted(pass.limit_call),
                       summarize(limit_milliseconds(pass)).median,
                       summarize(fractions(pass)).median);
}

std::string line(const SceneResult& scene, const ThreadRun& run, const PassResult& pass) {
    const Summary time = summarize(milliseconds(pass));
    const Throughput t = throughput(pass);
    return fmt::format(
        "{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{},{},{},"
        "{}\n",
        quoted(scene.name), run.threads, pass.name, pass.samples.size(), time.median,
        time.lower_quartile, time.upper_quartile, time.lowest, time.highest,
        summarize(thread_milliseconds(pass)).median, share(run, pass),
        speed_up(scene, run, pass.name), efficiency(scene, run, pass.name), rate(t.pixels),
        rate(t.triangles), rate(t.rays), rate(t.bytes), limit_cells(pass), scene.peak_memory_bytes);
}

}  // namespace

std::string csv(const Report& report) {
    std::string text = kHeader;
    for (const SceneResult& scene : report.scenes)
        for (const ThreadRun& run : scene.runs)
            for (const PassResult& pass : run.passes)
                if (!pass.samples.empty()) text += line(scene, run, pass);
    return text;
}

}  // namespace penumbra::bench
