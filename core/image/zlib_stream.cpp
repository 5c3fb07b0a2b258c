#include "core/image/zlib_stream.h"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace penumbra::image {

std::vector<std::uint8_t> deflate(std::span<const std::uint8_t> bytes) {
    constexpr int kFastest = 1;
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(kFastest), &libdeflate_free_compressor);
    if (!compressor) throw std::bad_alloc();
    std::vector<std::uint8_t> stream(
        libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
    stream.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                           stream.data(), stream.size()));
    return stream;
}

std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
    return libdeflate_crc32(0, bytes.data(), bytes.size());
}

}  // namespace penumbra::image
