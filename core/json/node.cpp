#include "core/json/node.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/text_scan.h"

namespace penumbra::json {
namespace {

// Levenshtein's distance; a swap of neighbours counts as two edits.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

}  // namespace

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
    constexpr std::size_t kLongestWord = 100;  // the distance costs the product of the lengths
    if (word.size() > kLongestWord) return "";
    std::size_t best = std::max<std::size_t>(2, word.size() / 2) + 1;
    std::string nearest;
    for (const std::string& candidate : candidates) {
        if (candidate.size() > kLongestWord) continue;
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best) {
            best = distance;
            nearest = candidate;
        }
    }
    return nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest);
}

void Node::fail(std::string_view message) const {
    throw InputError(file(), place_, message);
}

void Node::expected(std::string_view what) const {
    fail(fmt::format("expected {}, got {}", what, describe(*value_)));
}

Node Node::child(const std::string& suffix, const Value& value) const {
    return {file(), value, place_ == "the document" ? suffix : place_ + "." + suffix};
}

void Node::allow(std::initializer_list<std::string_view> keys) const {
    if (value_->kind != Value::Kind::kObject) expected("an object");
    for (const auto& [key, value] : value_->members) {
        if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
        unknown_key(key, std::vector<std::string>(keys.begin(), keys.end()));
    }
}

void Node::unknown_key(std::string_view key, const std::vector<std::string>& known) const {
    fail(fmt::format("unknown key \"{}\"{}", printable(key), suggestion(key, known)));
}

std::optional<Node> Node::find(std::string_view key) const {
    if (value_->kind != Value::Kind::kObject) expected("an object");
    for (const auto& [name, value] : value_->members)
        if (name == key) return child(name, value);
    return std::nullopt;
}

Node Node::require(std::string_view key) const {
    if (auto found = find(key)) return *found;
    fail(fmt::format("\"{}\" is missing", key));
}

std::size_t Node::member_count() const {
    if (value_->kind != Value::Kind::kObject) expected("an object");
    return value_->members.size();
}

std::pair<std::string, Node> Node::member(std::size_t index) const {
    const auto& [name, value] = value_->members[index];
    return {name, child(name, value)};
}

std::size_t Node::size() const {
    if (value_->kind != Value::Kind::kArray) expected("a list");
    return value_->items.size();
}

Node Node::operator[](std::size_t index) const {
    return {file(), value_->items[index], fmt::format("{}[{}]", place_, index)};
}

double Node::number(Range range) const {
    if (!is_number()) expected("a number");
    const double x = value_->number;
    if (!(x >= range.low && x <= range.high))
        expected(fmt::format("a number between {:g} and {:g}", range.low, range.high));
    return x;
}

int Node::integer(int low, int high) const {
    const std::string what = fmt::format("a whole number between {} and {}", low, high);
    if (!is_number()) expected(what);
    const double x = value_->number;
    if (!(x >= low && x <= high) || std::floor(x) != x) expected(what);
    return static_cast<int>(x);
}

bool Node::boolean() const {
    if (value_->kind != Value::Kind::kBoolean) expected("true or false");
    return value_->boolean;
}

const std::string& Node::text() const {
    if (value_->kind != Value::Kind::kText) expected("a text");
    return value_->text;
}

Vec3f Node::vector(Range range) const {
    const auto is_number = [](const Value& v) { return v.kind == Value::Kind::kNumber; };
    if (value_->kind != Value::Kind::kArray || value_->items.size() != 3 ||
        !std::all_of(value_->items.begin(), value_->items.end(), is_number))
        expected("3 numbers");
    const auto component = [&](std::size_t i) {
        return static_cast<float>((*this)[i].number(range));
    };
    return {component(0), component(1), component(2)};
}

}  // namespace penumbra::json
