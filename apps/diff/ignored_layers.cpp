#include "apps/diff/ignored_layers.h"

#include <optional>

#include "apps/diff/image_source.h"
#include "apps/diff/layers.h"

namespace penumbra::diff {
namespace {

std::optional<std::vector<std::string>> layers_of(const std::filesystem::path& file) {
    if (!begins_like_exr(file)) return std::vector<std::string>{"beauty"};  // all other formats
    std::vector<Failure> failures;
    const auto image = open_image(file, 1, failures);
    if (!image) return std::nullopt;
    std::vector<std::string> names;
    for (const Layer& layer : find_layers(*image)) names.push_back(layer.name);
    return names;
}

}  // namespace

std::vector<std::string> find_unknown_layers(const std::vector<FilePair>& pairs,
                                             const std::set<std::string>& layers) {
    std::set<std::string> unknown = layers;
    for (const FilePair& pair : pairs)
        for (const std::filesystem::path& file : {pair.reference, pair.test}) {
            if (unknown.empty()) return {};
            const auto names = layers_of(file);
            if (!names) return {};
            for (const std::string& name : *names) unknown.erase(name);
        }
    return {unknown.begin(), unknown.end()};
}

}  // namespace penumbra::diff
