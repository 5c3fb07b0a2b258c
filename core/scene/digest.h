#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/scene/input_files.h"
#include "core/scene/scene.h"

namespace penumbra {

// 128 bits of XXH3: two scenes with the same digest are the same for all purposes but an
// attacker's.
struct Digest {
    std::uint64_t high = 0, low = 0;

    [[nodiscard]] std::string hex() const;  // 32 digits
    friend bool operator==(const Digest&, const Digest&) = default;
};

// Of the contents of all files that were read for a scene, in the order of reading: neither their
// names nor where they lie count. Files are streamed, not held. Throws OutputError where one cannot
// be read any more.
[[nodiscard]] Digest digest_of(const Scene& scene);

// Of a scene that was read from memory.
[[nodiscard]] Digest digest_of(std::string_view text, const VirtualFiles& files);

}  // namespace penumbra
