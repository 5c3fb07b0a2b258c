#include "apps/bench/hardware_counters.h"

#include <fmt/format.h>
#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

namespace penumbra::bench {
namespace {

constexpr std::uint64_t kHardwareEvents[] = {PERF_COUNT_HW_CPU_CYCLES, PERF_COUNT_HW_INSTRUCTIONS,
                                             PERF_COUNT_HW_CACHE_MISSES};

int open_counter(std::uint64_t event, int thread) {
    perf_event_attr attributes{};
    attributes.size = sizeof(attributes);
    attributes.type = PERF_TYPE_HARDWARE;
    attributes.config = event;
    attributes.inherit = 1;
    attributes.exclude_kernel = 1;
    attributes.exclude_hv = 1;
    attributes.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
    return static_cast<int>(syscall(SYS_perf_event_open, &attributes, thread, -1, -1,
                                    static_cast<unsigned long>(PERF_FLAG_FD_CLOEXEC)));
}

std::vector<int> threads_of_this_process() {
    std::vector<int> threads;
    for (const auto& folder : std::filesystem::directory_iterator("/proc/self/task")) {
        const std::string name = folder.path().filename().string();
        int id = 0;
        std::from_chars(name.data(), name.data() + name.size(), id);
        threads.push_back(id);
    }
    return threads;
}

std::string reason(int error) {
    const char* const hint = error == EACCES || error == EPERM ? "; see perf_event_paranoid"
                             : error == ENOENT || error == EOPNOTSUPP || error == ENODEV
                                 ? "; virtual machines often have none"
                                 : "";
    return fmt::format("not available: {}{}", std::strerror(error), hint);
}

// A counter that shared the hardware with others ran for part of the time only.
std::optional<double> read_scaled(int descriptor) {
    struct {
        std::uint64_t value, enabled, running;
    } count{};
    if (::read(descriptor, &count, sizeof(count)) != static_cast<ssize_t>(sizeof(count)))
        return std::nullopt;
    if (count.running == 0) return count.enabled == 0 ? std::optional(0.0) : std::nullopt;
    return static_cast<double>(count.value) * static_cast<double>(count.enabled) /
           static_cast<double>(count.running);
}

}  // namespace

CounterSet::CounterSet() : state_("available") {
    for (const int thread : threads_of_this_process())
        for (int event = 0; event < kEvents; ++event) {
            const int descriptor = open_counter(kHardwareEvents[event], thread);
            if (descriptor < 0) {
                state_ = reason(errno);
                return;
            }
            descriptors_[event].push_back(descriptor);
        }
}

CounterSet::~CounterSet() {
    for (const std::vector<int>& event : descriptors_)
        for (const int descriptor : event) close(descriptor);
}

std::optional<HardwareCounters> CounterSet::read() const {
    if (state_ != "available") return std::nullopt;
    double sums[kEvents] = {};
    for (int event = 0; event < kEvents; ++event)
        for (const int descriptor : descriptors_[event]) {
            const std::optional<double> value = read_scaled(descriptor);
            if (!value) return std::nullopt;
            sums[event] += *value;
        }
    return HardwareCounters{.cycles = static_cast<std::uint64_t>(sums[0]),
                            .instructions = static_cast<std::uint64_t>(sums[1]),
                            .cache_misses = static_cast<std::uint64_t>(sums[2])};
}

}  // namespace penumbra::bench
