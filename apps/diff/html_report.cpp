#include "apps/diff/html_report.h"

#include <fmt/format.h>

#include <span>

#include "apps/diff/html_parts.h"
#include "apps/page/html.h"

namespace penumbra::diff {
namespace {

void write(image::PendingFile& file, const std::string& text) {
    file.write(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace

HtmlReport::HtmlReport(const std::filesystem::path& target, std::string title,
                       std::vector<Threshold> thresholds)
    : title_(std::move(title)),
      thresholds_(std::move(thresholds)),
      page_(target),
      failed_(target),
      passed_(target) {}

void HtmlReport::add(const PairReport& pair) {
    const bool passed = pair.passed();
    ++(passed ? passed_count_ : failed_count_);
    (passed ? passed_ : failed_)
        .append(fmt::format("<section><h2><span class=\"{0}\">{0}</span> {1}</h2>\n"
                            "<div class=\"files\">reference {2}<br>test {3}</div>\n{4}{5}{6}"
                            "</section>\n",
                            passed ? "passed" : "failed", page::html_escaped(pair.name),
                            page::html_escaped(pair.reference), page::html_escaped(pair.test),
                            html_failures(pair), html_metrics(pair), html_viewers(pair)));
}

std::string HtmlReport::summary() const {
    std::string limits;
    for (const Threshold& threshold : thresholds_)
        limits += fmt::format("<li>{} {} {}</li>", info(threshold.metric).name,
                              info(threshold.metric).is_similarity ? "not below" : "not above",
                              threshold.limit);
    if (limits.empty()) limits = "<li>no difference at all</li>";
    return fmt::format(
        "<p><span class=\"failed\">{} failed</span>, <span class=\"passed\">{} passed</span>. "
        "Allowed:</p><ul>{}</ul>\n",
        failed_count_, passed_count_, limits);
}

void HtmlReport::publish() {
    write(page_, html_begin(title_));
    write(page_, summary());
    failed_.copy_to(page_);
    passed_.copy_to(page_);
    write(page_, html_end());
    page_.publish();
}

}  // namespace penumbra::diff
