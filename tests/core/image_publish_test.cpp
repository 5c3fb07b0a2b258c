#include "core/image/publish.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "core/error.h"
#include "core/image/exr.h"
#include "core/image/file_reader.h"
#include "tests/core/image_testing.h"

using namespace penumbra;
using namespace penumbra::image;

namespace {

std::string text_of(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = read_whole_file(file);
    return {bytes.begin(), bytes.end()};
}

// A disk that is full after so many bytes: the limit on the size of files of this process.
class SmallDisk {
  public:
    explicit SmallDisk(rlim_t bytes) {
        previous_ = std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &saved_);
        const rlimit limit{bytes, saved_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~SmallDisk() {
        ::setrlimit(RLIMIT_FSIZE, &saved_);
        std::signal(SIGXFSZ, previous_);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

  private:
    rlimit saved_{};
    void (*previous_)(int);
};

struct NoisyExr {
    Plane<float> plane{64, 64};
    ExrImage image;
    NoisyExr() {
        Random random(1);
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) plane.at(x, y) = static_cast<float>(random.below(10000));
        }
        image.display = image.data = {0, 0, 64, 64};
        image.channels = {{"Y", ExrType::kFloat, plane.view(), {}}};
    }
};

}  // namespace

TEST_CASE("a file appears when it is published, in folders that are made for it") {
    const TemporaryFolder folder;
    const std::filesystem::path target = folder / "a/b/frame.json";
    {
        PendingFile file(target);
        file.write(std::vector<std::uint8_t>{'o', 'k'});
        CHECK(file.path() == folder / "a/b/frame.json.part");
        CHECK_FALSE(std::filesystem::exists(target));
        file.publish();
        CHECK(text_of(target) == "ok");
    }
    CHECK(text_of(target) == "ok");
    CHECK_FALSE(std::filesystem::exists(folder / "a/b/frame.json.part"));
}

TEST_CASE("a file that is not published leaves the old one and nothing else") {
    const TemporaryFolder folder;
    write_file_atomically(folder / "frame", std::string_view("old"));
    {
        PendingFile file(folder / "frame");
        file.write(std::vector<std::uint8_t>{'n', 'e', 'w'});
    }
    CHECK(text_of(folder / "frame") == "old");
    CHECK_FALSE(std::filesystem::exists(folder / "frame.part"));
}

TEST_CASE("a stale partial file is overwritten from its beginning") {
    const TemporaryFolder folder;
    write_bytes(folder / "frame.part", std::vector<std::uint8_t>(1000, 'x'));
    write_file_atomically(folder / "frame", std::string_view("short"));
    CHECK(text_of(folder / "frame") == "short");
}

TEST_CASE("two writers of one file do not mix: the second is refused, and may come back later") {
    const TemporaryFolder folder;
    {
        PendingFile first(folder / "frame");
        CHECK_THROWS_WITH_AS(PendingFile second(folder / "frame"),
                             doctest::Contains("another process"), OutputError);
        first.write(std::vector<std::uint8_t>{'1'});
        first.publish();
    }
    write_file_atomically(folder / "frame", std::string_view("2"));
    CHECK(text_of(folder / "frame") == "2");
}

TEST_CASE("a full disk is found out, and leaves the old file alone") {
    const TemporaryFolder folder;
    write_file_atomically(folder / "frame", std::string_view("old"));
    const NoisyExr exr;
    for (const int threads : {1, 2}) {
        // Full at the beginning, in the pixels, and only for the table written at the end.
        for (const rlim_t room : {0, 100, 5000}) {
            const SmallDisk disk(room);
            PendingFile file(folder / "frame");
            CHECK_THROWS_WITH_AS(write_exr(file.path(), exr.image, threads),
                                 doctest::Contains("File too large"), OutputError);
        }
    }
    {
        const SmallDisk disk(10);
        CHECK_THROWS_AS(write_file_atomically(folder / "frame", std::string(100, 'x')),
                        OutputError);
    }
    CHECK(text_of(folder / "frame") == "old");
    CHECK_FALSE(std::filesystem::exists(folder / "frame.part"));
}

TEST_CASE("a link stays, and what it points to is written") {
    const TemporaryFolder folder;
    write_file_atomically(folder / "file.json", std::string_view("old"));
    std::filesystem::create_symlink("file.json", folder / "link.json");
    write_file_atomically(folder / "link.json", std::string_view("new"));
    CHECK(std::filesystem::is_symlink(folder / "link.json"));
    CHECK(text_of(folder / "file.json") == "new");
}

TEST_CASE("targets that cannot be files say why") {
    const TemporaryFolder folder;
    CHECK_THROWS_WITH_AS(write_file_atomically(folder / "", std::string_view("x")),
                         doctest::Contains("is a folder"), OutputError);
    CHECK_THROWS_WITH_AS(write_file_atomically("/dev/null", std::string_view("x")),
                         doctest::Contains("not a regular file"), OutputError);
    write_file_atomically(folder / "file", std::string_view("x"));
    CHECK_THROWS_WITH_AS(write_file_atomically(folder / "file/a", std::string_view("x")),
                         doctest::Contains("folder cannot be created"), OutputError);
    CHECK_THROWS_AS(write_file_atomically("/proc/nothing/a", std::string_view("x")), OutputError);
    if (::geteuid() == 0) return;  // to whom no folder is closed
    std::filesystem::create_directory(folder / "closed");
    ::chmod((folder / "closed").c_str(), 0500);
    CHECK_THROWS_WITH_AS(write_file_atomically(folder / "closed/a", std::string_view("x")),
                         doctest::Contains("Permission denied"), OutputError);
}

TEST_CASE("an EXR file is complete when it is whole, and not before") {
    const TemporaryFolder folder;
    const NoisyExr exr;
    write_exr(folder / "a.exr", exr.image, 1);
    require_complete(folder / "a.exr");
    const std::vector<std::uint8_t> whole = read_whole_file(folder / "a.exr");
    for (std::size_t length = 0; length < whole.size(); length += 97) {
        write_bytes(folder / "cut.exr", std::span(whole).first(length));
        CHECK_THROWS_AS(require_complete(folder / "cut.exr"), OutputError);
    }
    write_bytes(folder / "cut.exr", std::span(whole).first(whole.size() - 1));
    CHECK_THROWS_WITH_AS(require_complete(folder / "cut.exr"), doctest::Contains("incomplete"),
                         OutputError);
}
