#pragma once

#include <atomic>
#include <memory>

#include "apps/renderer/film.h"
#include "apps/renderer/frame_statistics.h"
#include "apps/renderer/settings.h"
#include "core/frame/camera.h"
#include "core/scene/scene.h"

// The public API: strings the passes to a frame.
//
//     const Scene scene = read_scene("shot.json");
//     renderer::Renderer renderer(scene, {.samples_per_pixel = 1}, {});
//     renderer::Film film;
//     renderer.render(1, {renderer::Aov::kBeauty}, film);

namespace penumbra::renderer {

// The settings with the scene's values where the user's are silent.
[[nodiscard]] ImageSettings completed(const Scene& scene, const ImageSettings& image);

// Throws InputError where settings do not fit the scene or this machine.
void check_settings(const Scene& scene, const ImageSettings& image,
                    const ExecutionSettings& execution);

// Renders frames of one scene. Holds what outlives a frame (occluders, evaluated models, scratch
// memory); a frame's pixels do not depend on which frames were rendered before.
class Renderer {
  public:
    // `scene` must outlive the renderer.
    Renderer(const Scene& scene, const ImageSettings& image, const ExecutionSettings& execution);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Fills the film, which is allocated as needed. Where `cancelled` becomes true, it returns
    // early with an unfinished film.
    FrameStatistics render(int frame, AovSet wanted, Film& film,
                           const std::atomic<bool>* cancelled = nullptr);

    [[nodiscard]] const Camera& camera() const;  // of the frame rendered last, without jitter
    [[nodiscard]] int threads() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra::renderer
