#pragma once

#include <set>
#include <string>
#include <vector>

#include "apps/diff/image_source.h"

namespace penumbra::diff {

// Channels that are judged together: those with a common prefix ("albedo.R", "albedo.G", ...).
// Channels without a prefix: R G B A Y are the layer "beauty", any other is a layer of its own
// name. In files of several parts the part's name and a colon stand before the layer's.
struct Layer {
    std::string name;
    int part = 0;
    std::vector<int> channels;  // of the part, in its order
    // Places in `channels` of red, green and blue (or three times of grey); none where this is no
    // picture.
    std::vector<int> colour;
    [[nodiscard]] bool is_colour() const { return !colour.empty(); }
};

[[nodiscard]] std::vector<Layer> find_layers(const ImageSource& image);

// What differs in the make-up of two images; `ignored` layers do not count. Where nothing is
// returned, parts, layers and channels of both correspond one to one.
[[nodiscard]] std::vector<Failure> compare_structure(const ImageSource& reference,
                                                     const ImageSource& test,
                                                     const std::set<std::string>& ignored);

}  // namespace penumbra::diff
