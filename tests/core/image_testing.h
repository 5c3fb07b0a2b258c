#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <unistd.h>

// What the tests of images share: a folder that vanishes, a generator, damage.

namespace penumbra {

class TemporaryFolder {
  public:
    TemporaryFolder() {
        // In memory where that exists: these tests write thousands of small files.
        std::error_code ignored;
        const std::filesystem::path memory = "/dev/shm";
        const bool has_memory = std::filesystem::is_directory(memory, ignored);
        std::string pattern =
            ((has_memory ? memory : std::filesystem::temp_directory_path()) / "penumbra-XXXXXX")
                .string();
        path_ = ::mkdtemp(pattern.data());
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] std::filesystem::path operator/(std::string_view name) const {
        return path_ / name;
    }

  private:
    std::filesystem::path path_;
};

// SplitMix64: the same sequence everywhere.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    std::uint64_t below(std::uint64_t limit) { return next() % limit; }

  private:
    std::uint64_t state_;
};

inline void write_bytes(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
    std::ofstream stream(file, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
}

// Damages a file in 1 to 4 places: other bytes, extreme numbers, pieces removed, doubled or cut
// off.
inline std::vector<std::uint8_t> mutate(std::vector<std::uint8_t> bytes, std::uint64_t seed) {
    Random random(seed * 7919 + 1);
    for (std::uint64_t n = 1 + random.below(4); n > 0 && bytes.size() > 8; --n) {
        const auto at = static_cast<std::ptrdiff_t>(random.below(bytes.size() - 4));
        const auto place = bytes.begin() + at;
        const auto length = static_cast<std::ptrdiff_t>(
            1 + random.below(std::min<std::uint64_t>(16, bytes.size() - at)));
        switch (random.below(6)) {
            case 0:
                *place = static_cast<std::uint8_t>(random.next());
                break;
            case 1:
                *place ^= static_cast<std::uint8_t>(1u << random.below(8));
                break;
            case 2:
                std::fill_n(place, 4, random.below(2) == 0 ? 0xFF : 0x7F);
                break;
            case 3:
                bytes.erase(place, place + length);
                break;
            case 4: {
                const std::vector<std::uint8_t> piece(place, place + length);
                bytes.insert(place, piece.begin(), piece.end());
                break;
            }
            default:
                if (random.below(8) == 0)
                    bytes.resize(static_cast<std::size_t>(at) + 1);
                else
                    std::fill_n(place, 4, 0x00);
        }
    }
    return bytes;
}

}  // namespace penumbra
