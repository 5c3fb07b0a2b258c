#include "tests/shadow/rays_scene.h"

#include <cmath>

namespace penumbra::shadow {
namespace {

void store(Plane3<float>& planes, int x, int y, const Vec3f& value) {
    planes[0].at(x, y) = value.x;
    planes[1].at(x, y) = value.y;
    planes[2].at(x, y) = value.z;
}

Plane3<float> tile_planes() {
    return make_plane3<float>(kTileSize, kTileSize);
}

}  // namespace

SphereMesh make_sphere(int rings) {
    SphereMesh sphere;
    const int columns = 2 * rings;
    constexpr float kPi = 3.14159265f;
    for (int ring = 1; ring < rings; ++ring)
        for (int column = 0; column < columns; ++column) {
            const float polar = kPi * static_cast<float>(ring) / static_cast<float>(rings);
            const float turn = 2 * kPi * static_cast<float>(column) / static_cast<float>(columns);
            sphere.positions.push_back({std::sin(polar) * std::cos(turn), std::cos(polar),
                                        std::sin(polar) * std::sin(turn)});
        }
    const auto vertex = [&](int ring, int column) {
        return static_cast<std::uint32_t>((ring - 1) * columns + column % columns);
    };
    const auto north = static_cast<std::uint32_t>(sphere.positions.size());
    sphere.positions.push_back({0, 1, 0});
    sphere.positions.push_back({0, -1, 0});
    for (int column = 0; column < columns; ++column) {
        sphere.triangles.push_back({{north, vertex(1, column + 1), vertex(1, column)}});
        sphere.triangles.push_back(
            {{north + 1, vertex(rings - 1, column), vertex(rings - 1, column + 1)}});
        for (int ring = 1; ring + 1 < rings; ++ring) {
            const std::uint32_t a = vertex(ring, column), b = vertex(ring, column + 1);
            const std::uint32_t c = vertex(ring + 1, column + 1), d = vertex(ring + 1, column);
            sphere.triangles.push_back({{a, b, c}});
            sphere.triangles.push_back({{a, c, d}});
        }
    }
    return sphere;
}

SphereMesh make_box() {
    SphereMesh box;
    for (int i = 0; i < 8; ++i)
        box.positions.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
    const std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : faces) {
        box.triangles.push_back({{f[0], f[1], f[2]}});
        box.triangles.push_back({{f[0], f[2], f[3]}});
    }
    return box;
}

HandTile::HandTile()
    : shadowed(tile_planes()),
      unshadowed(tile_planes()),
      position_(tile_planes()),
      geometric_normal_(tile_planes()),
      normal_(tile_planes()),
      base_color_(tile_planes()),
      roughness_(kTileSize, kTileSize),
      metallic_(kTileSize, kTileSize),
      dielectric_f0_(kTileSize, kTileSize),
      instance_(kTileSize, kTileSize),
      material_(kTileSize, kTileSize) {
    instance_.fill(kNothing);
    material_.fill(kNothing);
}

void HandTile::set(int pixel, const SurfacePoint& point) {
    const int x = pixel % kTileSize, y = pixel / kTileSize;
    store(position_, x, y, point.position);
    store(geometric_normal_, x, y, point.geometric_normal);
    store(normal_, x, y, point.normal);
    store(base_color_, x, y, point.base_color);
    roughness_.at(x, y) = point.roughness;
    metallic_.at(x, y) = point.metallic;
    dielectric_f0_.at(x, y) = point.dielectric_f0;
    instance_.at(x, y) = point.instance;
    material_.at(x, y) = 0;
}

ConstSurfaceView HandTile::surface() const {
    ConstSurfaceView surface;
    surface.position = surface.shadow_origin = view(position_);
    surface.geometric_normal = view(geometric_normal_);
    surface.normal = view(normal_);
    surface.base_color = view(base_color_);
    surface.roughness = roughness_.view();
    surface.metallic = metallic_.view();
    surface.dielectric_f0 = dielectric_f0_.view();
    surface.instance = instance_.view();
    surface.material = material_.view();
    return surface;
}

LightSumsView HandTile::sums() {
    LightSumsView sums;
    sums.shadowed = view(shadowed);
    sums.unshadowed_samples = view(unshadowed);
    return sums;
}

void HandTile::clear_sums() {
    for (int channel = 0; channel < 3; ++channel) {
        shadowed[static_cast<std::size_t>(channel)].fill(0);
        unshadowed[static_cast<std::size_t>(channel)].fill(0);
    }
}

RayInputs inputs_of(const TileRun& run, const HandTile& tile) {
    RayInputs inputs;
    inputs.frame = run.frame;
    inputs.eye = run.eye;
    inputs.surface = tile.surface();
    inputs.offset_scales = run.occluders->offset_scales();
    return inputs;
}

void add_light(const TileRun& run, const PolygonLight& light, int samples, HandTile& tile,
               RayScratch& scratch) {
    const RayInputs inputs = inputs_of(run, tile);
    for (int sample = 0; sample < samples; ++sample) {
        generate_rays(inputs, {only(light), 0, sample, samples}, scratch);
        trace(*run.occluders, run.visibility, scratch);
        accumulate(scratch, run.frame.isa, tile.sums());
    }
}

}  // namespace penumbra::shadow
