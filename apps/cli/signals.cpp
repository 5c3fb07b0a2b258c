#include "apps/cli/signals.h"

#include <unistd.h>
#include <csignal>

namespace penumbra::cli {
namespace {

// Signal handlers can reach nothing but static storage.
std::atomic<bool> interrupted{false};
volatile std::sig_atomic_t received_signal = 0;

void on_signal(int signal_number) {
    if (received_signal != 0) _exit(128 + signal_number);
    received_signal = signal_number;
    interrupted.store(true);
}

}  // namespace

const std::atomic<bool>& catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGHUP, &action, nullptr);
    // A file that grows beyond the limit is an error of that write, not the end.
    action.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &action, nullptr);
    return interrupted;
}

int interrupt_exit_code() {
    return received_signal == 0 ? 0 : 128 + received_signal;
}

}  // namespace penumbra::cli
