// One launch of `penumbra bench` on one scene, in which one pass of the tiles does more work than
// it has to: so that it can be tried whether `--compare` finds that. The work is a fixed number of
// multiply-adds per tile (per tile, light and sample for `trace`; twice that for `rays`).
// Usage: slowed_bench SCENE WIDTH HEIGHT REPETITIONS PATIENCE PASS MULTIPLY_ADDS CALLS_OF|-
// OUT.json

#include <atomic>
#include <cstdio>
#include <optional>
#include <string>

#include "apps/bench/measure.h"
#include "apps/bench/report_reader.h"
#include "apps/bench/report_writer.h"
#include "core/image/publish.h"

namespace {

using namespace penumbra;

// Eight chains, none of which the compiler can shorten.
float multiply_adds(long count) {
    float sums[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    for (long i = 0; i < count / 8; ++i)
        for (float& sum : sums) sum = sum * 0.5f + 1.0f;
    float all = 0;
    for (const float sum : sums) all += sum;
    return all;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 10) {
        static_cast<void>(
            std::fputs("expected 9 arguments, see the source's first lines\n", stderr));
        return 2;
    }
    const std::string slowed = argv[6];
    const long work = std::stol(argv[7]);
    std::atomic<float> kept = 0;  // so that no compiler finds the work useless
    const renderer::PassObserver slow_down = [&](renderer::Pass pass) {
        if (renderer::name(pass) == slowed)
            kept.store(multiply_adds(work), std::memory_order_relaxed);
    };
    bench::BenchSettings settings{.scenes = {argv[1]}, .threads = {1}};
    settings.image.width = std::stoi(argv[2]);
    settings.image.height = std::stoi(argv[3]);
    settings.repetitions = std::stoi(argv[4]);
    settings.patience_seconds = std::stod(argv[5]);
    settings.execution.on_pass = &slow_down;
    std::optional<bench::Report> calls;
    if (std::string(argv[8]) != "-") calls = bench::read_report(argv[8]);
    if (calls) settings.calls_of = {&*calls};
    const std::atomic<bool> cancelled = false;
    const bench::Report report = bench::measure(settings, {}, cancelled, nullptr);
    image::write_file_atomically(argv[9], bench::benchmark_json(report));
    return 0;
}
