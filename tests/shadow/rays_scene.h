#pragma once

#include <memory>
#include <random>
#include <vector>

#include "core/frame/visibility.h"
#include "core/light/polygon_shape.h"
#include "shadow/accumulate.h"
#include "shadow/trace.h"

// Scenes and G-buffers made by hand, for the tests of shadow rays.

namespace penumbra::shadow {

// One model per call of `add`. Owns what the view points to.
class HandScene {
  public:
    Mesh& add(std::vector<Vec3f> positions, std::vector<Triangle> triangles) {
        meshes_.push_back(std::make_unique<Mesh>());
        Mesh& mesh = *meshes_.back();
        mesh.triangle_slots.assign(triangles.size(), 0);
        mesh.positions = std::move(positions);
        mesh.triangles = std::move(triangles);
        Instance instance;
        instance.mesh = &mesh;
        instance.materials = slots_;
        view.instances.push_back(std::move(instance));
        return mesh;
    }
    // Moves a model: fixed ones once, before the first update; animated ones at any time.
    void place(std::size_t model, const Affine3f& transform, bool is_animated) {
        Instance& instance = view.instances[model];
        instance.world_from_object = transform;
        instance.is_animated = is_animated;
    }
    // World positions, as evaluate() makes them.
    SceneView& evaluated() {
        view.materials = materials;
        view.textures = textures;
        for (Instance& instance : view.instances) {
            instance.positions.resize(instance.mesh->positions.size() + 1);
            for (std::size_t i = 0; i < instance.mesh->positions.size(); ++i)
                instance.positions[i] =
                    instance.world_from_object.point(instance.mesh->positions[i]);
        }
        return view;
    }

    std::vector<Material> materials = std::vector<Material>(2);
    std::vector<Texture> textures;
    SceneView view;

  private:
    std::vector<std::unique_ptr<Mesh>> meshes_;
    std::vector<std::uint32_t> slots_ = {0, 1};
};

inline Affine3f placed(float scale, const Vec3f& translation) {
    return {{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}, translation};
}

// A quad a, b, c, d in this order around it.
inline std::vector<Triangle> quad_triangles() {
    return {{{0, 1, 2}}, {{0, 2, 3}}};
}

// A closed sphere of radius 1 with 2 * rings * rings triangles, more or less.
struct SphereMesh {
    std::vector<Vec3f> positions;
    std::vector<Triangle> triangles;
};
SphereMesh make_sphere(int rings);
SphereMesh make_box();  // from -1 to 1

inline PolygonLight make_light(const std::vector<Vec3f>& vertices, bool two_sided = false) {
    PolygonLight light;
    light.shape = make_polygon_shape(vertices.data(), static_cast<int>(vertices.size()), two_sided);
    light.emission.radiance = {1, 2, 3};
    return light;
}

// A scene's only light.
inline LightSetView only(const PolygonLight& light) {
    static constexpr LightRef kFirst{LightKind::kPolygon, 0};
    return {&kFirst, 1, &light};
}

struct SurfacePoint {
    Vec3f position, geometric_normal, normal;
    Vec3f base_color{1, 1, 1};
    float roughness = 0.5f;
    float metallic = 0;
    float dielectric_f0 = 0.04f;
    std::uint32_t instance = 0;
};

// A tile of a G-buffer, and its sums.
class HandTile {
  public:
    HandTile();
    void set(int pixel, const SurfacePoint& point);
    void fill(const SurfacePoint& point) {
        for (int pixel = 0; pixel < kTilePixels; ++pixel) set(pixel, point);
    }
    [[nodiscard]] ConstSurfaceView surface() const;
    [[nodiscard]] LightSumsView sums();
    void clear_sums();

    Plane3<float> shadowed, unshadowed;

  private:
    Plane3<float> position_, geometric_normal_, normal_, base_color_;
    Plane<float> roughness_, metallic_, dielectric_f0_;
    Plane<std::uint32_t> instance_, material_;
};

struct TileRun {
    const Occluders* occluders = nullptr;
    Visibility visibility = Visibility::kTraced;
    Vec3f eye{0, 0, 0};
    FrameContext frame;
};

// All samples of a light, added to the tile's sums.
void add_light(const TileRun& run, const PolygonLight& light, int samples, HandTile& tile,
               RayScratch& scratch);

RayInputs inputs_of(const TileRun& run, const HandTile& tile);

}  // namespace penumbra::shadow
