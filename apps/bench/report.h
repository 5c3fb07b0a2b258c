#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/profile/work.h"

// What `penumbra bench` measured: everything that the table, the JSON, the CSV and the page show,
// as plain numbers per repetition. Medians, fractions and speed-ups are derived from them by the
// functions below and stored nowhere.

namespace penumbra::bench {

using profile::LimitKind;
[[nodiscard]] std::string name(LimitKind kind);  // "primary rays", ...

// One repetition of one pass, and of its limit in the same repetition.
struct Sample {
    double milliseconds = 0;         // what the pass costs a frame: docs/bench.md, "two clocks"
    double thread_milliseconds = 0;  // of all threads together
    double limit_milliseconds = 0;   // 0 if the pass has none
    int launch = 0;                  // which start of the program; 0 where there was one
    // What the pass and its limit cost where nothing disturbs them (floors.h): the same in all
    // repetitions of a launch; 0 where unknown.
    double floor_milliseconds = 0, limit_floor_milliseconds = 0;
    double core_share = 0;  // while it was measured: core_share.h; 0 where unknown
};

struct PassResult {
    std::string name;  // "rasterize", a group of passes "visibility", the whole "frame"
    std::vector<std::string> parts;  // of a group: the names of its passes; empty for a pass
    bool is_tile_pass = false;       // runs fused with others, tile by tile
    profile::Work work;              // per frame
    LimitKind limit = LimitKind::kNone;
    std::string limit_call;       // the quickest way found: "stream", "8-packets", "avx512"
    std::vector<Sample> samples;  // one per repetition, all passes of a run equally many
};

// Of the whole process, over the frames of one run, per frame; absent where the system does not
// permit to count.
struct HardwareCounters {
    std::uint64_t cycles = 0;
    std::uint64_t instructions = 0;
    std::uint64_t cache_misses = 0;  // last level
};

// A scene with one number of threads.
struct ThreadRun {
    int threads = 0;
    std::vector<PassResult> passes;  // in the frame's order; then groups; last the frame
    std::optional<HardwareCounters> counters;
};

struct SceneResult {
    std::string name;  // unique in the report: "sponza"; "built-in"
    std::string path;  // as the user wrote it; empty for the built-in scene
    int frame = 0;
    int width = 0, height = 0;
    int samples_per_pixel = 0;
    std::uint64_t triangles = 0;
    std::uint64_t lights = 0;
    std::uint64_t shadow_rays = 0;  // per frame
    std::uint64_t covered_pixels = 0;
    std::uint64_t peak_memory_bytes = 0;  // resident, of reading and rendering, limits left out
    std::vector<ThreadRun> runs;          // in the order of the threads asked for
};

struct Machine {
    std::string processor;  // "AMD EPYC"
    std::string host;
    std::string date;         // ISO 8601, local time with offset
    int processors = 0;       // that this process may use
    bool is_scaling = false;  // may the system change the processors' clock to save power?
    double megahertz = 0;     // as the system tells; 0 if it does not
    std::string kernel_isa;   // of penumbra's kernels: "avx512"
    std::string trace_isa;    // of the ray tracer, both in frames and limits
    std::string software;     // "penumbra 0.1.0"
    std::string counters;     // "available", or why there are none
    struct Cache {
        int level = 0;
        std::string type;  // "Data", "Instruction", "Unified"
        std::uint64_t bytes = 0;
        int sharing = 0;  // processors
    };
    std::vector<Cache> caches;
    std::vector<double> load;  // averages over 1, 5, 15 minutes at the start
};

struct Report {
    Machine machine;
    int warmups = 0;
    int repetitions = 0;
    int launches = 1;
    std::vector<SceneResult> scenes;
};

// ---- derived

// Between the sorted values, linearly: position 0 is the lowest, 1 the highest.
[[nodiscard]] double quantile(const std::vector<double>& sorted, double position);

// Of any samples; the spread is the distance between the quartiles (linear interpolation).
struct Summary {
    double median = 0, lower_quartile = 0, upper_quartile = 0;
    double mean = 0, deviation = 0;  // standard deviation, n - 1
    double lowest = 0, highest = 0;
    [[nodiscard]] double spread() const { return upper_quartile - lower_quartile; }
    [[nodiscard]] double variation() const { return mean > 0 ? deviation / mean : 0; }
};
[[nodiscard]] Summary summarize(std::vector<double> values);  // at least one

[[nodiscard]] std::vector<double> milliseconds(const PassResult& pass);
[[nodiscard]] std::vector<double> thread_milliseconds(const PassResult& pass);
[[nodiscard]] std::vector<double> limit_milliseconds(const PassResult& pass);

// limit / pass of each repetition: 1 is as fast as the limit. Empty without a limit.
[[nodiscard]] std::vector<double> fractions(const PassResult& pass);

// Of a run: the pass with that name, or null.
[[nodiscard]] const PassResult* find(const ThreadRun& run, const std::string& pass);
[[nodiscard]] const PassResult& whole_frame(const ThreadRun& run);

// The part of the frame's median that the pass's median takes, 0 to 1.
[[nodiscard]] double share(const ThreadRun& run, const PassResult& pass);

// Work per second at the median time; 0 where the pass has no such work.
struct Throughput {
    double pixels = 0, triangles = 0, rays = 0, bytes = 0;
};
[[nodiscard]] Throughput throughput(const PassResult& pass);

// How many times as fast a pass is as in the scene's run with the fewest threads, and that per
// added thread: speed_up * fewest / threads.
[[nodiscard]] double speed_up(const SceneResult& scene, const ThreadRun& run,
                              const std::string& pass);
[[nodiscard]] double efficiency(const SceneResult& scene, const ThreadRun& run,
                                const std::string& pass);

// "sponza/threads:2/trace": the name of a benchmark in JSON and CSV.
[[nodiscard]] std::string benchmark_name(const SceneResult& scene, const ThreadRun& run,
                                         const PassResult& pass);

}  // namespace penumbra::bench
