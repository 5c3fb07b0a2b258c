#include "core/error.h"
#include "core/image/exr.h"

namespace penumbra::image {
namespace {

constexpr std::string_view kCompressionNames[] = {"none", "rle", "zips", "zip", "piz", "dwaa"};

}  // namespace

std::string_view name(ExrCompression compression) {
    return kCompressionNames[static_cast<int>(compression)];
}

ExrCompression parse_exr_compression(std::string_view text) {
    for (int i = 0; i < static_cast<int>(std::size(kCompressionNames)); ++i) {
        if (kCompressionNames[i] == text) return static_cast<ExrCompression>(i);
    }
    throw InputError(
        fmt::format("compression '{}': expected none, rle, zips, zip, piz or dwaa", text));
}

std::string_view name(ExrType type) {
    constexpr std::string_view kNames[] = {"uint", "half", "float"};
    return kNames[static_cast<int>(type)];
}

}  // namespace penumbra::image
