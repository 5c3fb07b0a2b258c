#include "core/text_scan.h"

namespace penumbra {
namespace {

constexpr std::string_view kBlanks = " \t\r";

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

std::size_t skip_digits(std::string_view word, std::size_t at) {
    while (at < word.size() && is_digit(word[at])) ++at;
    return at;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(kBlanks);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view take_word(std::string_view& text) {
    std::size_t at = 0;
    while (at < text.size() && kBlanks.find(text[at]) == kBlanks.npos) ++at;
    const std::string_view word = text.substr(0, at);
    while (at < text.size() && kBlanks.find(text[at]) != kBlanks.npos) ++at;
    text.remove_prefix(at);
    return word;
}

bool is_number(std::string_view word) {
    std::size_t at = !word.empty() && (word[0] == '+' || word[0] == '-') ? 1 : 0;
    const std::size_t whole = skip_digits(word, at);
    std::size_t digits = whole - at;
    at = whole;
    if (at < word.size() && word[at] == '.') {
        const std::size_t end = skip_digits(word, at + 1);
        digits += end - (at + 1);
        at = end;
    }
    if (digits == 0) return false;
    if (at == word.size()) return true;
    if (word[at] != 'e' && word[at] != 'E') return false;
    ++at;
    if (at < word.size() && (word[at] == '+' || word[at] == '-')) ++at;
    const std::size_t end = skip_digits(word, at);
    // Longer exponents are beyond any number, and beyond some parsers.
    return end == word.size() && end > at && end - at <= 4;
}

std::string printable(std::string_view text) {
    constexpr std::size_t kLongest = 60;
    std::string result(text.substr(0, kLongest));
    for (char& c : result)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return text.size() > kLongest ? result + "..." : result;
}

}  // namespace penumbra
