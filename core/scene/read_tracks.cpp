#include "core/scene/read_tracks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/math/portable.h"

namespace penumbra {
namespace {

void allow(const json::Node& node, std::vector<std::string_view> keys) {
    for (std::size_t i = 0; i < node.member_count(); ++i) {
        const std::string name = node.member(i).first;
        if (std::find(keys.begin(), keys.end(), name) == keys.end())
            node.unknown_key(name, {keys.begin(), keys.end()});
    }
}

// Euler angles and the rotation they stand for: only the former know which way round was meant.
struct Rotation {
    Vec3f degrees;
    glm::dquat quaternion;
};

double widest_turn(const Rotation& a, const Rotation& b) {
    const Vec3f d = b.degrees - a.degrees;
    const double between =
        portable::acos(std::min(1.0, std::fabs(glm::dot(a.quaternion, b.quaternion)))) * 360 /
        std::numbers::pi;
    return std::max(
        {double{std::fabs(d.x)}, double{std::fabs(d.y)}, double{std::fabs(d.z)}, between});
}

RotationTrack read_rotation(const KeyedNode& node) {
    const auto read = [](const json::Node& value) {
        const Vec3f degrees = value.vector({-1e6, 1e6});
        return Rotation{degrees, rotation_from_degrees({degrees.x, degrees.y, degrees.z})};
    };
    const std::optional<Rotation> none = Rotation{{0, 0, 0}, rotation_from_degrees({0, 0, 0})};
    const Track<Rotation> turns = node.track<Rotation>("rotate", none, read);
    RotationTrack track;
    for (std::size_t i = 0; i < turns.keys.size(); ++i) {
        const auto& [time, rotation] = turns.keys[i];
        // Just below 180 the direction of the turn is a matter of rounding.
        if (i > 0 && widest_turn(turns.keys[i - 1].value, rotation) >= 180 - 1e-6)
            node.node().fail(
                fmt::format("the rotations at {:g} s and {:g} s are 180 degrees or more "
                            "apart: insert a key between them",
                            turns.keys[i - 1].time, time));
        track.keys.push_back({time, rotation.quaternion});
    }
    return track;
}

// A number, or one per axis; none 0, and no sign changes on the way: the model would be flat then.
Vec3Track read_scale(const KeyedNode& node) {
    const auto read = [](const json::Node& value) {
        const json::Range range{-1e6, 1e6};
        if (!value.is_number()) return value.vector(range);
        const auto s = static_cast<float>(value.number(range));
        return Vec3f{s, s, s};
    };
    Vec3Track track = node.track<Vec3f>("scale", Vec3f{1, 1, 1}, read);
    const Vec3f& first = track.keys.front().value;
    for (const auto& [time, s] : track.keys) {
        if (!(std::fabs(s.x) >= 1e-6f && std::fabs(s.y) >= 1e-6f && std::fabs(s.z) >= 1e-6f))
            node.node().fail("scale: expected numbers of at least 1e-06 or at most -1e-06");
        if (s.x * first.x < 0 || s.y * first.y < 0 || s.z * first.z < 0)
            node.node().fail(fmt::format("scale: changes its sign before {:g} s", time));
    }
    return track;
}

}  // namespace

KeyedNode::KeyedNode(const json::Node& node, const std::vector<std::string_view>& fields,
                     std::initializer_list<std::string_view> others)
    : node_(node) {
    std::vector<std::string_view> known(fields);
    known.insert(known.end(), others);
    known.push_back("keys");
    allow(node, known);
    const auto list = node.find("keys");
    if (!list) return;
    std::vector<std::string_view> in_key(fields);
    in_key.push_back("time");
    if (list->size() == 0) list->fail("expected at least one key");
    for (std::size_t i = 0; i < list->size(); ++i) {
        const json::Node key = (*list)[i];
        allow(key, in_key);
        const json::Node time = key.require("time");
        const double seconds = time.number({-1e6, 1e6});
        if (i > 0 && !(seconds > keys_.back().time))
            time.fail(
                fmt::format("expected a time after {:g}, got {:g}", keys_.back().time, seconds));
        keys_.push_back({seconds, key});
    }
}

Vec3Track KeyedNode::vectors(std::string_view field, json::Range range,
                             std::optional<Vec3f> fallback) const {
    return track<Vec3f>(field, fallback, [&](const json::Node& n) { return n.vector(range); });
}

FloatTrack KeyedNode::numbers(std::string_view field, json::Range range,
                              std::optional<float> fallback) const {
    return track<float>(field, fallback,
                        [&](const json::Node& n) { return static_cast<float>(n.number(range)); });
}

TransformTrack read_transform(const KeyedNode& node) {
    return {.translate = node.vectors("translate", {-1e9, 1e9}, Vec3f{0, 0, 0}),
            .scale = read_scale(node),
            .rotate = read_rotation(node)};
}

}  // namespace penumbra
