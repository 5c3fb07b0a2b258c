#pragma once

#include <string>
#include <vector>

#include "apps/diff/report.h"

namespace penumbra::diff {

// One page for all pairs that needs nothing but itself: pictures are embedded, no network is used.
// Pairs that failed come first, with their pictures: flip, slider, side by side and error map,
// zoom, and the worst tiles enlarged.
class HtmlReport {
  public:
    HtmlReport(std::string title, std::vector<Threshold> thresholds);
    // Pictures are encoded here; the report can be dropped afterwards.
    void add(const PairReport& pair);
    [[nodiscard]] std::string page() const;

  private:
    std::string title_;
    std::vector<Threshold> thresholds_;
    std::string failed_, passed_;
    int failed_count_ = 0, passed_count_ = 0;
};

}  // namespace penumbra::diff
