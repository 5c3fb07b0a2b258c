#pragma once

#include <atomic>

namespace penumbra::cli {

// From now on SIGINT and SIGTERM ask for a clean end: the flag becomes true, what is being written
// is finished or removed. A second signal ends the program at once; files stay whole even then,
// since they appear under their names only when complete.
[[nodiscard]] const std::atomic<bool>& catch_interrupts();

// 130 or 143 after an interrupt, else 0.
[[nodiscard]] int interrupt_exit_code();

}  // namespace penumbra::cli
