#include "apps/diff/part_reader.h"

#include <algorithm>
#include <cstring>

namespace penumbra::diff {
namespace {

// Rows that one thread reads at a time: whole blocks of the file, but few enough for all threads to
// have some.
constexpr int kRowsPerTask = 32;

int rounded_up(int n, int to) {
    return (n + to - 1) / to * to;
}

}  // namespace

PartReader::PartReader(ImageSource& reference, ImageSource& test, int part, std::vector<Slot> slots,
                       const parallel::Arena& arena)
    : images_{&reference, &test}, part_(part), slots_(std::move(slots)), arena_(arena) {
    const image::Window& data = reference.parts()[static_cast<std::size_t>(part)].data;
    width_ = data.width();
    height_ = data.height();
    const int lines = std::max(reference.lines_per_block(part), test.lines_per_block(part));
    // Larger blocks (DWAB, tall tiles) are decoded more than once rather than held whole.
    block_ = std::min(rounded_up(kRowsPerTask, lines), 256);
    for (auto& planes : planes_) planes.resize(slots_.size());
}

void PartReader::make_room(int rows) {
    if (rows <= capacity_) return;
    capacity_ = rows;
    for (auto& planes : planes_)
        for (std::size_t i = 0; i < slots_.size(); ++i) {
            SlotPlane larger;
            if (slots_[i].holds_ids)
                larger.ids = Plane<std::uint32_t>(width_, rows);
            else
                larger.floats = Plane<float>(width_, rows);
            planes[i] = std::move(larger);
        }
    first_ = end_ = 0;
}

void PartReader::move_up(int by, int rows) {
    const auto move = [&](auto& plane) {
        const std::size_t bytes = static_cast<std::size_t>(plane.stride()) * sizeof(*plane.row(0));
        std::memmove(plane.row(0), plane.row(by), static_cast<std::size_t>(rows) * bytes);
    };
    for (auto& planes : planes_)
        for (std::size_t i = 0; i < slots_.size(); ++i)
            slots_[i].holds_ids ? move(planes[i].ids) : move(planes[i].floats);
}

void PartReader::read(Side side, int first, int end, int worker) {
    std::vector<ChannelRows> rows;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        SlotPlane& plane = planes_[at(side)][i];
        ChannelRows row;
        row.channel =
            side == Side::kReference ? slots_[i].reference_channel : slots_[i].test_channel;
        if (slots_[i].holds_ids)
            row.ids = plane.ids.view().offset(0, first - first_);
        else
            row.floats = plane.floats.view().offset(0, first - first_);
        rows.push_back(row);
    }
    images_[at(side)]->read(part_, first, end, rows, worker);
}

void PartReader::load(int first, int end) {
    end = std::min(rounded_up(end, block_), height_);
    make_room(end - first);
    const bool overlaps = first >= first_ && first < end_;
    const int kept = overlaps ? std::max(end_ - first, 0) : 0;
    if (kept > 0) move_up(first - first_, std::min(kept, end - first));
    first_ = first;
    const int begin = first + kept;
    end_ = std::max(end, begin);
    const int first_block = begin / block_;
    const int blocks = begin < end ? (end - 1) / block_ - first_block + 1 : 0;
    arena_.for_each(2 * blocks, [&](int index, int worker) {
        const int block = first_block + index / 2;
        read(static_cast<Side>(index % 2), std::max(begin, block * block_),
             std::min(end, (block + 1) * block_), worker);
    });
}

bool PartReader::is_same(int slot, int y, int x0, int x1) const {
    const std::size_t bytes = static_cast<std::size_t>(x1 - x0) * 4;
    if (slots_[static_cast<std::size_t>(slot)].holds_ids)
        return std::memcmp(ids(Side::kReference, slot, y) + x0, ids(Side::kTest, slot, y) + x0,
                           bytes) == 0;
    return std::memcmp(floats(Side::kReference, slot, y) + x0, floats(Side::kTest, slot, y) + x0,
                       bytes) == 0;
}

}  // namespace penumbra::diff
