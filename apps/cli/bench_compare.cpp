#include "apps/cli/bench_compare.h"

#include "apps/bench/report_reader.h"
#include "apps/cli/say.h"

namespace penumbra::cli {

std::optional<bench::Report> read_old_report(const BenchOptions& options) {
    if (options.compare.empty()) return std::nullopt;
    bench::Report report = bench::read_report(options.compare);
    bench::require_launches(report, options.compare);
    return report;
}

int judge(const bench::Comparison& comparison, const BenchOptions& options) {
    if (!options.fail_slower) return 0;
    const std::vector<bench::PassComparison> slower =
        bench::slower_beyond(comparison, *options.fail_slower);
    for (const bench::PassComparison& pass : slower)
        say(stderr, "{}/threads:{}/{}: {:.1f} % slower, more than {} %\n", pass.scene, pass.threads,
            pass.pass, 100 * pass.change, *options.fail_slower);
    return slower.empty() ? 0 : 1;
}

}  // namespace penumbra::cli
