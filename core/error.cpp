#include "core/error.h"

#include <cstdio>
#include <cstdlib>

namespace penumbra {

void assertion_failed(const char* condition, const char* file, int line,
                      const std::string& values) {
    fmt::print(stderr, "{}:{}: broken promise: {} ({})\n", file, line, condition, values);
    std::abort();
}

}  // namespace penumbra
