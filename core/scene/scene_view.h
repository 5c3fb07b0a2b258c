#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/frame/camera.h"
#include "core/light/light_set.h"
#include "core/scene/scene.h"

// The scene at the time of one frame: what the passes read.

namespace penumbra {

// A model at this frame's time. Positions and normals are in world space, so that the rasterizer,
// the resolve and the occluders see the same floats.
struct Instance {
    const Mesh* mesh = nullptr;
    std::span<const std::uint32_t> materials;  // slot -> index into SceneView::materials
    std::vector<Vec3f> positions;  // world; one more element than vertices (read by wide loads)
    std::vector<Vec3f> normals;    // world, unit
    Affine3f world_from_object;
    Affine3f previous_from_current;  // world position now -> world position in the previous frame
    bool is_animated = false;        // has a track that moves at any time of the scene
    bool moved = false;  // world_from_object differs from the previous evaluated frame's
    // The transform mirrors: the outside of a face (the side that an emissive one emits to) is then
    // the side from which its world vertices run clockwise. Normals are right already.
    bool flips_winding = false;
    Vec3f bounds_min{}, bounds_max{};  // of the positions, world
};

// Everything the passes of a frame read; owns the evaluated positions. Refer to it by const
// reference.
struct SceneView {
    std::span<const Material> materials;
    std::span<const Texture> textures;
    std::vector<Instance> instances;  // one per model, in the scene's order
    LightSet lights;                  // the scene file's, then the emitters', in the scene's order
    Vec3f background{};
    Camera camera;
    Camera previous_camera;
    Vec3f bounds_min{}, bounds_max{};  // of all positions, world
};

struct EvaluateTimes {
    double now = 0;  // seconds
    double previous =
        0;  // of frame f - 1 of the scene's grid; equal to `now` for the first frame's motion 0
};

struct FilmSize {
    int width = 0;
    int height = 0;
};

// The times of a frame of the scene's grid.
[[nodiscard]] EvaluateTimes times_of_frame(const Animation& animation, int frame);

// Evaluates the scene at a time. Throws InputError where the animation makes the camera or a light
// degenerate. `reuse` is the view of another time of the same scene, or an empty
// one: what did not move is taken over from it, but the result does not depend on it.
void evaluate(const Scene& scene, EvaluateTimes times, FilmSize film, SceneView& reuse);

}  // namespace penumbra
