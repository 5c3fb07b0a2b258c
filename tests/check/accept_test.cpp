#include "apps/check/accept.h"

#include <doctest/doctest.h>

#include "tests/check/folder.h"

using namespace penumbra::check;
using penumbra::tests::Folder;

namespace {

// A check without a golden, whose render has these pixels.
CheckOutcome unblessed(const Folder& folder, const std::string& name, std::uint64_t pixels) {
    CheckOutcome outcome;
    outcome.check.name = name;
    outcome.frames.push_back({.golden = folder / (name + ".golden.exr"),
                              .render = folder.write(name + ".exr", "pixels of " + name),
                              .verdict = Verdict::kMissing,
                              .render_fitness = Fitness{.pixels = {.high = 0, .low = pixels}}});
    return outcome;
}

bool has_golden(const CheckOutcome& outcome) {
    return std::filesystem::exists(outcome.frames[0].golden);
}

}  // namespace

TEST_CASE("missing goldens are written, and none for two renders with the same pixels") {
    const Folder folder;
    std::vector<CheckOutcome> outcomes{unblessed(folder, "a", 1), unblessed(folder, "b", 2),
                                       unblessed(folder, "c", 2)};
    const std::atomic<bool> cancelled = false;
    accept({.bless = true}, outcomes, cancelled);
    CHECK(outcomes[0].verdict() == Verdict::kBlessed);
    CHECK(has_golden(outcomes[0]));
    for (const std::size_t twin : {1, 2}) {
        CHECK(outcomes[twin].verdict() == Verdict::kUnfit);
        CHECK_FALSE(has_golden(outcomes[twin]));
    }
}

TEST_CASE("where it is cancelled no more goldens are written, and none is said to be") {
    const Folder folder;
    std::vector<CheckOutcome> outcomes{unblessed(folder, "a", 1), unblessed(folder, "b", 2)};
    const std::atomic<bool> cancelled = true;
    accept({.bless = true}, outcomes, cancelled);
    for (const CheckOutcome& outcome : outcomes) {
        CHECK(outcome.verdict() == Verdict::kMissing);
        CHECK_FALSE(has_golden(outcome));
    }
}
