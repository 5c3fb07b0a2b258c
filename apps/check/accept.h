#pragma once

#include <atomic>
#include <vector>

#include "apps/check/outcome.h"

namespace penumbra::check {

struct Acceptance {
    bool update = false, bless = false;
};

// Judges all goldens of a run against each other, those that renders would become included, and
// writes the fit ones: whole or not at all, and only those that failed (update) or were missing
// (bless). A golden that is black, one colour, or equal to another is unfit. Where `cancelled`
// becomes true, the goldens that are not yet written stay as they are.
void accept(const Acceptance& acceptance, std::vector<CheckOutcome>& outcomes,
            const std::atomic<bool>& cancelled);

}  // namespace penumbra::check
