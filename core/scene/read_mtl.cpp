#include "core/scene/read_mtl.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "core/bsdf/ggx.h"
#include "core/error.h"
#include "core/text_scan.h"

namespace penumbra {
namespace {

constexpr float kLargestRadiance = 1e12f;
constexpr std::size_t kLargestLibrary = std::size_t{256} << 20;

// Which statements of a material exist and where: tinyobjloader gives missing ones values like any.
using Statements = std::map<std::string, std::size_t, std::less<>>;  // keyword -> line

struct ScannedMtl {
    std::string text;                   // with comments behind numbers and carriage returns removed
    std::vector<Statements> materials;  // in order
    std::set<std::string> ignored_options;
};

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}
bool is_color(std::string_view keyword) {
    return is_one_of(keyword, {"Kd", "Ke"});
}
bool is_scalar(std::string_view keyword) {
    return is_one_of(keyword, {"Ns", "Ni", "d", "Tr", "Pr", "Pm"});
}
bool is_map(std::string_view keyword) {
    return is_one_of(
        keyword, {"map_Kd", "map_Pr", "map_Pm", "map_d", "map_Bump", "map_bump", "bump", "norm"});
}

// Of texture maps: how many values follow at most, and what ignoring it means.
struct Option {
    std::string_view name;
    int values;
    bool is_numeric, is_kept, changes_picture;
};
constexpr std::array kOptions{
    Option{"-bm", 1, true, true, false},       Option{"-imfchan", 1, false, true, false},
    Option{"-s", 3, true, false, true},        Option{"-o", 3, true, false, true},
    Option{"-t", 3, true, false, true},        Option{"-mm", 2, true, false, true},
    Option{"-clamp", 1, false, false, false},  Option{"-blendu", 1, false, false, false},
    Option{"-blendv", 1, false, false, false}, Option{"-cc", 1, false, false, false},
    Option{"-boost", 1, true, false, false},   Option{"-texres", 1, true, false, false},
    Option{"-type", 1, false, false, false},   Option{"-colorspace", 1, false, false, false}};

class Scanner {
  public:
    explicit Scanner(const std::filesystem::path& file) : file_(file) {}

    ScannedMtl scan(const std::string& content) {
        std::istringstream stream(content);
        for (std::string line; std::getline(stream, line);) {
            ++line_number_;
            if (line.find('\0') != line.npos) fail("holds a zero byte: not a text file");
            scan_line(trimmed(line));
        }
        return std::move(result_);
    }

  private:
    [[noreturn]] void fail(std::string_view message) const {
        throw InputError(file_, fmt::format("line {}", line_number_), message);
    }

    void scan_line(std::string_view rest) {
        const std::string_view keyword = take_word(rest);
        if (keyword == "newmtl") {
            if (rest.empty()) fail("newmtl without a name");
            result_.materials.emplace_back();
        } else if (is_color(keyword) || is_scalar(keyword)) {
            rest = trimmed(rest.substr(0, rest.find('#')));
            rest = check_numbers(keyword, rest);
        } else if (is_map(keyword)) {
            if (rest.empty()) fail(fmt::format("{} without a file name", keyword));
            map_text_ = without_options(rest);
            rest = map_text_;
        } else {
            return;
        }
        if (result_.materials.empty()) fail(fmt::format("{} before the first newmtl", keyword));
        result_.materials.back().insert_or_assign(std::string(keyword), line_number_);
        result_.text.append(keyword).append(" ");
        if (is_color(keyword))
            result_.text.append(color_text_);
        else
            result_.text.append(rest);
        result_.text += '\n';
    }

    // One number of a colour stands for all three.
    std::string_view check_numbers(std::string_view keyword, std::string_view words) {
        const std::string_view all = words;
        int count = 0;
        while (!words.empty()) {
            const std::string_view word = take_word(words);
            if (!is_number(word))
                fail(fmt::format("{}: expected a number, got \"{}\"", keyword, printable(word)));
            ++count;
        }
        if (is_color(keyword) ? count != 1 && count != 3 : count != 1)
            fail(fmt::format("{}: expected {}, got {} numbers", keyword,
                             is_color(keyword) ? "3 numbers" : "1 number", count));
        color_text_ = count == 1 ? fmt::format("{0} {0} {0}", all) : std::string(all);
        return all;
    }

