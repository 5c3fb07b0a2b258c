#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Small pieces for the texts that the kernel writes.

namespace penumbra::parallel {

[[nodiscard]] std::vector<std::string_view> split_words(std::string_view text,
                                                        std::string_view separators);
// Nothing unless the text is one decimal number.
[[nodiscard]] std::optional<long long> parse_integer(std::string_view text);
// "" where the file cannot be read.
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

}  // namespace penumbra::parallel
