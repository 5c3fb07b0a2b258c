#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace penumbra::check {

// One scene that is checked, by its files. For the check NAME these are
//   NAME.check.json          how it is rendered, and how much may differ (optional)
//   NAME.json, NAME.obj      the scene, unless the settings name another one
//   NAME.golden.exr          what it has to look like; NAME.golden.0012.exr for each of several
//                            frames
struct Check {
    std::string name;  // with the folder it lies in, without endings: "goldens/teapot"
    std::filesystem::path settings;  // empty: none
    std::filesystem::path scene;     // empty: the settings have to name it
};

// The golden of a frame, "0012"; "" for the only one.
[[nodiscard]] std::filesystem::path golden_path(const std::string& check_name,
                                                const std::string& frame);

// Goldens that lie there for a check, sorted.
[[nodiscard]] std::vector<std::filesystem::path> existing_goldens(const std::string& check_name);

// "12", "0012", "-003": what stands for a frame in a file's name.
[[nodiscard]] bool is_frame_number(std::string_view text);

// The checks that scenes, models, *.check.json files and folders stand for, sorted by name, each
// once. A folder is searched with all below it (hidden folders and links to folders excepted) for
// NAME.check.json and NAME.golden*.exr: other scenes there are not meant. Throws InputError where a
// path is not there, is none of these, or a folder has no check.
[[nodiscard]] std::vector<Check> find_checks(const std::vector<std::string>& paths);

// Those whose name holds one of the texts, in which '*' and '?' stand for any text and any
// character. Throws InputError where none is left.
[[nodiscard]] std::vector<Check> filtered(std::vector<Check> checks,
                                          const std::vector<std::string>& filters);

}  // namespace penumbra::check
