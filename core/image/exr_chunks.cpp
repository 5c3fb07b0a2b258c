#include "core/image/exr_structure.h"

namespace penumbra::image {
namespace {

// Is the chunk whose offset stands in the table in the file to its last byte, and the one that the
// table says?
class ChunkCheck {
  public:
    ChunkCheck(const FileReader& file, const ExrPart& part, int number, bool multi_part)
        : file_(file), part_(part), number_(number), multi_part_(multi_part) {}

    [[nodiscard]] bool is_whole(std::size_t index, std::uint64_t offset) const {
        std::uint8_t head[48];
        const std::size_t prefix = multi_part_ ? 4 : 0;
        const std::size_t place = part_.is_tiled ? 16 : 4;
        const std::size_t sizes = part_.is_deep ? 24 : 4;
        const std::size_t length = prefix + place + sizes;
        if (offset < 8 || !file_.read_at(offset, {head, length})) return false;
        if (multi_part_ && little_uint32(head) != static_cast<std::uint32_t>(number_)) return false;
        if (!part_.is_tiled && !is_at_line(index, head + prefix)) return false;
        const std::uint64_t available = file_.size() - offset - length;
        const std::uint8_t* size = head + prefix + place;
        if (!part_.is_deep) {
            return little_uint32(size) >= 1 && little_uint32(size) <= available;
        }
        const std::uint64_t table = little_uint64(size);
        return table <= available && little_uint64(size + 8) <= available - table;
    }

  private:
    [[nodiscard]] bool is_at_line(std::size_t index, const std::uint8_t* line) const {
        const std::int64_t expected =
            part_.data.y0 + static_cast<std::int64_t>(index) * lines_per_chunk(part_.codec);
        return static_cast<std::int32_t>(little_uint32(line)) == expected;
    }

    const FileReader& file_;
    const ExrPart& part_;
    int number_;
    bool multi_part_;
};

}  // namespace

std::size_t count_missing_chunks(const FileReader& file, std::span<const ExrPart> parts,
                                 std::uint64_t position, bool multi_part) {
    std::size_t missing = 0;
    for (std::size_t number = 0; number < parts.size(); ++number) {
        const ExrPart& part = parts[number];
        const ChunkCheck check(file, part, static_cast<int>(number), multi_part);
        for (std::size_t i = 0; i < part.chunks; ++i, position += 8) {
            std::uint8_t entry[8];
            if (!file.read_at(position, entry)) {
                // The table itself is cut off: so is all that follows it.
                missing += part.chunks - i;
                position += 8 * (part.chunks - i);
                break;
            }
            if (!check.is_whole(i, little_uint64(entry))) ++missing;
        }
    }
    return missing;
}

}  // namespace penumbra::image
