#pragma once

#include <string>

#include "apps/renderer/film.h"
#include "apps/renderer/output_settings.h"
#include "core/frame/camera.h"
#include "core/image/exr.h"

namespace penumbra::renderer {

// What a frame's file says beside its pixels; nothing volatile.
struct FrameIdentity {
    int frame = 0;
    double frames_per_second = 24;
    Camera camera;
    std::string digest;    // of scene, settings and version: what --resume compares
    std::string settings;  // the settings in words
};

// The film's crop with the wanted AOVs as a file. The result points into the film.
[[nodiscard]] image::ExrImage describe_file(const Film& film, const FrameIdentity& identity,
                                            const OutputSettings& output);

// Writes the EXR and the preview, each whole or not at all.
image::ExrWriteReport write_frame(const Film& film, const FrameIdentity& identity,
                                  const OutputSettings& output, int threads);

// Is there a complete file made from the same scene and settings, and the preview that is asked
// for?
[[nodiscard]] bool is_already_rendered(const OutputSettings& output, int frame,
                                       const std::string& digest);

}  // namespace penumbra::renderer
