#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "apps/renderer/film.h"
#include "apps/renderer/renderer.h"
#include "core/scene/read_scene.h"

namespace penumbra::tests {

using renderer::Aov;
using renderer::AovSet;
using renderer::ExecutionSettings;
using renderer::Film;
using renderer::ImageSettings;

inline AovSet all_aovs() {
    return renderer::parse_aov_list("all");
}

inline std::filesystem::path data_scene(const std::string& name) {
    return std::filesystem::path(PENUMBRA_SOURCE_DIR) / "data/scenes" / name;
}

inline Film render(const Scene& scene, const ImageSettings& image,
                   const ExecutionSettings& execution = {}, int frame = 1) {
    renderer::Renderer renderer(scene, image, execution);
    Film film;
    renderer.render(frame, all_aovs(), film);
    return film;
}

// Calls body(name, plane) for every plane that belongs to the film's output.
template <class Body>
void each_plane(const Film& f, const Body& body) {
    const auto numbers = [&](Aov aov, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)
            body(renderer::info(aov).slots[i].name.data(), f.numbers(aov, i));
    };
    for (const Aov aov : {Aov::kBeauty, Aov::kU, Aov::kS, Aov::kUn, Aov::kW, Aov::kEmission,
                          Aov::kN, Aov::kNg, Aov::kP, Aov::kAlbedo})
        numbers(aov, 3);
    body("A", f.numbers(Aov::kBeauty, 3));
    for (const Aov aov : {Aov::kE, Aov::kZ, Aov::kRoughness, Aov::kMetallic}) numbers(aov, 1);
    numbers(Aov::kMotion, 2);
    for (std::size_t i = 0; i < 3; ++i)
        body(renderer::info(Aov::kId).slots[i].name.data(), f.ids(Aov::kId, i));
}

// Calls body(x, y), coordinates of the film's planes, for every pixel of the crop.
template <class Body>
void each_pixel(const Film& f, const Body& body) {
    for (int y = f.crop.y0 - f.window.y0; y < f.crop.y1 - f.window.y0; ++y)
        for (int x = f.crop.x0 - f.window.x0; x < f.crop.x1 - f.window.x0; ++x) body(x, y);
}

// FNV-1a over the bits of every plane's crop.
inline std::uint64_t digest(const Film& f) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    each_plane(f, [&](const char*, const auto& plane) {
        each_pixel(f, [&](int x, int y) {
            hash ^= std::bit_cast<std::uint32_t>(plane.at(x, y));
            hash *= 0x100000001b3u;
        });
    });
    return hash;
}

}  // namespace penumbra::tests
