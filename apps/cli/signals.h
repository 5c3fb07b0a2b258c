#pragma once

#include <atomic>

namespace penumbra::cli {

// From now on SIGINT, SIGTERM and SIGHUP ask for a clean end: the flag becomes true, what is being
// written is finished or removed. A second signal ends the program at once; files stay whole even
// then, since they appear under their names only when complete.
[[nodiscard]] const std::atomic<bool>& catch_interrupts();

// 128 + the signal after an interrupt (130, 143, 129), else 0.
[[nodiscard]] int interrupt_exit_code();

}  // namespace penumbra::cli
