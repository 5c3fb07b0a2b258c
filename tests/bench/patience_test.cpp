#include <doctest/doctest.h>

#include "apps/bench/core_share.h"
#include "apps/bench/patience.h"

using namespace penumbra;
using penumbra::bench::Patience;

namespace {

const std::atomic<bool> kGoOn = false;
// No core reaches it.
constexpr double kOutOfReach = 1e9;

}  // namespace

TEST_CASE("without patience there are as many repetitions as asked for, disturbed or not") {
    const parallel::Arena arena(1);
    Patience patience({.repetitions = 3, .best_share = 3}, arena);
    for (int i = 0; i < 3; ++i) {
        CHECK(patience.wants_more());
        patience.wait(kGoOn);
        patience.add(1);
    }
    CHECK_FALSE(patience.wants_more());
    CHECK(patience.count() == 3);
}

TEST_CASE("with patience, until as many were undisturbed") {
    const parallel::Arena arena(1);
    Patience patience({.repetitions = 3, .seconds = 1000}, arena);
    CHECK(patience.progress() == "1 of 3");
    for (const double share : {2.0, 2.1, 2.0}) patience.add(share);
    CHECK_FALSE(patience.wants_more());
    // What had seemed to be cores of our own were not.
    patience.add(3);
    CHECK(patience.wants_more());
    CHECK(patience.progress() == "2 of 3, 3 more were disturbed");
    patience.add(2);
    patience.add(2.95);
    CHECK(patience.wants_more());
    patience.add(2.95);
    CHECK_FALSE(patience.wants_more());
}

TEST_CASE("a share that is known from before makes the first ones disturbed") {
    const parallel::Arena arena(1);
    Patience patience({.repetitions = 1, .seconds = 1000, .best_share = 3}, arena);
    patience.add(2);
    CHECK(patience.wants_more());
    patience.add(3);
    CHECK_FALSE(patience.wants_more());
}

TEST_CASE("patience ends, and where it is cancelled at once") {
    const parallel::Arena arena(1);
    Patience patience({.repetitions = 1, .seconds = 0.02, .best_share = kOutOfReach}, arena);
    patience.wait(kGoOn);
    patience.add(1);
    CHECK_FALSE(patience.wants_more());
    const std::atomic<bool> cancelled = true;
    Patience endless({.repetitions = 1, .seconds = 1e9, .best_share = kOutOfReach}, arena);
    endless.wait(cancelled);
    CHECK(endless.wants_more());
}

TEST_CASE("a core's share is a positive number, of one thread and of several") {
    for (const int threads : {1, 3}) {
        const double share = bench::core_share(parallel::Arena(threads));
        CHECK(share > 0);
        CHECK(share < 1e6);
    }
}
