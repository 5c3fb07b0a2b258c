#include "core/scene/read_lights.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/scene/read_tracks.h"

namespace penumbra {
namespace {

constexpr json::Range kPosition{-1e9, 1e9};

void refuse_later_fields(const json::Node& node) {
    for (const char* field : {"texture", "ies", "portal", "intensity"})
        if (node.has(field)) node.fail(fmt::format("\"{}\" is not supported yet", field));
}

LightPolygon read_vertices(const json::Node& node) {
    if (node.size() < 3 || node.size() > kMaxLightVertices)
        node.fail(fmt::format("expected 3 to {} vertices, got {}", kMaxLightVertices, node.size()));
    LightPolygon polygon;
    polygon.vertex_count = static_cast<int>(node.size());
    for (std::size_t i = 0; i < node.size(); ++i) polygon.vertices[i] = node[i].vector(kPosition);
    return polygon;
}

std::vector<Vec3Track> vertex_tracks(const KeyedNode& node) {
    const auto whole = node.track<LightPolygon>("vertices", std::nullopt, read_vertices);
    const int count = whole.keys.front().value.vertex_count;
    std::vector<Vec3Track> tracks(static_cast<std::size_t>(count));
    for (const auto& [time, polygon] : whole.keys) {
        if (polygon.vertex_count != count)
            node.node().fail(fmt::format("vertices: {} of them at the first key, {} at {:g} s",
                                         count, polygon.vertex_count, time));
        for (std::size_t i = 0; i < tracks.size(); ++i)
            tracks[i].keys.push_back({time, polygon.vertices[i]});
    }
    return tracks;
}

LightShapeTrack read_rect(const KeyedNode& node) {
    return RectTrack{.center = node.vectors("center", kPosition, std::nullopt),
                     .half_axis_u = node.vectors("u", kPosition, std::nullopt),
                     .half_axis_v = node.vectors("v", kPosition, std::nullopt)};
}

LightShapeTrack read_polygon(const KeyedNode& node) {
    return PolygonTrack{.vertices = vertex_tracks(node)};
}

// A word of the scene file, the fields of its shape, all of which may have keys, and their reader.
struct Kind {
    const char* name;
    std::vector<std::string_view> fields;
    LightShapeTrack (*read)(const KeyedNode& node);
};
const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all{
        {"rect", {"center", "u", "v"}, read_rect},
        {"polygon", {"vertices"}, read_polygon},
    };
    return all;
}
constexpr const char* kNotYet[] = {"disk", "sphere", "ellipsoid", "box", "line",
                                   "mesh", "point",  "spot",      "sun"};

const Kind& kind_of(const json::Node& node) {
    const json::Node type = node.require("type");
    const std::string& name = type.text();
    std::string expected;
    for (const Kind& kind : kinds()) {
        if (kind.name == name) return kind;
        expected += fmt::format("{}\"{}\"", expected.empty() ? "" : " or ", kind.name);
    }
    if (std::find(std::begin(kNotYet), std::end(kNotYet), name) != std::end(kNotYet))
        type.fail(fmt::format("\"{}\" is not supported yet; expected {}", name, expected));
    std::vector<std::string> names;
    for (const Kind& kind : kinds()) names.emplace_back(kind.name);
    type.fail(fmt::format("expected {}, got {}{}", expected, type.shown(),
                          json::suggestion(name, names)));
}

void check_shape(const KeyedNode& node, const Light& light) {
    const auto check = [&](double time, const std::string& when) {
        if (const auto problem = shape_problem(light.shape, time))
            node.node().fail(when + *problem);
    };
    if (node.keys().empty()) check(0, "");
    for (const auto& key : node.keys()) check(key.time, fmt::format("at {:g} s ", key.time));
}

Light read_light(const json::Node& node) {
    const Kind& kind = kind_of(node);
    refuse_later_fields(node);
    std::vector<std::string_view> fields = kind.fields;
    fields.emplace_back("radiance");
    const KeyedNode keyed(node, fields, {"name", "type", "two_sided", "visible"});
    Light light;
    if (const auto name = node.find("name")) light.name = name->text();
    if (const auto flag = node.find("two_sided")) light.two_sided = flag->boolean();
    if (const auto flag = node.find("visible")) light.visible = flag->boolean();
    light.emission.radiance = keyed.vectors("radiance", json::kNonNegative, std::nullopt);
    light.shape = kind.read(keyed);
    check_shape(keyed, light);
    return light;
}

}  // namespace

std::vector<Light> read_lights(const json::Node& document) {
    std::vector<Light> lights;
    const auto list = document.find("lights");
    if (!list) return lights;
    std::set<std::string> names;
    for (std::size_t i = 0; i < list->size(); ++i) {
        const json::Node node = (*list)[i];
        Light light = read_light(node);
        const auto name = node.find("name");
        if (name && !names.insert(light.name).second)
            name->fail(fmt::format("{} is the name of another light too", name->shown()));
        if (!name) light.name = fmt::format("light {}", i + 1);
        lights.push_back(std::move(light));
    }
    return lights;
}

}  // namespace penumbra
