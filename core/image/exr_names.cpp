#include "core/image/exr.h"

namespace penumbra::image {

std::span<const ExrCompression> exr_compressions() {
    static constexpr ExrCompression kAll[] = {ExrCompression::kNone, ExrCompression::kRle,
                                              ExrCompression::kZips, ExrCompression::kZip,
                                              ExrCompression::kPiz,  ExrCompression::kDwaa};
    return kAll;
}

std::string_view name(ExrCompression compression) {
    constexpr std::string_view kNames[] = {"none", "rle", "zips", "zip", "piz", "dwaa"};
    return kNames[static_cast<int>(compression)];
}

std::string_view name(ExrType type) {
    constexpr std::string_view kNames[] = {"uint", "half", "float"};
    return kNames[static_cast<int>(type)];
}

}  // namespace penumbra::image
