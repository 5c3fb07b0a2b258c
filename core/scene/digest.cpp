#include "core/scene/digest.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fstream>

#include "core/error.h"

namespace penumbra {
namespace {

class Hasher {
  public:
    Hasher() : state_(XXH3_createState()) {
        if (!state_) throw std::bad_alloc();
        XXH3_128bits_reset(state_);
    }
    ~Hasher() { XXH3_freeState(state_); }
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    void add(std::string_view bytes) { XXH3_128bits_update(state_, bytes.data(), bytes.size()); }

    // The length behind a content keeps "ab" + "c" apart from "a" + "bc".
    void end_content(std::uint64_t length) {
        char bytes[8];
        for (int i = 0; i < 8; ++i) bytes[i] = static_cast<char>(length >> (8 * i));
        add({bytes, sizeof bytes});
    }
    [[nodiscard]] Digest digest() const {
        const XXH128_hash_t hash = XXH3_128bits_digest(state_);
        return {hash.high64, hash.low64};
    }

  private:
    XXH3_state_t* state_;
};

void add_file(const std::filesystem::path& file, Hasher& hasher) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw OutputError(file, "cannot be read again");
    std::string block(std::size_t{1} << 20, '\0');
    std::uint64_t length = 0;
    while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) ||
           stream.gcount() > 0) {
        const auto count = static_cast<std::size_t>(stream.gcount());
        hasher.add({block.data(), count});
        length += count;
    }
    if (stream.bad()) throw OutputError(file, "reading failed");
    hasher.end_content(length);
}

}  // namespace

std::string Digest::hex() const {
    return fmt::format("{:016x}{:016x}", high, low);
}

Digest digest_of(const Scene& scene) {
    Hasher hasher;
    for (const std::filesystem::path& file : scene.files) add_file(file, hasher);
    return hasher.digest();
}

Digest digest_of(std::string_view text, const VirtualFiles& files) {
    Hasher hasher;
    hasher.add(text);
    hasher.end_content(text.size());
    for (const auto& [name, content] : files) {
        hasher.add(content);
        hasher.end_content(content.size());
    }
    return hasher.digest();
}

}  // namespace penumbra
