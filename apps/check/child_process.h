#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace penumbra::check {

// A program that runs beside this one, in a process group of its own: what it does to itself, it
// does to nobody else. It dies with this process.
class ChildProcess {
  public:
    // argv[0] is the program's file. Standard output is dropped, the error stream goes to `log`.
    // Throws OutputError where it cannot be started.
    ChildProcess(const std::vector<std::string>& argv, const std::filesystem::path& log);
    ~ChildProcess();  // kills it if it still runs
    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&&) = delete;
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    struct Ending {
        int exit_code = 0;  // where signal is 0
        int signal = 0;
    };
    // How it ended; nothing while it runs.
    [[nodiscard]] std::optional<Ending> poll();
    void kill();

  private:
    pid_t id_ = -1;
};

}  // namespace penumbra::check
