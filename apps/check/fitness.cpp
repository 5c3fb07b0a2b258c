#include "apps/check/fitness.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "core/image/exr.h"

namespace penumbra::check {
namespace {

using image::ExrPlane;
using image::ExrType;

// Calls body(bits, value) for each value of a plane; ids are their own bits and a finite value.
template <class Body>
void for_each_value(const ExrPlane& plane, const image::Window& window, const Body& body) {
    for (int y = 0; y < window.height(); ++y)
        for (int x = 0; x < window.width(); ++x) {
            if (plane.type == ExrType::kUint) {
                const std::uint32_t id = plane.ids.row(y)[x];
                body(id, static_cast<float>(id));
            } else {
                const float value = plane.floats.row(y)[x];
                body(std::bit_cast<std::uint32_t>(value), value);
            }
        }
}

struct PlaneFacts {
    bool is_zero = true, is_constant = true;
    std::size_t non_finite = 0;
};

PlaneFacts facts_of(const ExrPlane& plane, const image::Window& window) {
    PlaneFacts facts;
    bool is_first = true;
    float first = 0;
    for_each_value(plane, window, [&](std::uint32_t, float value) {
        if (is_first) first = value;
        is_first = false;
        facts.is_zero = facts.is_zero && value == 0;
        facts.is_constant = facts.is_constant && value == first;
        if (!std::isfinite(value)) ++facts.non_finite;
    });
    return facts;
}

// The planes of R, G and B, or all.
std::vector<const ExrPlane*> judged_planes(const image::ExrPixels& pixels) {
    std::vector<const ExrPlane*> planes;
    for (const char* const name : {"R", "G", "B"})
        if (const ExrPlane* plane = pixels.find(name)) planes.push_back(plane);
    if (planes.empty())
        for (const ExrPlane& plane : pixels.planes) planes.push_back(&plane);
    return planes;
}

std::string problem_of(const image::ExrPixels& pixels) {
    std::size_t non_finite = 0;
    for (const ExrPlane& plane : pixels.planes)
        non_finite += facts_of(plane, pixels.header.data).non_finite;
    if (non_finite > 0)
        return fmt::format("holds {} values that are no finite numbers", non_finite);
    PlaneFacts all;
    for (const ExrPlane* plane : judged_planes(pixels)) {
        const PlaneFacts facts = facts_of(*plane, pixels.header.data);
        all.is_zero = all.is_zero && facts.is_zero;
        all.is_constant = all.is_constant && facts.is_constant;
    }
    if (all.is_zero) return "is black";
    return all.is_constant ? "has one colour everywhere" : "";
}

Digest digest_of_pixels(const image::ExrPixels& pixels) {
    const image::Window& window = pixels.header.data;
    std::string text = fmt::format("{} x {}", window.width(), window.height());
    for (const ExrPlane& plane : pixels.planes) {
        std::string bytes;
        bytes.reserve(static_cast<std::size_t>(window.width()) * window.height() * 4);
        for_each_value(plane, window, [&](std::uint32_t bits, float) {
            for (int shift = 0; shift < 32; shift += 8)
                bytes += static_cast<char>(bits >> shift & 255);
        });
        text += fmt::format(", {} {} {}", plane.name, image::name(plane.type),
                            digest_of(bytes, VirtualFiles{}).hex());
    }
    return digest_of(text, VirtualFiles{});
}

}  // namespace

Fitness judge_picture(const std::filesystem::path& exr_file) {
    const image::ExrPixels pixels = image::read_exr(exr_file);
    return {digest_of_pixels(pixels), problem_of(pixels)};
}

}  // namespace penumbra::check
