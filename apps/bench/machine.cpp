#include "apps/bench/machine.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "apps/renderer/version.h"
#include "core/parallel/arena.h"

namespace penumbra::bench {
namespace {

// The text after "key : " of the first such line.
std::string entry(const char* file, std::string_view key) {
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(key)) continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string::npos) continue;
        const std::size_t text = line.find_first_not_of(" \t", colon + 1);
        return text == std::string::npos ? "" : line.substr(text);
    }
    return "";
}

// The first number in a text, or 0.
template <class T>
T number(const std::string& text) {
    T value{};
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

std::string first_line(const std::filesystem::path& file) {
    std::ifstream lines(file);
    std::string line;
    std::getline(lines, line);
    return line;
}

// "32K", "2048K", "32M".
std::uint64_t bytes(const std::string& size) {
    const std::uint64_t unit = size.ends_with('K') ? 1u << 10 : size.ends_with('M') ? 1u << 20 : 1u;
    return unit * number<std::uint64_t>(size);
}

// Processors in a list such as "0-3,8-11".
int processors_in(const std::string& list) {
    int count = 0;
    std::istringstream ranges(list);
    for (std::string range; std::getline(ranges, range, ',');) {
        const std::size_t dash = range.find('-');
        const int first = number<int>(range);
        const int last = dash == std::string::npos ? first : number<int>(range.substr(dash + 1));
        count += last - first + 1;
    }
    return count;
}

std::vector<Machine::Cache> caches() {
    std::vector<Machine::Cache> found;
    for (int index = 0;; ++index) {
        const std::filesystem::path folder =
            fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}", index);
        if (!std::filesystem::exists(folder / "level")) return found;
        found.push_back({.level = number<int>(first_line(folder / "level")),
                         .type = first_line(folder / "type"),
                         .bytes = bytes(first_line(folder / "size")),
                         .sharing = processors_in(first_line(folder / "shared_cpu_list"))});
    }
}

// As Google Benchmark tells it: any governor but "performance".
bool scales_clock() {
    const std::string governor =
        first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
    return !governor.empty() && governor != "performance";
}

std::string local_time() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    localtime_r(&now, &parts);
    const std::string zone = fmt::format("{:%z}", parts);  // +0100
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}{}:{}", parts, zone.substr(0, 3), zone.substr(3));
}

std::string host_name() {
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

Machine describe_machine(simd::Isa kernels, shadow::TraceIsa trace) {
    std::array<double, 3> load{};
    const int loads = getloadavg(load.data(), 3);
    return {.processor = entry("/proc/cpuinfo", "model name"),
            .host = host_name(),
            .date = local_time(),
            .processors = parallel::default_thread_count(),
            .is_scaling = scales_clock(),
            .megahertz = number<double>(entry("/proc/cpuinfo", "cpu MHz")),
            .kernel_isa = std::string(simd::name(kernels)),
            .trace_isa = std::string(shadow::name(trace)),
            .software = fmt::format("penumbra {}", renderer::version()),
            .counters = "",
            .caches = caches(),
            .load = {load.begin(), load.begin() + std::max(loads, 0)}};
}

std::uint64_t peak_memory_bytes() {
    const std::string kibibytes = entry("/proc/self/status", "VmHWM");
    if (!kibibytes.empty()) return 1024 * number<std::uint64_t>(kibibytes);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024 * static_cast<std::uint64_t>(usage.ru_maxrss);
}

void reset_peak_memory() {
    malloc_trim(0);
    // proc(5): 5 resets the peak resident set size.
    std::ofstream("/proc/self/clear_refs") << "5";
}

std::vector<int> thread_sweep(int most) {
    std::vector<int> counts;
    for (int threads = 1; threads < most; threads *= 2) counts.push_back(threads);
    counts.push_back(most);
    return counts;
}

}  // namespace penumbra::bench
