#include "apps/diff/html_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "apps/diff/html_assets.h"
#include "core/image/png.h"

namespace penumbra::diff {
namespace {

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

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

std::string html_data_uri(const image::Picture& picture) {
    return "data:image/png;base64," + base64(image::encode_png(picture));
}

std::string html_escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string html_begin(std::string_view title) {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
        "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\"><title>{0}</title>\n"
        "<style>\n{1}</style></head>\n<body><h1>{0}</h1>\n",
        html_escaped(title), html_style());
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
