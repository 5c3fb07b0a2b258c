#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// A JSON document as a tree, strictly read: duplicate keys, numbers beyond double and anything
// after the document are errors.

namespace penumbra::json {

struct Value {
    enum class Kind { kNull, kBoolean, kNumber, kText, kArray, kObject };
    Kind kind = Kind::kNull;
    bool boolean = false;
    double number = 0;
    std::string text{};
    std::vector<Value> items{};                            // of an array
    std::vector<std::pair<std::string, Value>> members{};  // of an object, in the file's order
};

// Deeper nesting and longer documents than any scene needs are refused.
inline constexpr std::size_t kMaxDepth = 32;
inline constexpr std::size_t kMaxDocumentBytes = std::size_t{64} << 20;

// Throws InputError with line and column where the text is no JSON, with the place where it has
// duplicate keys.
[[nodiscard]] Value parse(const std::filesystem::path& file, std::string_view text);

// As it would stand in the file, cut to what fits an error message.
[[nodiscard]] std::string describe(const Value& value);

}  // namespace penumbra::json
