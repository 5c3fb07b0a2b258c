#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/bench/report.h"

namespace penumbra::bench {

// The processor's own counters of all threads of this process (Linux, perf_event_open), where the
// system permits to read them. Threads that begin later are counted too.
class CounterSet {
  public:
    CounterSet();
    ~CounterSet();
    CounterSet(const CounterSet&) = delete;
    CounterSet& operator=(const CounterSet&) = delete;

    // Since it was made; nothing where they are not available.
    [[nodiscard]] std::optional<HardwareCounters> read() const;
    // "available", or why they are not.
    [[nodiscard]] const std::string& state() const { return state_; }

  private:
    static constexpr int kEvents = 3;
    std::vector<int> descriptors_[kEvents];
    std::string state_;
};

}  // namespace penumbra::bench
