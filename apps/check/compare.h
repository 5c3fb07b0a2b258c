#pragma once

#include <filesystem>
#include <vector>

#include "apps/check/outcome.h"
#include "apps/check/render_job.h"
#include "core/parallel/arena.h"

namespace penumbra::check {

// Which pictures of a comparison are kept, and where: a file per frame, "" for none.
struct PictureWish {
    std::filesystem::path stem;
    [[nodiscard]] bool is_wanted() const { return !stem.empty(); }
};

// Fills the outcome's frames: each render against its golden, by the library of `penumbra diff`.
void compare_frames(const std::vector<RenderedFrame>& renders, const PictureWish& pictures,
                    const parallel::Arena& arena, CheckOutcome& outcome);

}  // namespace penumbra::check
