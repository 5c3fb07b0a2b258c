#include "apps/diff/html_parts.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/diff/html_assets.h"
#include "apps/page/html.h"

namespace penumbra::diff {
namespace {

using page::html_data_uri;
using page::html_escaped;

std::string number(const std::optional<double>& value) {
    if (!value) return "";
    return std::isinf(*value) ? "&infin;" : fmt::format("{:.6g}", *value);
}

constexpr std::string_view kControls = R"html(<div class="bar">
<button data-mode="flip" aria-pressed="true">Flip</button><button data-mode="slider">Slider</button>
<button data-mode="side">Side by side</button><button data-mode="heat">Error map</button>
<button class="swap" title="also: click the picture, or the space bar">Swap</button>
<button class="auto">Blink</button>
<button class="in">Zoom in</button><button class="out">Zoom out</button>
<button class="one">1:1</button><button class="fit">Fit</button><span class="percent"></span>
</div>
)html";

std::string worst_of(const LayerReport& layer) {
    std::string html;
    for (const WorstTile& tile : layer.worst_pictures) {
        html += "<figure><div class=\"trio\">";
        for (const image::Picture* picture :
             {&tile.pictures.reference, &tile.pictures.test, &tile.pictures.heat})
            html += fmt::format("<img alt=\"\" src=\"{}\">", html_data_uri(*picture));
        const Block& block = tile.block;
        html += fmt::format(
            "</div><figcaption>({}, {}) mean error {:.4g} <button class=\"go\" data-x=\"{}\" "
            "data-y=\"{}\">Go there</button></figcaption></figure>\n",
            block.x, block.y, block.error, block.x + block.width / 2, block.y + block.height / 2);
    }
    if (html.empty()) return html;
    return "<h3>Worst tiles: reference, test, error map (click to enlarge)</h3>"
           "<div class=\"worst\">" +
           html + "</div>";
}

std::string viewer_of(const LayerReport& layer, bool is_hidden) {
    return fmt::format(
        "<div class=\"viewer\"{}>{}<div class=\"stage\" tabindex=\"0\" data-reduction=\"{}\" "
        "data-reference=\"{}\" data-test=\"{}\" data-heat=\"{}\"></div>\n{}</div>\n",
        is_hidden ? " hidden" : "", kControls, layer.reduction,
        html_data_uri(layer.pictures->reference), html_data_uri(layer.pictures->test),
        html_data_uri(layer.pictures->heat), worst_of(layer));
}

}  // namespace

std::string html_begin(std::string_view title) {
    return page::html_begin(title, page::Content::kScriptsAndPictures, html_style());
}

std::string html_end() {
    return fmt::format("<script>\n{}</script></body></html>\n", html_script());
}

std::string html_failures(const PairReport& pair) {
    if (pair.failures.empty()) return "";
    std::string html = "<ul>";
    for (const Failure& failure : pair.failures)
        html += fmt::format("<li><b>{}</b> {}{}{}</li>", name(failure.kind),
                            html_escaped(failure.layer), failure.layer.empty() ? "" : ": ",
                            html_escaped(failure.message));
    return html + "</ul>\n";
}

std::string html_metrics(const PairReport& pair) {
    if (pair.layers.empty()) return "";
    std::string html = "<div class=\"scroll\"><table><tr><th>layer</th>";
    for (const MetricInfo& metric : metric_table())
        html +=
            fmt::format("<th title=\"{}\">{}</th>", html_escaped(metric.convention), metric.name);
    html += "</tr>\n";
    for (const LayerReport& layer : pair.layers) {
        html += fmt::format("<tr><td>{}</td>", html_escaped(layer.name));
        for (const MetricInfo& metric : metric_table())
            html += fmt::format("<td>{}</td>", number(layer.metrics[metric.metric]));
        html += "</tr>\n";
    }
    return html + "</table></div>\n";
}

std::string html_viewers(const PairReport& pair) {
    std::string choices, viewers;
    for (const LayerReport& layer : pair.layers) {
        if (!layer.pictures) continue;
        viewers += viewer_of(layer, !viewers.empty());
        choices += fmt::format("<option>{}</option>", html_escaped(layer.name));
    }
    if (viewers.empty()) return "";
    return "<label>Layer <select class=\"layers\">" + choices + "</select></label>\n" + viewers;
}

}  // namespace penumbra::diff
