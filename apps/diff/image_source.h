#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/diff/report.h"
#include "core/image/exr.h"
#include "core/image/plane.h"

namespace penumbra::diff {

struct SourceChannel {
    std::string name;  // "R", "albedo.R"
    std::string type;  // uint8, uint16, uint, half, float
    [[nodiscard]] bool holds_ids() const { return type == "uint"; }
};

struct SourcePart {
    std::string name;  // "" in files of one part
    image::Window display, data;
    std::vector<SourceChannel> channels;
};

// Rows of one channel: ids of type uint, all others as floats; the type says which view is used.
struct ChannelRows {
    int channel = 0;  // of the part
    PlaneView<float> floats{};
    PlaneView<std::uint32_t> ids{};
};

// An image file of any format whose rows can be read in any order. PNG and JPEG hold display-coded
// values, of which the integers' maximum is 1; EXR and HDR hold scene-linear ones.
class ImageSource {
  public:
    virtual ~ImageSource() = default;
    [[nodiscard]] const std::vector<SourcePart>& parts() const { return parts_; }
    [[nodiscard]] bool is_display_coded() const { return is_display_coded_; }
    // Rows that are read at once without waste.
    [[nodiscard]] virtual int lines_per_block(int part) const = 0;

    // Rows [first, end) of the data window, counted from its top. Calls of different workers may
    // run at once.
    virtual void read(int part, int first, int end, const std::vector<ChannelRows>& rows,
                      int worker) = 0;

  protected:
    std::vector<SourcePart> parts_;
    bool is_display_coded_ = false;
};

// By the first bytes; false where there is no such file.
[[nodiscard]] bool begins_like_exr(const std::filesystem::path& file);

// Opens a file for as many workers; nullptr, with one more failure, where that is not possible.
[[nodiscard]] std::unique_ptr<ImageSource> open_image(const std::filesystem::path& file,
                                                      int workers, std::vector<Failure>& failures);

}  // namespace penumbra::diff
