#pragma once

#include <cstdint>
#include <vector>

#include "core/light/polygon_shape.h"
#include "core/math/affine.h"

// The lights of a frame. A light is one of several shapes, each kind in a vector of its own; loops
// over lights ask for the kind once per light and block of lanes, never per pixel. What a kind has
// to offer is listed in shadow/light_kinds.h. A new kind adds its line to each list here.

namespace penumbra {

enum class LightKind : std::uint8_t { kPolygon };

struct LightRef {
    LightKind kind;
    std::uint32_t index;  // among the lights of its kind
};

// What a light sends out, whatever its shape.
struct Emission {
    Vec3f radiance{0, 0, 0};  // the same from all points in all directions of the emitting side
};

template <class Shape>
struct Lit {
    Shape shape;
    Emission emission;
    Affine3f previous_from_current;  // its points' world positions now -> in the previous frame
    bool visible = true;  // drawn by the lights' own pass; false for emitters: they are geometry
    bool is_geometry = false;  // an emissive face of a model
};

using PolygonLight = Lit<PolygonShape<float>>;

// One thing per light, such as Lit<Shape>, in the lights' order: for kernels.
template <template <class> class Of>
struct PerLightView {
    const LightRef* order = nullptr;
    int count = 0;
    const Of<PolygonShape<float>>* polygons = nullptr;
};

// The same as an owner.
template <template <class> class Of>
struct PerLight {
    std::vector<LightRef> order;
    std::vector<Of<PolygonShape<float>>> polygons;

    void add(const Of<PolygonShape<float>>& light) { append(LightKind::kPolygon, polygons, light); }
    void clear() {
        order.clear();
        polygons.clear();
    }
    [[nodiscard]] std::size_t size() const { return order.size(); }
    [[nodiscard]] PerLightView<Of> view() const {
        return {order.data(), static_cast<int>(order.size()), polygons.data()};
    }

  private:
    template <class Light>
    void append(LightKind kind, std::vector<Light>& lights, const Light& light) {
        order.push_back({kind, static_cast<std::uint32_t>(lights.size())});
        lights.push_back(light);
    }
};

using LightSet = PerLight<Lit>;
using LightSetView = PerLightView<Lit>;

// Calls visit with the light, as what its kind is.
template <template <class> class Of, class Visit>
void with_light(const PerLightView<Of>& lights, std::uint32_t light, const Visit& visit) {
    const LightRef ref = lights.order[light];
    switch (ref.kind) {
        case LightKind::kPolygon:
            visit(lights.polygons[ref.index]);
    }
}

}  // namespace penumbra
