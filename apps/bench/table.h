#pragma once

#include <string>

#include "apps/bench/report.h"

namespace penumbra::bench {

// The report for people: machine, then per scene and number of threads a row per pass, then how the
// passes scale.
[[nodiscard]] std::string table(const Report& report);

// "1.25 GiB": three digits.
[[nodiscard]] std::string binary_bytes(std::uint64_t bytes);

// The throughputs that a pass has, in Mpixel/s, Mtriangle/s, Mray/s and GB/s: "11.2 Mpixel/s".
[[nodiscard]] std::string rates(const PassResult& pass);

}  // namespace penumbra::bench
