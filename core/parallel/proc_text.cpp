#include "core/parallel/proc_text.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>

namespace penumbra::parallel {

std::vector<std::string_view> split_words(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> words;
    while (true) {
        const std::size_t begin = text.find_first_not_of(separators);
        if (begin == std::string_view::npos) return words;
        text.remove_prefix(begin);
        const std::size_t end = std::min(text.find_first_of(separators), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
}

std::optional<long long> parse_integer(std::string_view text) {
    const std::vector<std::string_view> words = split_words(text, " \t\r\n");
    if (words.size() != 1) return std::nullopt;
    const char* const end = words[0].data() + words[0].size();
    long long value = 0;
    const auto [stop, error] = std::from_chars(words[0].data(), end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

std::string read_text(const std::filesystem::path& file_path) {
    std::ifstream file(file_path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace penumbra::parallel
