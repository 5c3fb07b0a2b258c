#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace penumbra {

namespace image {
struct DecodedImage;
}

// A mip chain of scene-linear RGBA texels in [0, 1], 16 bits a channel: enough for the darkest
// steps of 8-bit sRGB, and two 32-bit gathers a texel. Texel (x, y) of a level with width w lies at
// texels[offset + 2 * (y * w + x)], red | green << 16, followed by blue | alpha << 16. Row 0 is the
// image's top. Coordinates repeat.
struct Texture {
    struct Level {
        int width, height;
        std::int32_t offset;  // into `texels`, counted in 32-bit words
    };
    std::string name;
    std::vector<Level>
        levels;  // halving to 1 x 1, each the box filter of the one before; at most 16
    std::vector<std::uint32_t> texels;  // fewer than 2^31 words
};

enum class TextureKind {
    kColor,    // 8-bit samples are sRGB, all others linear; alpha 1 where the file has none
    kData,     // linear, whatever the depth: roughness, metallic
    kOpacity,  // linear; alpha is the file's alpha, or where it has none (or only ones) its
               // luminance
    kNormal,   // tangent space, 0.5 + 0.5 n, x along u, y along v (up); unit vectors in every level
    kHeight,   // luminance is a height; converted to kNormal
};

// White over black of a height map, as a share of the image's width, where nobody says: 1 cm of
// relief on a tile of 1 m.
inline constexpr float kDefaultRelief = 0.01f;

struct TextureRequest {
    TextureKind kind = TextureKind::kColor;
    // Packed maps: this channel of the file (0 to 3 for R, G, B, A) stands for all of them; in
    // kOpacity and kHeight it is the opacity, the height. Grey files answer with their grey for 0
    // to 2.
    std::optional<int> channel = std::nullopt;
    float relief = kDefaultRelief;  // kHeight: times MTL's -bm
};

struct LoadedTexture {
    Texture texture;
    bool has_alpha = false;          // the file had an alpha channel that is not 1 everywhere
    std::size_t clamped_texels = 0;  // had a value outside [0, 1] or none: clamped (NaN to 0)
};

// Reads a file and builds the mip chain: odd sizes by exact area weights, so that every level has
// the mean of the image; colours with alpha are averaged weighted by alpha, normals as vectors.
// Throws InputError like image::decode_image, and where `channel` does not exist.
[[nodiscard]] LoadedTexture load_texture(const std::filesystem::path& file,
                                         const TextureRequest& request);

// The same from an image at hand (decode once, look whether it is grey, choose the kind).
[[nodiscard]] LoadedTexture make_texture(const image::DecodedImage& image, std::string name,
                                         const TextureRequest& request);

// A texel of a level, each channel in [0, 1]: for tests and tools, not for inner loops.
struct Texel {
    float r, g, b, a;
};
[[nodiscard]] Texel texel(const Texture& texture, int level, int x, int y);

}  // namespace penumbra