    // The statement with those options alone that are understood. The parser would take a file's
    // name for the third number of "-s 2 2 wood.png".
    std::string without_options(std::string_view words) {
        std::string kept;
        while (words.starts_with("-")) {
            std::string_view rest = words;
            const std::string_view option = take_word(rest);
            const auto known = std::find_if(kOptions.begin(), kOptions.end(),
                                            [&](const Option& o) { return o.name == option; });
            if (known == kOptions.end()) break;  // a file name
            if (known->changes_picture) result_.ignored_options.emplace(option);
            words = rest;
            for (int i = 0; i < known->values; ++i) {
                std::string_view after = words;
                const std::string_view value = take_word(after);
                if (known->is_numeric && !is_number(value)) break;
                words = after;
                if (known->is_kept) kept += fmt::format("{} {} ", option, value);
            }
        }
        if (words.empty()) fail("a map without a file name");
        return kept.append(words);
    }

    const std::filesystem::path& file_;
    std::size_t line_number_ = 0;
    std::string color_text_, map_text_;
    ScannedMtl result_;
};

// Turns tinyobjloader's material and what was scanned into ours.
class Converter {
  public:
    Converter(const std::filesystem::path& file, const InputFiles& files)
        : file_(file), files_(files) {}

    MtlMaterial convert(const tinyobj::material_t& raw, const Statements& given) {
        given_ = &given;
        MtlMaterial material;
        material.values.name = raw.name;
        set_values(raw, material.values);
        set_maps(raw, material.maps);
        return material;
    }

  private:
    bool has(std::string_view keyword) const { return given_->contains(keyword); }

    std::string message(std::string_view keyword, std::string_view text) const {
        return fmt::format("{}: line {}: {}: {}", file_.string(), given_->find(keyword)->second,
                           keyword, text);
    }
    float in_range(std::string_view keyword, float x, float low, float high) const {
        if (!(x >= low && x <= high))
            throw InputError(message(
                keyword,
                fmt::format("expected a number between {:g} and {:g}, got {:g}", low, high, x)));
        return x;
    }
    // Exporters write 1.0000001; the colour of a surface ends at 1 all the same.
    Vec3f color(std::string_view keyword, const float (&rgb)[3], float high) const {
        const auto channel = [&](float x) {
            return std::min(in_range(keyword, x, 0, kLargestRadiance), high);
        };
        return {channel(rgb[0]), channel(rgb[1]), channel(rgb[2])};
    }

    float roughness(const tinyobj::material_t& raw) const {
        if (has("Pr")) return in_range("Pr", raw.roughness, 0, 1);
        if (has("map_Pr")) return 1;  // the map alone says
        if (!has("Ns")) return Material{}.roughness;
        const float exponent = in_range("Ns", raw.shininess, 0, 1e9f);
        return std::sqrt(std::sqrt(2 / (exponent + 2)));  // alpha = roughness^2
    }

    void set_values(const tinyobj::material_t& raw, Material& material) const {
        if (has("Kd"))
            material.base_color = color("Kd", raw.diffuse, 1);
        else if (has("map_Kd"))
            material.base_color = {1, 1, 1};
        if (has("Ke")) material.emission = color("Ke", raw.emission, kLargestRadiance);
        material.roughness = std::clamp(roughness(raw), kMinimumRoughness, 1.0f);
        if (has("Pm"))
            material.metallic = in_range("Pm", raw.metallic, 0, 1);
        else if (has("map_Pm"))
            material.metallic = 1;
        if (has("Ni") && in_range("Ni", raw.ior, 0, 1e6f) > 1) material.ior = raw.ior;
    }

