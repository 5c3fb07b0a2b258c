#include "core/json/value.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "core/error.h"
#include "core/text_scan.h"

namespace penumbra::json {
namespace {

using Library = nlohmann::json;

std::string line_and_column(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const auto start = before.rfind('\n');
    const std::size_t column = before.size() - (start == before.npos ? 0 : start + 1);
    return fmt::format("line {}, column {}", line, std::max<std::size_t>(column, 1));
}

// The library's message without its own idea of the place.
std::string reason_of(std::string_view message) {
    for (const std::string_view before : {"syntax error while ", ": "}) {
        const auto at = message.find(before);
        if (at == message.npos) continue;
        if (before == ": ")
            message.remove_prefix(at + before.size());
        else
            message.remove_prefix(at);
        break;
    }
    const auto bracket = message.starts_with("[") ? message.find("] ") : message.npos;
    if (bracket != message.npos) message.remove_prefix(bracket + 2);
    return std::string(message);
}

// Builds the tree from the library's events.
class TreeBuilder : public nlohmann::json_sax<Library> {
  public:
    TreeBuilder(const std::filesystem::path& file, std::string_view text)
        : file_(file), text_(text) {}

    Value take() { return std::move(root_); }

    bool null() override { return add({}); }
    bool boolean(bool value) override {
        return add({.kind = Value::Kind::kBoolean, .boolean = value});
    }
    bool number_integer(number_integer_t value) override {
        return add_number(static_cast<double>(value));
    }
    bool number_unsigned(number_unsigned_t value) override {
        return add_number(static_cast<double>(value));
    }
    bool number_float(number_float_t value, const string_t&) override { return add_number(value); }
    bool string(string_t& value) override {
        return add({.kind = Value::Kind::kText, .text = std::move(value)});
    }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open({.kind = Value::Kind::kObject}); }
    bool start_array(std::size_t) override { return open({.kind = Value::Kind::kArray}); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        if (!levels_.back().keys.insert(name).second)
            throw InputError(file_, place(),
                             fmt::format("the key \"{}\" stands twice", printable(name)));
        levels_.back().value.members.emplace_back(std::move(name), Value{});
        return true;
    }
    bool parse_error(std::size_t position, const std::string&,
                     const Library::exception& error) override {
        throw InputError(file_, line_and_column(text_, position), reason_of(error.what()));
    }

  private:
    struct Level {
        Value value;
        std::unordered_set<std::string> keys;
    };

    bool add_number(double value) { return add({.kind = Value::Kind::kNumber, .number = value}); }

    bool add(Value value) {
        if (levels_.empty()) {
            root_ = std::move(value);
        } else if (Value& parent = levels_.back().value; parent.kind == Value::Kind::kArray) {
            parent.items.push_back(std::move(value));
        } else {
            parent.members.back().second = std::move(value);
        }
        return true;
    }
    bool open(Value value) {
        if (levels_.size() == kMaxDepth)
            throw InputError(file_, place(),
                             fmt::format("nested deeper than {} levels", kMaxDepth));
        levels_.push_back({std::move(value), {}});
        return true;
    }
    bool close() {
        Value value = std::move(levels_.back().value);
        levels_.pop_back();
        return add(std::move(value));
    }
    // Where the reading stands: "lights[2].keys[0]".
    std::string place() const {
        std::string path;
        for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
            const Value& value = levels_[i].value;
            if (value.kind == Value::Kind::kArray)
                path += fmt::format("[{}]", value.items.size());
            else
                path += (path.empty() ? "" : ".") + printable(value.members.back().first);
        }
        return path.empty() ? "the document" : path;
    }

    const std::filesystem::path& file_;
    std::string_view text_;
    std::vector<Level> levels_;
    Value root_;
};

}  // namespace

Value parse(const std::filesystem::path& file, std::string_view text) {
    if (text.size() > kMaxDocumentBytes)
        throw InputError(file, fmt::format("{} bytes of JSON, expected at most {}", text.size(),
                                           kMaxDocumentBytes));
    TreeBuilder builder(file, text);
    Library::sax_parse(text.begin(), text.end(), &builder);
    return builder.take();
}

std::string describe(const Value& value) {
    switch (value.kind) {
        case Value::Kind::kNull:
            return "null";
        case Value::Kind::kBoolean:
            return value.boolean ? "true" : "false";
        case Value::Kind::kNumber:
            return fmt::format("{:.9g}", value.number);
        case Value::Kind::kText:
            return fmt::format("\"{}\"", printable(value.text));
        case Value::Kind::kObject:
            return "an object";
        case Value::Kind::kArray:
            break;
    }
    if (value.items.size() > 8) return fmt::format("{} values", value.items.size());
    std::string text = "[";
    for (const Value& item : value.items)
        text += (text.size() > 1 ? ", " : "") +
                (item.kind == Value::Kind::kArray ? std::string("[...]") : describe(item));
    return text + "]";
}

}  // namespace penumbra::json
