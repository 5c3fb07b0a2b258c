#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/math/affine.h"
#include "core/scene/light_track.h"
#include "core/scene/texture.h"
#include "core/scene/track.h"

// A scene as it was read and checked: every index is valid, every number finite. Time enters only
// in evaluate() (scene_view.h). Right-handed, y up, metres; radiance in W / (sr m^2) per
// scene-linear Rec. 709 channel.

namespace penumbra {

struct Triangle {
    std::uint32_t vertex[3];
};

// Triangles in object space with one index per vertex: vertices are split where normals or texture
// coordinates differ. No triangle has zero area.
struct Mesh {
    std::string name;  // the file it came from, for messages
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;  // unit; never empty
    std::vector<Vec2f> uvs;      // empty, or as many as positions; v runs up, as in OBJ
    std::vector<Triangle> triangles;
    std::vector<std::uint16_t> triangle_slots;  // per triangle: index into Model::materials
    std::size_t dropped_triangles = 0;          // degenerate ones, not in `triangles`
};

inline constexpr int kNoTexture = -1;

// Lambert + GGX, metallic-roughness as in glTF 2.0. Maps multiply their factor, except the normal
// map.
struct Material {
    std::string name;
    Vec3f base_color{0.5f, 0.5f, 0.5f};  // each in [0, 1]
    float roughness = 0.5f;              // [kMinimumRoughness, 1]; GGX alpha = roughness^2
    float metallic = 0;                  // [0, 1]
    float ior = 1.5f;                    // > 1; gives dielectrics their F0
    Vec3f emission{0, 0, 0};             // radiance; faces with it are lights
    int base_color_map = kNoTexture;     // indices into Scene::textures
    int roughness_map = kNoTexture;      // first channel (glTF's packing is resolved by the reader)
    int metallic_map = kNoTexture;       // first channel
    int normal_map = kNoTexture;         // tangent space, 0.5 + 0.5 n
    int opacity_map = kNoTexture;        // alpha channel; a hole where level 0 is below 0.5
};

// A mesh placed in the world.
struct Model {
    std::string name;
    std::uint32_t mesh = 0;
    TransformTrack transform;
    std::vector<std::uint32_t> materials;  // slot of the mesh -> index into Scene::materials
};

// A convex planar polygon that emits to the side from which its vertices run counter-clockwise.
inline constexpr int kMaxLightVertices = 8;

struct LightPolygon {
    int vertex_count = 0;  // 3 to kMaxLightVertices
    std::array<Vec3f, kMaxLightVertices> vertices{};
};

// A light of the scene file: drawn if visible, but no geometry: it casts no shadow.
struct Light {
    std::string name;
    LightShapeTrack shape;
    EmissionTrack emission;
    bool two_sided = false;
    bool visible = true;
};

// An emissive face, or several coplanar adjacent ones that form a convex polygon, of a model.
struct Emitter {
    std::uint32_t model = 0;
    LightPolygon polygon;  // object space
    Vec3f radiance{};
};

struct CameraTracks {
    Vec3Track eye, target, up;
    FloatTrack vertical_field_of_view;   // degrees, in (0, 180)
    std::optional<float> near_distance;  // metres; by default relative to the scene's size
};

struct Animation {
    double frames_per_second = 24;
    int first_frame = 1;
    int last_frame = 1;

    [[nodiscard]] double seconds(double frame) const {
        return (frame - first_frame) / frames_per_second;
    }
};

struct Scene {
    std::filesystem::path file;  // empty for the built-in scene
    int width = 1920;
    int height = 1080;
    CameraTracks camera;
    std::vector<Mesh> meshes;
    std::vector<Model> models;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Light> lights;
    std::vector<Emitter> emitters;
    Vec3f background{0, 0, 0};  // radiance where no surface is hit
    Animation animation;
    int samples_per_pixel = 1;  // the scene file's render.spp
    std::vector<std::filesystem::path>
        files;                          // all that was read, for the digest, in reading order
    std::vector<std::string> warnings;  // one line each, without "warning:"
};

}  // namespace penumbra
