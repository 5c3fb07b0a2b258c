#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Drawings inside of a page. What they look like is the style sheet's business: everything has a
// class and nothing has a colour.

namespace penumbra::page {

class Svg {
  public:
    using Point = std::pair<double, double>;

    // `title` is what those hear who cannot see it.
    Svg(double width, double height, std::string_view title);

    void line(Point from, Point to, std::string_view style);
    void rectangle(Point corner, Point size, std::string_view style, std::string_view tip = "");
    void circle(Point center, double radius, std::string_view style, std::string_view tip = "");
    void path(const std::vector<Point>& points, std::string_view style);
    // `anchor`: "start", "middle", "end". The text is escaped.
    void text(Point at, std::string_view anchor, std::string_view words, std::string_view style);

    [[nodiscard]] std::string finish() const { return body_ + "</svg>\n"; }

  private:
    std::string body_;
};

// A round distance that divides 0 to `most` into 3 to 7 parts.
[[nodiscard]] double tick_distance(double most);

}  // namespace penumbra::page
