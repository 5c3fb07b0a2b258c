#include <doctest/doctest.h>

#include "apps/bench/floors.h"

using namespace penumbra;
using penumbra::bench::Floors;
using profile::Kind;

namespace {

void add(profile::Profile& profile, int worker, Kind kind, const char* name, std::int64_t first,
         std::int64_t second, profile::Nanoseconds begin, profile::Nanoseconds time) {
    profile.track(worker).add({.name = name,
                               .begin = begin,
                               .end = begin + time,
                               .first = {"x", first},
                               .second = {"y", second},
                               .kind = kind});
}

// Two tiles by two workers: "trace" runs twice in each, "shade" once.
profile::Profile repetition(profile::Nanoseconds trace0, profile::Nanoseconds trace1,
                            profile::Nanoseconds shade0, bool is_swapped) {
    profile::Profile profile;
    profile.make_tracks(2);
    const int left = is_swapped ? 1 : 0;
    add(profile, left, Kind::kPass, "trace", 0, 64, 0, trace0 / 2);
    add(profile, left, Kind::kPass, "trace", 0, 64, trace0, trace0 - trace0 / 2);
    add(profile, left, Kind::kPass, "shade", 0, 64, 2 * trace0, shade0);
    add(profile, 1 - left, Kind::kPass, "trace", 64, 0, 0, trace1);
    // A task and a loop of that name are something else.
    add(profile, 0, Kind::kTask, "trace", 0, 64, 0, 7'000'000);
    return profile;
}

}  // namespace

TEST_CASE("the floor of a pass is made of each tile's quickest repetition") {
    Floors floors;
    CHECK(floors.milliseconds(Kind::kPass, "trace") == 0);
    floors.add(repetition(3'000'000, 9'000'000, 1'000'000, false));
    CHECK(floors.milliseconds(Kind::kPass, "trace") == doctest::Approx(12));
    // The other tile is disturbed, and other workers have them.
    floors.add(repetition(8'000'000, 4'000'001, 2'000'000, true));
    CHECK(floors.milliseconds(Kind::kPass, "trace") == doctest::Approx(7.000001));
    CHECK(floors.milliseconds(Kind::kPass, "shade") == doctest::Approx(1));
    CHECK(floors.milliseconds(Kind::kTask, "trace") == doctest::Approx(7));
    CHECK(floors.milliseconds(Kind::kPass, "filter") == 0);
}

TEST_CASE("the floor of a phase is what it takes outside of its loops") {
    Floors floors;
    for (const profile::Nanoseconds alone : {5'000'000, 2'000'000, 3'000'000}) {
        profile::Profile profile;
        profile.make_tracks(1);
        add(profile, 0, Kind::kTask, "filter", 0, 0, 0, 6'000'000);
        add(profile, 0, Kind::kLoop, "filter", 1, 0, 0, 6'500'000);
        add(profile, 0, Kind::kPhase, "filter", 0, 0, 0, 6'500'000 + alone);
        floors.add(profile);
    }
    CHECK(floors.milliseconds(Kind::kPhase, "filter") == doctest::Approx(2));
    CHECK(floors.milliseconds(Kind::kTask, "filter") == doctest::Approx(6));
}

TEST_CASE("a profile that dropped slices knows no floors") {
    Floors floors;
    profile::Profile profile(1, 1);
    profile.make_tracks(1);
    profile.make_room();
    for (int tile = 0; tile < 3; ++tile)
        add(profile, 0, Kind::kPass, "trace", tile, 0, tile * 10, 5);
    REQUIRE(profile.dropped() > 0);
    floors.add(profile);
    CHECK(floors.milliseconds(Kind::kPass, "trace") == 0);
    floors.add(repetition(3'000'000, 9'000'000, 1'000'000, false));
    CHECK(floors.milliseconds(Kind::kPass, "trace") == 0);
}
