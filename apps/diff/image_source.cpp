#include "apps/diff/image_source.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>

#include "core/error.h"
#include "core/image/decode.h"
#include "core/image/exr_blocks.h"
#include "core/image/file_reader.h"
#include "core/image/radiance.h"

namespace penumbra::diff {
namespace {

// PNG and JPEG: decoded whole.
class DecodedSource : public ImageSource {
  public:
    explicit DecodedSource(image::DecodedImage image) : image_(std::move(image)) {
        constexpr const char* kNames[4][4] = {
            {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
        constexpr const char* kTypes[] = {"uint8", "uint16", "float"};
        SourcePart part;
        part.display = part.data = {0, 0, image_.width, image_.height};
        for (int i = 0; i < image_.channels; ++i)
            part.channels.push_back(
                {kNames[image_.channels - 1][i], kTypes[static_cast<int>(image_.type)]});
        parts_.push_back(std::move(part));
        is_display_coded_ = image_.type != image::SampleType::kFloat;
    }
    int lines_per_block(int) const override { return 1; }
    void read(int, int first, int end, const std::vector<ChannelRows>& rows, int) override {
        for (const ChannelRows& row : rows)
            for (int y = first; y < end; ++y)
                for (int x = 0; x < image_.width; ++x)
                    row.floats.at(x, y - first) = image_.sample(x, y, row.channel);
    }

  private:
    image::DecodedImage image_;
};

// Radiance HDR: rows are decoded as they are asked for.
class RadianceSource : public ImageSource {
  public:
    explicit RadianceSource(const std::filesystem::path& file) : file_(file), rows_(file_) {
        SourcePart part;
        part.display = part.data = {0, 0, rows_.width(), rows_.height()};
        for (const char* name : {"R", "G", "B"}) part.channels.push_back({name, "float"});
        parts_.push_back(std::move(part));
    }
    int lines_per_block(int) const override { return 1; }
    void read(int, int first, int end, const std::vector<ChannelRows>& rows, int) override {
        rows_.read(first, end, [&](int y, std::span<const float> rgb) {
            for (const ChannelRows& row : rows) {
                auto from = static_cast<std::size_t>(row.channel);
                for (int x = 0; x < rows_.width(); ++x, from += 3)
                    row.floats.at(x, y - first) = rgb[from];
            }
        });
    }

  private:
    image::FileReader file_;
    image::RadianceRows rows_;
};

class ExrSource : public ImageSource {
  public:
    ExrSource(const std::filesystem::path& file, int workers) : file_(file) {
        readers_.resize(static_cast<std::size_t>(workers));
        readers_[0].emplace(file);
        for (const image::ExrPartInfo& from : readers_[0]->parts()) {
            SourcePart part{from.name, from.display, from.data, {}};
            for (const image::ExrChannelInfo& channel : from.channels)
                part.channels.push_back({channel.name, std::string(image::name(channel.type))});
            parts_.push_back(std::move(part));
        }
    }
    [[nodiscard]] const image::ExrBlocks& headers() const { return *readers_[0]; }
    int lines_per_block(int part) const override {
        return headers().parts()[static_cast<std::size_t>(part)].lines_per_block;
    }
    void read(int part, int first, int end, const std::vector<ChannelRows>& rows,
              int worker) override {
        auto& reader = readers_[static_cast<std::size_t>(worker)];
        if (!reader) reader.emplace(file_);
        std::vector<image::ExrRows> targets;
        for (const ChannelRows& row : rows)
            targets.push_back({parts_[static_cast<std::size_t>(part)]
                                   .channels[static_cast<std::size_t>(row.channel)]
                                   .name,
                               row.floats, row.ids});
        reader->read(part, first, end, targets);
    }

  private:
    std::filesystem::path file_;
    std::vector<std::optional<image::ExrBlocks>> readers_;
};

enum class Format { kUnknown, kExr, kRadiance, kOther };

// By the first bytes: a file that begins like an image but cannot be read is damaged, any other is
// no image.
Format detect(const std::filesystem::path& file) {
    std::array<char, 10> head{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), head.size());
    const std::string_view begin(head.data(), static_cast<std::size_t>(stream.gcount()));
    if (begin.starts_with("\x76\x2f\x31\x01")) return Format::kExr;
    if (image::is_radiance({reinterpret_cast<const std::uint8_t*>(begin.data()), begin.size()}))
        return Format::kRadiance;
    if (begin.starts_with("\x89PNG") || begin.starts_with("\xff\xd8\xff") ||
        begin.starts_with("#?"))
        return Format::kOther;
    return Format::kUnknown;
}

std::optional<Failure> unsupported(const image::ExrBlocks& file, const std::string& path) {
    for (const image::ExrPartInfo& part : file.parts()) {
        if (part.is_deep)
            return Failure{FailureKind::kUnsupported, "",
                           path + ": a deep EXR image, expected one value per pixel"};
        for (const image::ExrChannelInfo& channel : part.channels)
            if (channel.x_sampling != 1 || channel.y_sampling != 1)
                return Failure{FailureKind::kUnsupported, "",
                               fmt::format("{}: EXR channel '{}' is subsampled, expected full "
                                           "resolution",
                                           path, channel.name)};
    }
    return std::nullopt;
}

std::unique_ptr<ImageSource> open_exr(const std::filesystem::path& file, int workers,
                                      std::vector<Failure>& failures) {
    auto source = std::make_unique<ExrSource>(file, workers);
    if (const auto failure = unsupported(source->headers(), file.string())) {
        failures.push_back(*failure);
        return nullptr;
    }
    const std::size_t missing = source->headers().missing_chunks();
    if (missing == 0) return source;
    failures.push_back({FailureKind::kIncomplete, "",
                        fmt::format("{}: the EXR file is incomplete: {} of its blocks of pixels "
                                    "are missing",
                                    file.string(), missing)});
    return nullptr;
}

}  // namespace

bool begins_like_exr(const std::filesystem::path& file) {
    return detect(file) == Format::kExr;
}

std::unique_ptr<ImageSource> open_image(const std::filesystem::path& file, int workers,
                                        std::vector<Failure>& failures) {
    if (!std::filesystem::exists(file)) {
        failures.push_back({FailureKind::kMissing, "", file.string() + ": there is no such file"});
        return nullptr;
    }
    if (!std::filesystem::is_regular_file(file)) {
        failures.push_back({FailureKind::kNotAnImage, "", file.string() + ": is not a file"});
        return nullptr;
    }
    const Format format = detect(file);
    try {
        if (format == Format::kExr) return open_exr(file, workers, failures);
        if (format == Format::kRadiance) return std::make_unique<RadianceSource>(file);
        return std::make_unique<DecodedSource>(image::decode_image(file));
    } catch (const InputError& error) {
        const bool is_image = format != Format::kUnknown;
        failures.push_back(
            {is_image ? FailureKind::kDamaged : FailureKind::kNotAnImage, "", error.what()});
        return nullptr;
    }
}

}  // namespace penumbra::diff
