#include "core/scene/texture.h"

#include <algorithm>
#include <cmath>

#include "core/math/vec.h"
#include "core/scene/texture_rows.h"

namespace penumbra {
namespace {

// What the four floats of a texel are while levels are averaged.
enum class Meaning {
    kPlain,          // red, green, blue, alpha
    kWeightedColor,  // a colour times its weight, and the weight: alpha + kLeastWeight
    kVector,  // a normal, not of unit length in coarse levels: their mean keeps its direction
};

// What a transparent texel's colour still counts, so that a wholly transparent region has one.
constexpr float kLeastWeight = 1.0f / (1 << 20);

Meaning meaning_of(TextureKind kind, bool has_alpha) {
    if (kind == TextureKind::kNormal || kind == TextureKind::kHeight) return Meaning::kVector;
    return kind == TextureKind::kColor && has_alpha ? Meaning::kWeightedColor : Meaning::kPlain;
}

// ---- packing ---------------------------------------------------------------------------------

std::uint32_t to_unorm16(float value) {
    return static_cast<std::uint32_t>(simd::saturate(value) * 65535.0f + 0.5f);
}

WideTexel to_stored(const WideTexel& texel, Meaning meaning) {
    if (meaning == Meaning::kWeightedColor) {
        const float scale = 1 / texel[3];
        return {texel[0] * scale, texel[1] * scale, texel[2] * scale, texel[3] - kLeastWeight};
    }
    if (meaning == Meaning::kVector) {
        const Vec3f vector{texel[0], texel[1], texel[2]};
        const float squared = length_squared(vector);
        // Opposite normals that cancel leave the flat surface.
        if (!(squared > 1e-12f)) return {0.5f, 0.5f, 1, 1};
        const Vec3f half = vector * (0.5f / std::sqrt(squared));
        return {0.5f + half.x, 0.5f + half.y, 0.5f + half.z, 1};
    }
    return texel;
}

void append_row(Texture& texture, std::span<const WideTexel> row, Meaning meaning) {
    for (const WideTexel& texel : row) {
        const WideTexel stored = to_stored(texel, meaning);
        texture.texels.push_back(to_unorm16(stored[0]) | to_unorm16(stored[1]) << 16);
        texture.texels.push_back(to_unorm16(stored[2]) | to_unorm16(stored[3]) << 16);
    }
}

void begin_level(Texture& texture, int width, int height) {
    texture.levels.push_back({width, height, static_cast<std::int32_t>(texture.texels.size())});
}

std::size_t chain_words(int width, int height) {
    std::size_t words = 0;
    for (;; width = std::max(1, width / 2), height = std::max(1, height / 2)) {
        words +=
            std::size_t{2} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        if (width == 1 && height == 1) return words;
    }
}

// ---- the box filter --------------------------------------------------------------------------

// A coarse texel covers size / (size / 2) texels of an axis: two where the size is even; where it
// is odd, three of which it covers parts. The weights are those areas.
struct Taps {
    int first;
    int count;
    float weight[3];
};

Taps make_taps(int i, int size) {
    if (size == 1) return {0, 1, {1, 0, 0}};
    if (size % 2 == 0) return {2 * i, 2, {0.5f, 0.5f, 0}};
    const int coarse = size / 2;
    const auto share = [&](int n) { return static_cast<float>(n) / static_cast<float>(size); };
    return {2 * i, 3, {share(coarse - i), share(coarse), share(i + 1)}};
}

struct Level {
    int width = 0;
    int height = 0;
    std::vector<WideTexel> texels;

