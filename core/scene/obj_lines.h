#pragma once

#include <filesystem>
#include <istream>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

// A filter between an OBJ file and tinyobjloader, which takes what is no number for 0 and knows no
// line numbers. Serves the vertex, face and usemtl lines, each checked word by word, one at a time;
// joins continued lines, drops comments, unifies line ends. All other lines become empty ones,
// except that the file names of mtllib, which may hold spaces, are kept. Throws InputError with the
// line.
class ObjLines : public std::streambuf {
  public:
    ObjLines(const std::filesystem::path& file, std::istream& raw) : file_(file), raw_(raw) {}

    // Of the line served last, counted from 1.
    [[nodiscard]] std::size_t line_number() const { return served_line_; }
    [[nodiscard]] const std::vector<std::string>& libraries() const { return libraries_; }

    [[noreturn]] void fail(std::string_view message) const;

  protected:
    int_type underflow() override;

  private:
    bool refill();
    bool fetch_physical_line();
    bool fetch_line();
    void filter_line();
    void check_numbers(std::string_view words, int at_least, int at_most) const;
    void check_face(std::string_view words) const;

    const std::filesystem::path& file_;
    std::istream& raw_;
    std::string block_;  // read ahead
    std::size_t block_at_ = 0;
    bool after_carriage_ = false;  // a line feed right here belongs to the line before
    std::string physical_, line_;
    std::size_t physical_line_ = 0;
    std::size_t served_line_ = 0;
    std::vector<std::string> libraries_;
};

}  // namespace penumbra
