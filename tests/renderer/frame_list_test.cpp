#include "apps/renderer/frame_list.h"

#include <doctest/doctest.h>

#include "core/error.h"

using namespace penumbra;
using namespace penumbra::renderer;

TEST_CASE("a frame list gives single frames, ranges and steps in the order given, each once") {
    CHECK(parse_frame_list("7") == std::vector<int>{7});
    CHECK(parse_frame_list("1-4") == std::vector<int>{1, 2, 3, 4});
    CHECK(parse_frame_list("1-10x3") == std::vector<int>{1, 4, 7, 10});
    CHECK(parse_frame_list("5, 9,2-3 , 3") == std::vector<int>{5, 9, 2, 3});
    CHECK(parse_frame_list("-2-1") == std::vector<int>{-2, -1, 0, 1});
    CHECK(parse_frame_list("-5--4") == std::vector<int>{-5, -4});
}

TEST_CASE("what is no frame list is refused with the item") {
    for (const char* text : {"", "x", "1-", "4-1", "1-4x0", "1-4x-1", "1,,2", "1-4y2", "1 2",
                             "99999999999", "1-2-3"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(static_cast<void>(parse_frame_list(text)), InputError);
    }
    CHECK_THROWS_WITH(static_cast<void>(parse_frame_list("1,b")),
                      "--frames: expected a frame, FIRST-LAST or FIRST-LASTxSTEP, got \"b\"");
    CHECK_THROWS_AS(static_cast<void>(parse_frame_list("1-2147483647")), InputError);
}

TEST_CASE("runs of '#' in the file name become the frame number") {
    CHECK(expand_pattern("out/shot.####.exr", 12) == "out/shot.0012.exr");
    CHECK(expand_pattern("shot.##.exr", 12345) == "shot.12345.exr");
    CHECK(expand_pattern("s#/f#.exr", 3) == "s#/f3.exr");
    CHECK(expand_pattern("f.####.exr", -7) == "f.-0007.exr");
    CHECK(expand_pattern("still.exr", 3) == "still.exr");
    CHECK(has_frame_number("a/b.####.exr"));
    CHECK_FALSE(has_frame_number("a####/b.exr"));
}
