#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace penumbra::renderer {

// Frame numbers from a list such as "1-48, 1-100x2, 5,9,20-30" ("-5--1" for negative ones), in the
// order given, each once. Throws InputError that names the item and what was expected.
[[nodiscard]] std::vector<int> parse_frame_list(std::string_view text);

// "out/shot.####.exr" -> "out/shot.0012.exr": each run of '#' in the file name becomes the frame
// number, padded with zeros to the run's length.
[[nodiscard]] std::string expand_pattern(std::string_view pattern, int frame);

// Does the pattern give each frame a file of its own?
[[nodiscard]] bool has_frame_number(std::string_view pattern);

}  // namespace penumbra::renderer
