#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"

// The kinds of settings: what there is to say of one, beside the value that it stands for. Names
// are those of the command line, without dashes. A help text may end in a default that is no value,
// in brackets: "[the scene's]". A setting without a help text is none of the command line's.

namespace penumbra::renderer {

// One of some words. Of an optional value, unset may have none: then its text is empty.
template <class T>
struct Choice {
    std::string_view name;
    std::vector<std::pair<std::string_view, T>> words;
    std::string_view help{};
};

// From low to high.
struct Number {
    std::string_view name;
    double low, high;
    std::string_view help{};
};

// Off unless it is given.
struct Flag {
    std::string_view name;
    std::string_view help{};
};

// In a notation of its own. What stands for it in help ("WIDTHxHEIGHT") is left out of lists of
// words. An empty text means that nothing was said, in both directions.
template <class T>
struct Written {
    std::string_view name, value_name;
    void (*read)(std::string_view text, T& value);  // throws InputError
    std::string (*print)(const T& value);
    std::string_view help{};
    std::vector<std::string> words{};
};

// Values as the command line takes them.
template <class T>
std::string text_of(const Choice<T>& setting, const T& value) {
    for (const auto& [word, meaning] : setting.words)
        if (meaning == value) return std::string(word);
    if constexpr (requires { value.has_value(); })
        if (!value.has_value()) return "";
    PENUMBRA_ASSERT(false, "a value of {} without a word", setting.name);
    return "";
}
template <class T>
std::string text_of(const Number&, const T& value) {
    return fmt::format("{}", value);
}
inline std::string text_of(const Flag&, bool value) {
    return value ? "true" : "false";
}
template <class T>
std::string text_of(const Written<T>& setting, const T& value) {
    return setting.print(value);
}

// And back. Throws InputError.
template <class T>
void read_text(const Choice<T>& setting, std::string_view text, T& value) {
    if (text.empty()) return;  // nothing was said
    for (const auto& [word, meaning] : setting.words) {
        if (word != text) continue;
        value = meaning;
        return;
    }
    throw InputError(fmt::format("--{}: unknown word \"{}\"", setting.name, text));
}
template <class T>
void read_text(const Written<T>& setting, std::string_view text, T& value) {
    if (!text.empty()) setting.read(text, value);
}

}  // namespace penumbra::renderer
