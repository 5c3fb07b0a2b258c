#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace penumbra::diff {

struct FilePair {
    std::string name;  // what distinguishes it: the frame, the path within the folders
    std::filesystem::path reference, test;
};

// Two files, two patterns or two folders:
//   a.exr b.exr              one pair
//   ref.####.exr out.####.exr one per frame number that either has
//   ref/ out/                one per image file (.exr .hdr .png .jpg .jpeg) in either, sub-folders
//                            included
// A file that only one side has makes a pair all the same: it is reported as missing. Sorted by
// name. Throws InputError where a side is not there, has no images, or is of another kind.
[[nodiscard]] std::vector<FilePair> find_pairs(const std::string& reference,
                                               const std::string& test);

}  // namespace penumbra::diff
