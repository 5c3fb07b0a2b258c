#pragma once

#include <filesystem>
#include <string_view>

#include "apps/bench/report.h"

namespace penumbra::bench {

// A report from the JSON that `penumbra bench --json` writes. Throws InputError with the place of
// what is missing or not as it should be; keys it does not know are another version's.
[[nodiscard]] Report read_report(const std::filesystem::path& file);
[[nodiscard]] Report parse_report(const std::filesystem::path& file, std::string_view text);

}  // namespace penumbra::bench