    MapRequest request(std::string_view keyword, const std::string& name, TextureKind kind,
                       const tinyobj::texture_option_t& options) const {
        MapRequest map;
        map.request.kind = kind;
        if (const auto found = files_.find(file_.parent_path(), name))
            map.file = *found;
        else
            map.problem = message(keyword, fmt::format("no such file: \"{}\"", printable(name)));
        if (options.imfchan == 'r') map.request.channel = 0;
        if (options.imfchan == 'g') map.request.channel = 1;
        if (options.imfchan == 'b') map.request.channel = 2;
        return map;
    }

    void set_maps(const tinyobj::material_t& raw, MaterialMaps& maps) const {
        if (has("map_Kd")) {
            maps.base_color =
                request("map_Kd", raw.diffuse_texname, TextureKind::kColor, raw.diffuse_texopt);
            maps.base_color->request.channel.reset();
        }
        if (has("map_Pr"))
            maps.roughness =
                request("map_Pr", raw.roughness_texname, TextureKind::kData, raw.roughness_texopt);
        if (has("map_Pm"))
            maps.metallic =
                request("map_Pm", raw.metallic_texname, TextureKind::kData, raw.metallic_texopt);
        if (has("map_d"))
            maps.opacity =
                request("map_d", raw.alpha_texname, TextureKind::kOpacity, raw.alpha_texopt);
        set_normal_map(raw, maps);
    }

    // `norm` is a normal map; a bump map is one too, or a height map: its content decides.
    void set_normal_map(const tinyobj::material_t& raw, MaterialMaps& maps) const {
        for (const std::string_view bump : {"bump", "map_bump", "map_Bump"}) {
            if (!has(bump)) continue;
            maps.normal = request(bump, raw.bump_texname, TextureKind::kNormal, raw.bump_texopt);
            maps.normal->height_if_grey = true;
            maps.normal->request.relief =
                kDefaultRelief * in_range(bump, raw.bump_texopt.bump_multiplier, -1e6f, 1e6f);
        }
        if (!has("norm")) return;
        maps.normal = request("norm", raw.normal_texname, TextureKind::kNormal, raw.normal_texopt);
        maps.normal->request.channel.reset();
    }

    const std::filesystem::path& file_;
    const InputFiles& files_;
    const Statements* given_ = nullptr;
};

void warn_of_glass(const std::filesystem::path& file, const std::vector<std::string>& names,
                   std::vector<std::string>& warnings) {
    if (names.empty()) return;
    warnings.push_back(fmt::format("{}: {} transparent material{} ({}{}) drawn opaque",
                                   file.string(), names.size(), names.size() == 1 ? "" : "s",
                                   names[0], names.size() == 1 ? "" : ", ..."));
}

}  // namespace

std::vector<MtlMaterial> read_mtl(const std::filesystem::path& file, InputFiles& files,
                                  std::vector<std::string>& warnings) {
    const ScannedMtl scanned = Scanner(file).scan(files.read(file, kLargestLibrary));
    if (scanned.materials.empty()) return {};
    std::map<std::string, int> ignored_index;
    std::vector<tinyobj::material_t> raw;
    std::string ignored_warning;
    std::string error;
    std::istringstream stream(scanned.text);
    tinyobj::LoadMtl(&ignored_index, &raw, &stream, &ignored_warning, &error);
    if (!error.empty() || raw.size() != scanned.materials.size())
        throw InputError(file, error.empty() ? "cannot be read" : printable(error));

    std::vector<MtlMaterial> materials;
    std::vector<std::string> transparent;
    Converter converter(file, files);
    for (std::size_t i = 0; i < raw.size(); ++i) {
        materials.push_back(converter.convert(raw[i], scanned.materials[i]));
        if (raw[i].dissolve < 1 && !scanned.materials[i].contains("map_d"))
            transparent.push_back(raw[i].name);
    }
    warn_of_glass(file, transparent, warnings);
    for (const std::string& option : scanned.ignored_options)
        warnings.push_back(
            fmt::format("{}: the texture option {} is ignored", file.string(), option));
    return materials;
}

}  // namespace penumbra
