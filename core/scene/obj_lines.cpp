#include "core/scene/obj_lines.h"

#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/text_scan.h"

namespace penumbra {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 20;
constexpr std::size_t kLongestLine = std::size_t{64} << 20;

// A vertex reference: 7, 7/1, 7//3, 7/1/3, each number whole, not 0, maybe negative, and small
// enough for int.
bool is_reference(std::string_view word) {
    int part = 0;
    std::size_t at = 0;
    while (true) {
        const bool negative = at < word.size() && word[at] == '-';
        const std::size_t start = at + (negative || (at < word.size() && word[at] == '+') ? 1 : 0);
        std::size_t end = start;
        bool is_zero = true;
        for (; end < word.size() && word[end] >= '0' && word[end] <= '9'; ++end)
            is_zero = is_zero && word[end] == '0';
        const bool left_out = end == at && part == 1;  // 7//3
        if (!left_out && (end == start || end - start > 9 || is_zero)) return false;
        if (end == word.size()) return !left_out;
        if (word[end] != '/' || part == 2) return false;
        // "7/" and "7/1/" occur in the wild: nothing after the last slash means it is not there.
        if (end + 1 == word.size()) return true;
        ++part;
        at = end + 1;
    }
}

// "7/ 8/ 9/" -> "7 8 9": after a slash tinyobjloader reads the next number, blanks or not.
void drop_dangling_slashes(std::string& line) {
    for (std::size_t i = line.size(); i-- > 1;) {
        const bool is_last = line[i] == ' ' || line[i] == '\t' || line[i] == '\n';
        while (is_last && i > 0 && line[i - 1] == '/') line.erase(--i, 1);
    }
}

}  // namespace

void ObjLines::fail(std::string_view message) const {
    throw InputError(file_, fmt::format("line {}", served_line_), message);
}

bool ObjLines::refill() {
    if (block_at_ < block_.size()) return true;
    block_.resize(kBlockBytes);
    raw_.read(block_.data(), static_cast<std::streamsize>(kBlockBytes));
    block_.resize(static_cast<std::size_t>(raw_.gcount()));
    block_at_ = 0;
    if (raw_.bad()) throw OutputError(file_, "reading failed");
    return !block_.empty();
}

// Up to the next '\n', "\r\n", '\r' or the file's end.
bool ObjLines::fetch_physical_line() {
    physical_.clear();
    bool is_last = true;
    while (refill()) {
        const char* const start = block_.data() + block_at_;
        if (after_carriage_ && *start == '\n') ++block_at_;
        if (std::exchange(after_carriage_, false) && *start == '\n') continue;
        is_last = false;
        std::size_t length = block_.size() - block_at_;
        const auto* feed = static_cast<const char*>(std::memchr(start, '\n', length));
        if (feed) length = static_cast<std::size_t>(feed - start);
        const auto* carriage = static_cast<const char*>(std::memchr(start, '\r', length));
        if (carriage) length = static_cast<std::size_t>(carriage - start);
        physical_.append(start, length);
        if (physical_.size() > kLongestLine)
            throw InputError(file_, fmt::format("line {}", physical_line_ + 1),
                             "longer than 64 MiB: not an OBJ file");
        after_carriage_ = carriage != nullptr;
        block_at_ += length + (feed || carriage ? 1 : 0);
        if (feed || carriage) return true;
    }
    return !is_last;
}

// Joins lines that end in a backslash.
bool ObjLines::fetch_line() {
    line_.clear();
    while (fetch_physical_line()) {
        ++physical_line_;
        line_ += physical_;
        if (line_.empty() || line_.back() != '\\' || line_.front() == '#') return true;
        line_.back() = ' ';
        if (line_.size() > kLongestLine)
            throw InputError(file_, fmt::format("line {}", physical_line_),
                             "longer than 64 MiB: not an OBJ file");
    }
    return !line_.empty();
}

void ObjLines::check_numbers(std::string_view words, int at_least, int at_most) const {
    int count = 0;
    while (!words.empty()) {
        const std::string_view word = take_word(words);
        if (!is_number(word)) fail(fmt::format("expected a number, got \"{}\"", printable(word)));
        ++count;
    }
    if (count < at_least || count > at_most)
        fail(fmt::format("expected {} numbers, got {}", at_least, count));
}

void ObjLines::check_face(std::string_view words) const {
    if (words.empty()) fail("a face without vertices");
    while (!words.empty()) {
        const std::string_view word = take_word(words);
        if (!is_reference(word))
            fail(fmt::format("expected a vertex like 7, 7/1, 7//3 or 7/1/3, got \"{}\"",
                             printable(word)));
    }
}

void ObjLines::filter_line() {
    if (std::memchr(line_.data(), '\0', line_.size())) fail("holds a zero byte: not a text file");
    std::string_view rest = trimmed(line_);
    const std::string_view keyword = take_word(rest);
    const bool is_geometry = keyword == "v" || keyword == "vn" || keyword == "vt" || keyword == "f";
    if (is_geometry) rest = trimmed(rest.substr(0, rest.find('#')));
    if (keyword == "v")
        check_numbers(rest, 3, 8);  // w or a colour may follow
    else if (keyword == "vn")
        check_numbers(rest, 3, 3);
    else if (keyword == "vt")
        check_numbers(rest, 1, 3);
    else if (keyword == "f")
        check_face(rest);
    else if (keyword == "mtllib" && !rest.empty())
        libraries_.emplace_back(rest);
    if (!is_geometry && !(keyword == "usemtl" && !rest.empty())) {
        line_.assign(1, '\n');
        return;
    }
    std::string served(keyword);
    served += ' ';
    served += rest;
    served += '\n';
    if (keyword == "f") drop_dangling_slashes(served);
    line_ = std::move(served);
}

ObjLines::int_type ObjLines::underflow() {
    if (gptr() < egptr()) return traits_type::to_int_type(*gptr());
    if (!fetch_line()) return traits_type::eof();
    served_line_ = physical_line_;
    filter_line();
    setg(line_.data(), line_.data(), line_.data() + line_.size());
    return traits_type::to_int_type(*gptr());
}

}  // namespace penumbra
