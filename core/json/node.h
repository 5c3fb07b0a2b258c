#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "core/json/value.h"
#include "core/math/vec.h"

// Checked access to a JSON tree: what is not as it should be becomes an InputError with the file
// and the place, "shot.json: lights[2].radiance: expected 3 numbers, got \"white\"".

namespace penumbra::json {

// Inclusive; what a float holds without trouble in products.
struct Range {
    double low = -1e12;
    double high = 1e12;
};
inline constexpr Range kUnit{0, 1};
inline constexpr Range kNonNegative{0, 1e12};

class Node {
  public:
    Node(const std::filesystem::path& file, const Value& value, std::string place)
        : file_(&file), value_(&value), place_(std::move(place)) {}

    [[nodiscard]] const std::string& place() const { return place_; }
    [[nodiscard]] const std::filesystem::path& file() const { return *file_; }

    // ---- objects
    // Demands an object with none but these keys; suggests the nearest for another.
    void allow(std::initializer_list<std::string_view> keys) const;
    [[noreturn]] void unknown_key(std::string_view key,
                                  const std::vector<std::string>& known) const;
    [[nodiscard]] bool has(std::string_view key) const { return find(key).has_value(); }
    [[nodiscard]] std::optional<Node> find(std::string_view key) const;
    [[nodiscard]] Node require(std::string_view key) const;
    [[nodiscard]] std::size_t member_count() const;
    [[nodiscard]] std::pair<std::string, Node> member(std::size_t index) const;

    // ---- arrays
    [[nodiscard]] std::size_t size() const;  // demands an array
    [[nodiscard]] Node operator[](std::size_t index) const;

    // ---- values
    [[nodiscard]] bool is_null() const { return value_->kind == Value::Kind::kNull; }
    [[nodiscard]] bool is_number() const { return value_->kind == Value::Kind::kNumber; }
    [[nodiscard]] bool is_list() const { return value_->kind == Value::Kind::kArray; }
    [[nodiscard]] double number(Range range = {}) const;
    [[nodiscard]] int integer(int low, int high) const;
    [[nodiscard]] bool boolean() const;
    [[nodiscard]] const std::string& text() const;
    [[nodiscard]] Vec3f vector(Range range = {}) const;

    // The value as a message shows it.
    [[nodiscard]] std::string shown() const { return describe(*value_); }

    [[noreturn]] void fail(std::string_view message) const;
    // "expected <what>, got <the value>"
    [[noreturn]] void expected(std::string_view what) const;

  private:
    [[nodiscard]] Node child(const std::string& suffix, const Value& value) const;

    const std::filesystem::path* file_;
    const Value* value_;
    std::string place_;
};

// "; did you mean \"radiance\"?", or nothing if no candidate is near.
[[nodiscard]] std::string suggestion(std::string_view word,
                                     const std::vector<std::string>& candidates);

}  // namespace penumbra::json