    Level(int w, int h)
        : width(w), height(h), texels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    [[nodiscard]] std::span<WideTexel> row(int y) {
        return std::span(texels).subspan(static_cast<std::size_t>(y) * width, width);
    }
};

// row += weight * (the wide row, filtered along x)
void add_filtered(std::span<WideTexel> row, std::span<const WideTexel> wide, float weight) {
    for (std::size_t x = 0; x < row.size(); ++x) {
        const Taps taps = make_taps(static_cast<int>(x), static_cast<int>(wide.size()));
        for (int i = 0; i < taps.count; ++i) {
            const WideTexel& texel = wide[static_cast<std::size_t>(taps.first + i)];
            const float share = weight * taps.weight[i];
            for (std::size_t c = 0; c < 4; ++c) row[x][c] += share * texel[c];
        }
    }
}

// Adds row y of a level of `height` rows to the next coarser level; rows come in order.
void scatter_row(std::span<const WideTexel> wide, int y, int height, Level& coarse) {
    for (int target = std::max(0, y / 2 - 1); target <= std::min(y / 2, coarse.height - 1);
         ++target) {
        const Taps taps = make_taps(target, height);
        const int tap = y - taps.first;
        if (tap >= taps.count) continue;
        add_filtered(coarse.row(target), wide, taps.weight[tap]);
    }
}

Level make_coarser(int width, int height) {
    return Level(std::max(1, width / 2), std::max(1, height / 2));
}

// Level 0 goes straight from the image into the texture and into level 1.
Level append_level_0(Texture& texture, const image::DecodedImage& image, TextureRows& rows,
                     Meaning meaning) {
    Level coarse = make_coarser(image.width, image.height);
    std::vector<WideTexel> row(static_cast<std::size_t>(image.width));
    begin_level(texture, image.width, image.height);
    for (int y = 0; y < image.height; ++y) {
        rows.fill(y, row);
        if (meaning == Meaning::kWeightedColor) {
            for (WideTexel& texel : row) {
                texel[3] += kLeastWeight;
                for (std::size_t c = 0; c < 3; ++c) texel[c] *= texel[3];
            }
        }
        append_row(texture, row, meaning);
        scatter_row(row, y, image.height, coarse);
    }
    return coarse;
}

void append_coarser_levels(Texture& texture, Level level, Meaning meaning) {
    while (true) {
        begin_level(texture, level.width, level.height);
        append_row(texture, level.texels, meaning);
        if (level.width == 1 && level.height == 1) return;
        Level coarse = make_coarser(level.width, level.height);
        for (int y = 0; y < level.height; ++y) scatter_row(level.row(y), y, level.height, coarse);
        level = std::move(coarse);
    }
}

}  // namespace

LoadedTexture make_texture(const image::DecodedImage& image, std::string name,
                           const TextureRequest& request) {
    LoadedTexture loaded;
    Texture& texture = loaded.texture;
    TextureRows rows(image, request, name);
    const Meaning meaning = meaning_of(request.kind, rows.texels_have_alpha());
    texture.texels.reserve(chain_words(image.width, image.height));
    Level coarse = append_level_0(texture, image, rows, meaning);
    if (image.width > 1 || image.height > 1) {
        append_coarser_levels(texture, std::move(coarse), meaning);
    }
    loaded.has_alpha = rows.image_has_alpha();
    loaded.clamped_texels = rows.clamped_texels();
    texture.name = std::move(name);
    return loaded;
}

LoadedTexture load_texture(const std::filesystem::path& file, const TextureRequest& request) {
    return make_texture(image::decode_image(file), file.string(), request);
}

Texel texel(const Texture& texture, int level, int x, int y) {
    const Texture::Level& at = texture.levels[static_cast<std::size_t>(level)];
    const std::size_t word = static_cast<std::size_t>(at.offset) +
                             2 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(at.width) +
                                  static_cast<std::size_t>(x));
    const auto unit = [](std::uint32_t bits) {
        return static_cast<float>(bits & 0xFFFF) / 65535.0f;
    };
    const std::uint32_t red_green = texture.texels[word];
    const std::uint32_t blue_alpha = texture.texels[word + 1];
    return {unit(red_green), unit(red_green >> 16), unit(blue_alpha), unit(blue_alpha >> 16)};
}

}  // namespace penumbra
