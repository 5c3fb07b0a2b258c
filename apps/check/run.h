#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "apps/check/outcome.h"
#include "apps/check/render_job.h"
#include "core/parallel/arena.h"

namespace penumbra::check {

struct RunSettings {
    RenderSettings render;
    int jobs = 0;     // renders at once; 0: as many as there are threads and memory for
    int threads = 0;  // of each render; 0: what the machine allows, divided by the jobs
    // Where the new renders go; must be there. `scratch` is for what nobody keeps.
    std::filesystem::path renders, scratch;
    bool wants_pictures = false;  // FrameOutcome::pictures
    bool may_update = false;      // renders replace goldens they fail against
    bool may_bless = false;       // renders become goldens where there are none
};

// Renders the checks, each in a process of its own, so that a crash is that scene's alone, and
// compares them. `on_outcome` is called in the checks' order as results come. Afterwards, with all
// pictures at hand, goldens are judged and, where allowed, written: see accept.h. Where `cancelled`
// becomes true the renders end and what is there is returned; no golden is touched then.
[[nodiscard]] std::vector<CheckOutcome> run_checks(
    const std::vector<Check>& checks, const RunSettings& settings,
    const std::function<void(const CheckOutcome&)>& on_outcome, const std::atomic<bool>& cancelled);

}  // namespace penumbra::check
