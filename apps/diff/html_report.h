#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/diff/report.h"
#include "apps/diff/spool.h"

namespace penumbra::diff {

// One page for all pairs that needs nothing but itself. Pairs that failed come first.
class HtmlReport {
  public:
    // Says at once if the page cannot be written there. Throws OutputError.
    HtmlReport(const std::filesystem::path& target, std::string title,
               std::vector<Threshold> thresholds);
    // The pair goes to the disk, its pictures encoded: memory holds one pair at a time.
    void add(const PairReport& pair);
    // The page appears under its name.
    void publish();

  private:
    [[nodiscard]] std::string summary() const;

    std::string title_;
    std::vector<Threshold> thresholds_;
    image::PendingFile page_;
    Spool failed_, passed_;
    int failed_count_ = 0, passed_count_ = 0;
};

}  // namespace penumbra::diff
