#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <thread>

#include "apps/tools/ltc_fit/grid.h"
#include "apps/tools/ltc_fit/measure.h"
#include "core/error.h"

// Makes core/light/ltc_table_data.inc (two minutes of one core), or measures the table that this
// program was built with.

namespace penumbra::ltc_fit {
namespace {

using Table = std::vector<TableRow>;

// Roughnesses are independent of each other, so the result does not depend on the number of
// threads.
Table fit_table(const FitSettings& settings) {
    std::vector<std::vector<TableRow>> by_roughness(kLtcRoughnessNodes);
    const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const auto work = [&](int first) {
        for (int index = first; index < kLtcRoughnessNodes; index += threads)
            by_roughness[static_cast<std::size_t>(index)] = table_rows(index, settings);
    };
    std::vector<std::jthread> pool;
    pool.reserve(static_cast<std::size_t>(threads));
    for (int thread = 0; thread < threads; ++thread) pool.emplace_back(work, thread);
    pool.clear();
    Table table;
    for (const auto& rows : by_roughness) table.insert(table.end(), rows.begin(), rows.end());
    return table;
}

void write_table(const std::string& path, const Table& table) {
    std::ofstream out(path);
    out << "// Generated: ltc_fit core/light/ltc_table_data.inc\n";
    for (const TableRow& row : table) {
        for (const float value : row) out << fmt::format("{:.9g},", value + 0.0f);
        out << '\n';
    }
    if (!out.flush()) throw OutputError(path, "cannot write");
}

void print(std::string_view name, const MeanAndMaximum& values) {
    fmt::print("{:24} mean {:.6f}  max {:.6f}\n", name, values.mean(), values.maximum);
}

void print_table_errors(const float* table, double largest_degrees) {
    const TableErrors errors = table_errors(table, largest_degrees);
    fmt::print("{} lobes, up to {} degrees\n", errors.albedo.count, largest_degrees);
    print("  relative L1", errors.relative_l1);
    print("  relative L2", errors.relative_l2);
    print("  albedo", errors.albedo);
    print("  Fresnel-weighted albedo", errors.fresnel);
}

void print_measurements(const float* table) {
    constexpr int kLights = 640;
    constexpr int kResolution = 768;
    print_table_errors(table, 89);
    print_table_errors(table, 80);
    print(fmt::format("radiance of {} lights", kLights),
          polygon_errors(table, 0, kLights, kResolution));
}

int run(int argc, char** argv) {
    const std::string argument = argc == 2 ? argv[1] : "";
    if (argument.empty() || (argument[0] == '-' && argument != "--measure"))
        throw InputError("usage: ltc_fit OUTPUT.inc | ltc_fit --measure");
    if (argument == "--measure")
        print_measurements(kLtcTable);
    else
        write_table(argument, fit_table({}));
    return 0;
}

}  // namespace
}  // namespace penumbra::ltc_fit

int main(int argc, char** argv) {
    try {
        return penumbra::ltc_fit::run(argc, argv);
    } catch (const penumbra::InputError& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 3;
    }
}
