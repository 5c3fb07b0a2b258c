#include "core/scene/read_obj.h"

#include <tiny_obj_loader.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "core/error.h"
#include "core/scene/obj_lines.h"
#include "core/scene/triangulate.h"
#include "core/text_scan.h"

namespace penumbra {
namespace {

using Index = std::uint32_t;

// Squares of larger coordinates leave the range of float.
constexpr float kLargestNumber = 1e15f;

struct Corner {
    Index position, uv, normal;
};

// Takes tinyobjloader's events. Exceptions pass through it: its parser holds nothing but
// containers.
class ObjBuilder {
  public:
    ObjBuilder(ObjFile& result, const ObjLines& lines) : result_(result), lines_(lines) {}

    void add_position(float x, float y, float z) {
        check_number(x);
        check_number(y);
        check_number(z);
        soup().positions.push_back({x, y, z});
        check_count(soup().positions.size());
    }
    void add_normal(float x, float y, float z) {
        check_number(x);
        check_number(y);
        check_number(z);
        soup().normals.push_back({x, y, z});
        check_count(soup().normals.size());
    }
    void add_uv(float u, float v) {
        check_number(u);
        check_number(v);
        soup().uvs.push_back({u, v});
        check_count(soup().uvs.size());
    }
    void use_material(std::string_view name) { slot_ = slot_of(std::string(trimmed(name))); }

    void add_face(const tinyobj::index_t* indices, int count) {
        polygon_.clear();
        for (int i = 0; i < count; ++i) polygon_.push_back(checked(indices[i]));
        if (polygon_.size() > kMaxFaceCorners)
            lines_.fail(fmt::format("a face of {} vertices, expected at most {}", polygon_.size(),
                                    kMaxFaceCorners));
        if (polygon_.size() < 3) {
            ++soup().dropped_triangles;
        } else if (polygon_.size() == 3) {
            add_triangle(0, 1, 2);
        } else {
            corners_.clear();
            for (const Corner& c : polygon_) corners_.push_back(soup().positions[c.position]);
            for (const auto& [a, b, c] : triangulate(corners_)) add_triangle(a, b, c);
        }
    }

  private:
    PolygonSoup& soup() { return result_.soup; }

    void check_number(float x) const {
        if (!(std::fabs(x) <= kLargestNumber))
            lines_.fail(fmt::format("the number {:g} is beyond {:g}", x, kLargestNumber));
    }
    void check_count(std::size_t count) const {
        if (count > std::size_t{std::numeric_limits<std::int32_t>::max()})
            lines_.fail("more than 2147483647 vertices");
    }

    std::uint16_t slot_of(const std::string& name) {
        const auto [found, is_new] = slots_.try_emplace(name, result_.slots.size());
        if (is_new) {
            if (result_.slots.size() > std::numeric_limits<std::uint16_t>::max())
                lines_.fail("more than 65536 materials");
            result_.slots.push_back(name);
        }
        return static_cast<std::uint16_t>(found->second);
    }

    Index resolve(int index, std::size_t defined, const char* what) const {
        const auto count = static_cast<std::int64_t>(defined);
        const std::int64_t at = index > 0 ? index - 1 : count + index;
        if (at < 0 || at >= count)
            lines_.fail(fmt::format("face uses {} {}, but only {} {} defined", what, index, count,
                                    count == 1 ? "is" : "are"));
        return static_cast<Index>(at);
    }
    // tinyobjloader hands over 0 for what is left out; a written 0 does not pass ObjLines.
    Corner checked(const tinyobj::index_t& raw) const {
        const PolygonSoup& s = result_.soup;
        Corner corner{resolve(raw.vertex_index, s.positions.size(), "vertex"), kNoIndex, kNoIndex};
        if (raw.texcoord_index != 0)
            corner.uv = resolve(raw.texcoord_index, s.uvs.size(), "texture coordinate");
        if (raw.normal_index != 0)
            corner.normal = resolve(raw.normal_index, s.normals.size(), "normal");
        return corner;
    }

    void add_triangle(Index a, Index b, Index c) {
        const std::array<Corner, 3> corners{polygon_[a], polygon_[b], polygon_[c]};
        const auto position = [&](int i) {
            return soup().positions[corners[static_cast<std::size_t>(i)].position];
        };
        if (!has_area(position(0), position(1), position(2))) {
            ++soup().dropped_triangles;
            return;
        }
        if (slot_ < 0) slot_ = slot_of("");
        for (const Corner& corner : corners) {
            append(soup().corner_uvs, corner.uv);
            append(soup().corner_normals, corner.normal);
            soup().corner_positions.push_back(corner.position);
        }
        if (soup().corner_positions.size() > std::numeric_limits<std::int32_t>::max())
            lines_.fail("more than 715827882 triangles");
        soup().triangle_slots.push_back(static_cast<std::uint16_t>(slot_));
    }
    // Lists of what no corner has stay empty.
    void append(std::vector<Index>& list, Index index) {
        if (index == kNoIndex && list.empty()) return;
        list.resize(soup().corner_positions.size(), kNoIndex);
        list.push_back(index);
    }

    ObjFile& result_;
    const ObjLines& lines_;
    std::map<std::string, std::size_t> slots_;
    int slot_ = -1;  // until a face needs one or usemtl names one
    std::vector<Corner> polygon_;
    std::vector<Vec3f> corners_;
};

tinyobj::callback_t callbacks() {
    tinyobj::callback_t calls;
    calls.vertex_cb = [](void* user, float x, float y, float z, float) {
        static_cast<ObjBuilder*>(user)->add_position(x, y, z);
    };
    calls.normal_cb = [](void* user, float x, float y, float z) {
        static_cast<ObjBuilder*>(user)->add_normal(x, y, z);
    };
    calls.texcoord_cb = [](void* user, float u, float v, float) {
        static_cast<ObjBuilder*>(user)->add_uv(u, v);
    };
    calls.index_cb = [](void* user, tinyobj::index_t* indices, int count) {
        static_cast<ObjBuilder*>(user)->add_face(indices, count);
    };
    calls.usemtl_cb = [](void* user, const char* name, int) {
        static_cast<ObjBuilder*>(user)->use_material(name);
    };
    return calls;
}

std::unique_ptr<std::istream> open(const std::filesystem::path& file, InputFiles& files) {
    if (files.is_virtual()) return std::make_unique<std::istringstream>(files.read(file));
    files.note(file);
    require_regular_file(file);
    auto stream = std::make_unique<std::ifstream>(file, std::ios::binary);
    if (!*stream) throw InputError(file, "cannot be opened for reading");
    return stream;
}

}  // namespace

ObjFile read_obj(const std::filesystem::path& file, InputFiles& files) {
    ObjFile result;
    result.soup.name = file.filename().string();
    const auto raw = open(file, files);
    ObjLines lines(file, *raw);
    std::istream stream(&lines);
    stream.exceptions(std::ios::badbit);  // errors of the filter pass through the parser
    ObjBuilder builder(result, lines);
    std::string ignored_warnings;  // about material names, which are looked up elsewhere
    std::string error;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks(), &builder, nullptr, &ignored_warnings,
                                      &error))
        throw InputError(file, error.empty() ? "cannot be read" : printable(error));
    if (result.soup.triangle_count() == 0)
        throw InputError(file, result.soup.dropped_triangles > 0 ? "all its faces are degenerate"
                                                                 : "holds no faces");
    result.libraries = lines.libraries();
    return result;
}

}  // namespace penumbra
