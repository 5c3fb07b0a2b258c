#include "core/image/exr_blocks.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <algorithm>

#include "core/error.h"
#include "core/image/exr_structure.h"

namespace penumbra::image {
namespace {

// Attributes of these types lay out pixels or name parts; OpenEXR need not parse any other.
constexpr std::string_view kParsedTypes[] = {
    "chlist", "compression", "box2i", "lineOrder", "float", "v2f", "tiledesc", "string", "int"};

bool is_parsed(const ExrAttribute& attribute) {
    return std::find(std::begin(kParsedTypes), std::end(kParsedTypes), attribute.type) !=
           std::end(kParsedTypes);
}

// The file's bytes for OpenEXR, read where they are needed. All other attributes get a type that
// OpenEXR does not know and takes as bytes: no preview, string list or manifest of a damaged file
// is ever interpreted.
class InputStream : public Imf::IStream {
  public:
    InputStream(const FileReader& file, const ExrStructure& structure)
        : IStream(file.path().c_str()), file_(file) {
        for (const ExrPart& part : structure.parts)
            for (const ExrAttribute& attribute : part.attributes)
                if (!is_parsed(attribute)) patches_.push_back(attribute.type_offset);
        std::sort(patches_.begin(), patches_.end());
    }

    bool read(char to[], int count) override {
        const auto size = static_cast<std::uint64_t>(std::max(count, 0));
        if (count < 0 || !file_.read_at(position_, {reinterpret_cast<std::uint8_t*>(to), size}))
            throw Iex::InputExc("the file ends too early");
        for (auto at = std::lower_bound(patches_.begin(), patches_.end(), position_);
             at != patches_.end() && *at < position_ + size; ++at)
            to[*at - position_] = '?';
        position_ += size;
        return position_ < file_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

  private:
    const FileReader& file_;
    std::vector<std::uint64_t> patches_;
    std::uint64_t position_ = 0;
};

ExrPartInfo to_info(const ExrPart& part) {
    ExrPartInfo info;
    if (const ExrAttribute* name = part.find("name"); name != nullptr && name->type == "string")
        info.name.assign(name->value.begin(), name->value.end());
    info.display = part.display;
    info.data = part.data;
    info.channels = part.channels;
    info.is_deep = part.is_deep;
    info.lines_per_block =
        part.is_tiled ? static_cast<int>(little_uint32(part.find("tiles")->value.data() + 4))
                      : lines_per_chunk(part.codec);
    return info;
}

// A slice that puts row `first` of the data window at the view's origin.
template <class T>
Imf::Slice slice(Imf::PixelType type, PlaneView<T> view, const Window& data, int first) {
    return Imf::Slice::Make(type, view.origin, {data.x0, data.y0 + first}, data.width(),
                            data.height() - first, sizeof(T),
                            static_cast<std::size_t>(view.stride) * sizeof(T));
}

}  // namespace

struct ExrBlocks::Implementation {
    explicit Implementation(const std::filesystem::path& path)
        : file(path), structure(read_exr_structure(file)) {
        for (const ExrPart& part : structure.parts) parts.push_back(to_info(part));
    }

    // OpenEXR meets the file only when pixels are asked for.
    Imf::InputPart& open(int part) {
        if (!input) {
            stream = std::make_unique<InputStream>(file, structure);
            input = std::make_unique<Imf::MultiPartInputFile>(*stream, 0, false);
            opened.resize(parts.size());
        }
        auto& entry = opened[static_cast<std::size_t>(part)];
        if (!entry) entry = std::make_unique<Imf::InputPart>(*input, part);
        return *entry;
    }

    void check(const ExrPartInfo& part) const {
        if (part.is_deep)
            throw InputError(file.path(),
                             "a deep EXR image, expected one with one value per pixel");
        for (const ExrChannelInfo& channel : part.channels)
            if (channel.x_sampling != 1 || channel.y_sampling != 1)
                throw InputError(file.path(),
                                 fmt::format("EXR channel '{}' is subsampled {} x {}, expected "
                                             "full resolution",
                                             channel.name, channel.x_sampling, channel.y_sampling));
    }

    FileReader file;
    ExrStructure structure;
    std::vector<ExrPartInfo> parts;
    std::unique_ptr<InputStream> stream;
    std::unique_ptr<Imf::MultiPartInputFile> input;
    std::vector<std::unique_ptr<Imf::InputPart>> opened;
};

ExrBlocks::ExrBlocks(const std::filesystem::path& file)
    : implementation_(std::make_unique<Implementation>(file)) {}
ExrBlocks::~ExrBlocks() = default;
ExrBlocks::ExrBlocks(ExrBlocks&&) noexcept = default;

const std::vector<ExrPartInfo>& ExrBlocks::parts() const {
    return implementation_->parts;
}

std::size_t ExrBlocks::missing_chunks() const {
    return implementation_->structure.missing_chunks;
}

void ExrBlocks::read(int part, int first, int end, std::span<const ExrRows> rows) {
    Implementation& i = *implementation_;
    const ExrPartInfo& info = i.parts[static_cast<std::size_t>(part)];
    i.check(info);
    try {
        Imf::FrameBuffer buffer;
        for (const ExrRows& row : rows)
            buffer.insert(row.channel, row.ids ? slice(Imf::UINT, row.ids, info.data, first)
                                               : slice(Imf::FLOAT, row.floats, info.data, first));
        Imf::InputPart& input = i.open(part);
        input.setFrameBuffer(buffer);
        input.readPixels(info.data.y0 + first, info.data.y0 + end - 1);
    } catch (const std::exception& error) {
        throw InputError(i.file.path(), fmt::format("the EXR file is damaged: {}", error.what()));
    }
}

}  // namespace penumbra::image
