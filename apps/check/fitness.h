#pragma once

#include <filesystem>
#include <string>

#include "core/scene/digest.h"

namespace penumbra::check {

// What makes a picture worth comparing with.
struct Fitness {
    Digest pixels;        // of all channels: names, types and values, nothing else of the file
    std::string problem;  // "is black", ...; empty: none
};

// A golden that is black or one colour would let a renderer pass that draws nothing; one with
// values that are no finite numbers can never be matched. Judged by R, G and B where the file has
// them, else by all channels. Read in bands of rows. Throws InputError where the file cannot be
// read.
[[nodiscard]] Fitness judge_picture(const std::filesystem::path& exr_file);

}  // namespace penumbra::check
