#pragma once

#include "core/parallel/arena.h"

// Does anybody else compute on our cores? The other hardware thread of a core, which on a shared
// host belongs to a neighbour, is seen by no counter of ours, and slows down each pass by another
// factor.

namespace penumbra::bench {

// The time of a loop that waits for itself and leaves most of its core idle, divided by that of
// one that fills its core. Only the latter gets slower where the core is shared, both where its
// clock does. So it is a constant of the processor while nobody else is there, and less otherwise;
// the least of all threads. Takes half a millisecond.
[[nodiscard]] double core_share(const parallel::Arena& arena);

}  // namespace penumbra::bench
