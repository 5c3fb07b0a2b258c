#pragma once

#include "core/error.h"
#include "core/json/node.h"
#include "core/scene/track.h"

// Animation tracks out of JSON objects with fields and a list `keys` of the same fields: each field
// is a track of its own; its static value stands at the first key's time where that key omits it.

namespace penumbra {

// An object with its keys, times checked.
class KeyedNode {
  public:
    // Fields may stand in the object and in its keys; both may hold nothing but these and, in the
    // object, `others`.
    KeyedNode(const json::Node& node, const std::vector<std::string_view>& fields,
              std::initializer_list<std::string_view> others);

    [[nodiscard]] const json::Node& node() const { return node_; }

    // The track of a field; `fallback` where neither the object nor its first key has it. Without a
    // fallback such a field is missing.
    [[nodiscard]] Vec3Track vectors(std::string_view field, json::Range range,
                                    std::optional<Vec3f> fallback) const;
    [[nodiscard]] FloatTrack numbers(std::string_view field, json::Range range,
                                     std::optional<float> fallback) const;

    // A track of values that `read` makes of a field's node.
    template <class T, class Read>
    [[nodiscard]] Track<T> track(std::string_view field, std::optional<T> fallback,
                                 const Read& read) const;

    struct Key {
        double time;
        json::Node node;
    };
    [[nodiscard]] const std::vector<Key>& keys() const { return keys_; }

  private:
    json::Node node_;
    std::vector<Key> keys_;
};

// translate, rotate and scale of a model.
[[nodiscard]] TransformTrack read_transform(const KeyedNode& node);

template <class T, class Read>
Track<T> KeyedNode::track(std::string_view field, std::optional<T> fallback,
                          const Read& read) const {
    std::optional<T> fixed = fallback;
    if (const auto found = node_.find(field)) fixed = read(*found);
    Track<T> track;
    for (const Key& key : keys_) {
        const auto found = key.node.find(field);
        if (found) {
            track.keys.push_back({key.time, read(*found)});
        } else if (&key == &keys_.front() && fixed) {
            track.keys.push_back({key.time, *fixed});
        }
    }
    const bool is_complete =
        !keys_.empty() && !track.keys.empty() && track.keys.front().time == keys_.front().time;
    if (!is_complete && !fixed) node_.fail(fmt::format("\"{}\" is missing", field));
    // Keys that say nothing of the field but at the first time: it does not move.
    if (track.keys.empty()) track.keys.push_back({0, *fixed});
    return track;
}

}  // namespace penumbra
