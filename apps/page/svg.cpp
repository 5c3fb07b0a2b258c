#include "apps/page/svg.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/page/append.h"
#include "apps/page/html.h"

namespace penumbra::page {
namespace {

std::string tip_element(std::string_view tip) {
    return tip.empty() ? "" : fmt::format("<title>{}</title>", html_escaped(tip));
}

}  // namespace

Svg::Svg(double width, double height, std::string_view title)
    : body_(fmt::format("<svg viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
                        "role=\"img\" aria-label=\"{2}\">\n",
                        width, height, html_escaped(title))) {}

void Svg::line(Point from, Point to, std::string_view style) {
    append(body_, "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n",
           from.first, from.second, to.first, to.second, style);
}

void Svg::rectangle(Point corner, Point size, std::string_view style, std::string_view tip) {
    append(body_,
           "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"{}\">{}"
           "</rect>\n",
           corner.first, corner.second, size.first, size.second, style, tip_element(tip));
}

void Svg::circle(Point center, double radius, std::string_view style, std::string_view tip) {
    append(body_, "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" class=\"{}\">{}</circle>\n",
           center.first, center.second, radius, style, tip_element(tip));
}

void Svg::path(const std::vector<Point>& points, std::string_view style) {
    std::string places;
    for (const Point& point : points) append(places, "{:.1f},{:.1f} ", point.first, point.second);
    append(body_, "<polyline points=\"{}\" class=\"{}\"/>\n", places, style);
}

void Svg::text(Point at, std::string_view anchor, std::string_view words, std::string_view style) {
    append(body_, "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"{}\">{}</text>\n",
           at.first, at.second, anchor, style, html_escaped(words));
}

double tick_distance(double most) {
    if (!(most > 0)) return 1;
    const double power = std::pow(10, std::floor(std::log10(most)));
    const double digits = most / power;  // 1 to 10
    return power * (digits < 1.5 ? 0.25 : digits < 3 ? 0.5 : digits < 7 ? 1 : 2);
}

}  // namespace penumbra::page
