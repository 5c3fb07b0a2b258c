#pragma once

#include <cstdio>
#include <string>

namespace penumbra::tests {

// Says that a test cannot run here, in the form that tests/run.sh counts. The test returns after
// it.
inline void report_skip(const std::string& reason) {
    std::printf("[skipped] %s\n", reason.c_str());
}

}  // namespace penumbra::tests
