#include "apps/check/memory.h"

#include <doctest/doctest.h>

#include "tests/check/folder.h"

using namespace penumbra;
using check::Check;
using check::CheckSettings;
using check::estimated_bytes;
using tests::Folder;

TEST_CASE("larger frames and models need more memory") {
    const Folder folder;
    folder.write("m.obj", std::string(1'000'000, '#'));
    const Check small{"s", "", folder.write("s.json", R"({"film": {"size": [64, 32]}})")};
    const Check large{"l", "", folder.write("l.json", R"({"film": {"size": [4096, 4096]}})")};
    const Check model{"m", "", folder.write("m.json", R"({"film": {"size": [64, 32]},
                                                          "models": [{"file": "m.obj"}]})")};
    CHECK(estimated_bytes(large, {}) > 4096u * 4096 * 175);  // measured for beauty alone
    CHECK(estimated_bytes(large, {}) > estimated_bytes(model, {}));
    CHECK(estimated_bytes(model, {}) >= estimated_bytes(small, {}) + 10'000'000);
    CHECK(estimated_bytes({"m", "", folder / "m.obj"}, {}) > estimated_bytes(small, {}));
}

TEST_CASE("the check's own size counts") {
    const Folder folder;
    const Check check{"l", "", folder.write("l.json", R"({"film": {"size": [4096, 4096]}})")};
    CheckSettings settings;
    settings.render["size"] = "64x32";
    CHECK(estimated_bytes(check, settings) < std::uint64_t{100} << 20);
    settings.render["size"] = "nonsense";
    CHECK(estimated_bytes(check, settings) > std::uint64_t{1} << 30);
}

TEST_CASE("a scene that cannot be read does not stop the estimate") {
    const Folder folder;
    CHECK(estimated_bytes({"a", "", folder.write("a.json", "{{")}, {}) > 0);
    CHECK(estimated_bytes({"a", "", folder / "none.json"}, {}) > 0);
    CHECK(check::available_bytes() > 0);
}
