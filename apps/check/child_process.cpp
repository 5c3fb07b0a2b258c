#include "apps/check/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "core/error.h"

namespace penumbra::check {
namespace {

constexpr int kCouldNotStart = 127;  // as shells have it

// Between fork and exec: nothing but system calls, since other threads' locks may be held.
[[noreturn]] void become(char* const* argv, int null, int log, pid_t parent) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const bool is_orphan = getppid() != parent;
    if (!is_orphan && dup2(null, STDIN_FILENO) >= 0 && dup2(null, STDOUT_FILENO) >= 0 &&
        dup2(log, STDERR_FILENO) >= 0)
        execv(argv[0], argv);
    _exit(kCouldNotStart);
}

class Descriptor {
  public:
    Descriptor(const std::filesystem::path& file, int flags)
        : number_(open(file.c_str(), flags | O_CLOEXEC, 0666)) {
        if (number_ < 0) throw OutputError(file, std::strerror(errno));
    }
    ~Descriptor() { close(number_); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int number() const { return number_; }

  private:
    int number_;
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& argv, const std::filesystem::path& log) {
    std::vector<char*> words;
    words.reserve(argv.size() + 1);
    for (const std::string& word : argv) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const Descriptor null("/dev/null", O_RDWR);
    const Descriptor out(log, O_WRONLY | O_CREAT | O_TRUNC);
    const pid_t parent = getpid();
    id_ = fork();
    if (id_ < 0) throw OutputError(argv[0], fmt::format("cannot be run: {}", std::strerror(errno)));
    if (id_ == 0) become(words.data(), null.number(), out.number(), parent);
    setpgid(id_, id_);  // here too: whoever is first
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept : id_(std::exchange(other.id_, -1)) {}

ChildProcess::~ChildProcess() {
    if (id_ < 0) return;
    kill();
    while (waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

std::optional<ChildProcess::Ending> ChildProcess::poll() {
    int status = 0;
    if (id_ < 0 || waitpid(id_, &status, WNOHANG) != id_) return std::nullopt;
    id_ = -1;
    if (WIFSIGNALED(status)) return Ending{.signal = WTERMSIG(status)};
    return Ending{.exit_code = WEXITSTATUS(status)};
}

void ChildProcess::kill() {
    if (id_ > 0) ::kill(-id_, SIGKILL);
}

}  // namespace penumbra::check
