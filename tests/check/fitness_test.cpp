#include "apps/check/fitness.h"

#include <doctest/doctest.h>

#include <limits>

#include "core/error.h"
#include "tests/check/folder.h"

using namespace penumbra;
using check::judge_picture;
using tests::Folder;
using tests::write_picture;

TEST_CASE("a picture with something in it is fit") {
    const Folder folder;
    const std::string file = write_picture(
        folder / "a.exr", {{"R", {0, 1}}, {"G", {0, 0}}, {"B", {0, 0}}, {"A", {1, 1}}});
    CHECK(judge_picture(file).problem == "");
}

TEST_CASE("a black picture is unfit, whatever its alpha and depth") {
    const Folder folder;
    const std::string file = write_picture(
        folder / "a.exr",
        {{"R", {0, 0}}, {"G", {0, -0.0f}}, {"B", {0, 0}}, {"A", {1, 0}}, {"Z", {3, 4}}});
    CHECK(judge_picture(file).problem == "is black");
}

TEST_CASE("a picture of one colour is unfit") {
    const Folder folder;
    const std::string file = write_picture(
        folder / "a.exr", {{"R", {0.5f, 0.5f}}, {"G", {0.25f, 0.25f}}, {"B", {1, 1}}});
    CHECK(judge_picture(file).problem == "has one colour everywhere");
}

TEST_CASE("without a picture all layers are judged") {
    const Folder folder;
    CHECK(judge_picture(write_picture(folder / "a.exr", {{"Z", {3, 4}}, {"E", {0, 0}}})).problem ==
          "");
    CHECK(judge_picture(write_picture(folder / "b.exr", {{"Z", {3, 3}}, {"E", {0, 0}}})).problem ==
          "has one colour everywhere");
    CHECK(judge_picture(write_picture(folder / "c.exr", {{"Z", {0, 0}}, {"E", {0, 0}}})).problem ==
          "is black");
}

TEST_CASE("a value that is no finite number makes any picture unfit") {
    const Folder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::string file = write_picture(
        folder / "a.exr", {{"R", {0, 1}}, {"G", {0, 0}}, {"B", {0, 0}}, {"Z", {1, nan}}});
    CHECK(judge_picture(file).problem == "holds 1 values that are no finite numbers");
}

TEST_CASE("equal pixels have equal digests, whatever else the files hold") {
    const Folder folder;
    const std::vector<tests::PictureChannel> pixels{{"R", {0, 1}}, {"Z", {3, 4}}};
    const auto digest = judge_picture(write_picture(folder / "a.exr", pixels)).pixels;
    CHECK(judge_picture(write_picture(folder / "b.exr", pixels, image::ExrCompression::kRle,
                                      {{"comment", std::string("another")}}))
              .pixels == digest);
    CHECK(judge_picture(write_picture(folder / "c.exr", {{"R", {0, 1}}, {"Z", {4, 3}}})).pixels !=
          digest);
    CHECK(judge_picture(write_picture(folder / "d.exr", {{"R", {0, 1}}, {"E", {3, 4}}})).pixels !=
          digest);
}

TEST_CASE("what is no picture, or not all of one, cannot be judged") {
    const Folder folder;
    const std::string whole =
        write_picture(folder / "whole.exr", {{"R", std::vector<float>(999, 0.5f)}});
    std::filesystem::resize_file(whole, std::filesystem::file_size(whole) - 8);
    CHECK_THROWS_AS(static_cast<void>(judge_picture(whole)), InputError);
    CHECK_THROWS_AS(static_cast<void>(judge_picture(folder.write("a.exr", "text"))), InputError);
}
