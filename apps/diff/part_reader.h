#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/diff/image_source.h"
#include "core/parallel/arena.h"

namespace penumbra::diff {

enum class Side { kReference, kTest };

// One channel of both images.
struct Slot {
    int reference_channel = 0;
    int test_channel = 0;
    bool holds_ids = false;
};

// A window of rows over one part of both images that moves downwards: a few hundred rows are in
// memory, whatever the images' size.
class PartReader {
  public:
    PartReader(ImageSource& reference, ImageSource& test, int part, std::vector<Slot> slots,
               const parallel::Arena& arena);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    // Afterwards rows [first, end), counted from the data window's top, can be asked for. Rows that
    // are there already are not read again. Both images are read at once, in blocks, by all
    // threads.
    void load(int first, int end);

    // A row of a slot; ids or floats, as the slot says.
    [[nodiscard]] const float* floats(Side side, int slot, int y) const {
        return planes_[at(side)][static_cast<std::size_t>(slot)].floats.row(y - first_);
    }
    [[nodiscard]] const std::uint32_t* ids(Side side, int slot, int y) const {
        return planes_[at(side)][static_cast<std::size_t>(slot)].ids.row(y - first_);
    }
    [[nodiscard]] const Slot& slot(int index) const {
        return slots_[static_cast<std::size_t>(index)];
    }
    // Are the bits of columns [x0, x1) the same in both images?
    [[nodiscard]] bool is_same(int slot, int y, int x0, int x1) const;

  private:
    struct SlotPlane {
        Plane<float> floats;
        Plane<std::uint32_t> ids;
    };
    static std::size_t at(Side side) { return static_cast<std::size_t>(side); }
    void make_room(int rows);
    void move_up(int by, int rows);
    void read(Side side, int first, int end, int worker);

    std::array<ImageSource*, 2> images_;
    int part_;
    std::vector<Slot> slots_;
    const parallel::Arena& arena_;
    int width_ = 0, height_ = 0;
    int block_ = 1;
    int capacity_ = 0;
    int first_ = 0, end_ = 0;
    std::array<std::vector<SlotPlane>, 2> planes_;
};

}  // namespace penumbra::diff
