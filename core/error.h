#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

// The two kinds of failure. Bad input and bad disks are exceptions that name the file, the place in
// it and what was expected; a broken promise of ours is PENUMBRA_ASSERT. Only `main` catches.

namespace penumbra {

// Something the user gave is wrong: exit code 2.
class InputError : public std::runtime_error {
  public:
    explicit InputError(const std::string& message) : std::runtime_error(message) {}
    // "shot.json: lights[2].radiance: expected 3 numbers, got \"white\""
    InputError(const std::filesystem::path& file, std::string_view place, std::string_view message)
        : std::runtime_error(fmt::format("{}: {}: {}", file.string(), place, message)) {}
    InputError(const std::filesystem::path& file, std::string_view message)
        : std::runtime_error(fmt::format("{}: {}", file.string(), message)) {}
};

// Reading, writing or memory failed although what the user asked was right: exit code 3.
class OutputError : public std::runtime_error {
  public:
    explicit OutputError(const std::string& message) : std::runtime_error(message) {}
    OutputError(const std::filesystem::path& file, std::string_view message)
        : std::runtime_error(fmt::format("{}: {}", file.string(), message)) {}
};

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line,
                                   const std::string& values);

}  // namespace penumbra

// PENUMBRA_ASSERT(x < n, "x = {}, n = {}", x, n): checked in debug builds and under sanitizers.
#if defined(NDEBUG)
#define PENUMBRA_ASSERT(condition, ...) static_cast<void>(0)
#else
#define PENUMBRA_ASSERT(condition, ...)                                         \
    ((condition) ? static_cast<void>(0)                                         \
                 : ::penumbra::assertion_failed(#condition, __FILE__, __LINE__, \
                                                ::fmt::format(__VA_ARGS__)))
#endif
