#include "apps/check/selection.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "tests/check/folder.h"

using namespace penumbra;
using check::Check;
using tests::Folder;

namespace {

std::vector<std::string> names(const Folder& folder, const std::vector<Check>& checks) {
    std::vector<std::string> names;
    for (const Check& check : checks) names.push_back(check.name.substr(folder.path().size() + 1));
    return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("a folder's checks are what has settings or goldens") {
    const Folder folder;
    for (const char* file :
         {"a.json", "a.check.json", "b/b.json", "b/b.golden.exr", "b/deep/c.json",
          "b/deep/c.golden.0012.exr", "b/deep/c.golden.-003.exr", "d.obj", "d.golden.exr",
          // none of these is one
          "other.json", "package.json", "e.golden.png", "f.golden.x1.exr", "golden.exr", "g.exr",
          ".check.json", ".git/h.check.json", "b/.hidden.check.json"})
        folder.write(file);
    const auto checks = check::find_checks({folder.path()});
    CHECK(names(folder, checks) == Names{"a", "b/b", "b/deep/c", "d"});
    CHECK(checks[0].settings == folder / "a.check.json");
    CHECK(checks[0].scene == folder / "a.json");
    CHECK(checks[1].settings.empty());
    CHECK(checks[3].scene == folder / "d.obj");
}

TEST_CASE("a scene that is named is checked, with its settings if it has them") {
    const Folder folder;
    const std::string scene = folder.write("a.json"), model = folder.write("m.obj");
    CHECK(check::find_checks({scene})[0].settings.empty());
    CHECK(check::find_checks({model})[0].scene == model);
    folder.write("a.check.json");
    CHECK(check::find_checks({scene})[0].settings == folder / "a.check.json");
}

TEST_CASE("the model of a scene's name gives way to the scene") {
    const Folder folder;
    folder.write("a.obj"), folder.write("a.json"), folder.write("a.check.json");
    CHECK(check::find_checks({folder.path()})[0].scene == folder / "a.json");
}

TEST_CASE("each check is found once, whatever leads to it") {
    const Folder folder;
    folder.write("s/a.json"), folder.write("s/a.check.json"), folder.write("s/a.golden.exr");
    std::filesystem::create_directory_symlink(folder / "s", folder / "link");
    const auto checks =
        check::find_checks({folder.path(), folder / "s", folder / "s/a.json",
                            folder / "link/a.check.json", folder / "s/../s/a.golden.exr"});
    CHECK(names(folder, checks) == Names{"s/a"});
}

TEST_CASE("paths that stand for nothing are refused") {
    const Folder folder;
    folder.write("a.json");
    const auto find = [](const std::string& path) {
        static_cast<void>(check::find_checks({path}));
    };
    CHECK_THROWS_AS(find(folder / "nowhere"), InputError);
    CHECK_THROWS_AS(find(folder.path()), InputError);
    CHECK_THROWS_AS(find(folder.write("a.png")), InputError);
}

TEST_CASE("filters are parts of names, with * and ?") {
    const std::vector<Check> checks{{"goldens/teapot", "", ""}, {"goldens/cubes", "", ""}};
    CHECK(check::filtered(checks, {}).size() == 2);
    CHECK(check::filtered(checks, {"tea"}).size() == 1);
    CHECK(check::filtered(checks, {"ens/*bes"}).size() == 1);
    CHECK(check::filtered(checks, {"t?a", "cub"}).size() == 2);
    CHECK_THROWS_AS(static_cast<void>(check::filtered(checks, {"sphere"})), InputError);
}

TEST_CASE("goldens lie beside the check") {
    const Folder folder;
    CHECK(check::golden_path("a/b", "") == "a/b.golden.exr");
    CHECK(check::golden_path("a/b", "0012") == "a/b.golden.0012.exr");
    folder.write("a.golden.exr"), folder.write("a.golden.0001.exr"), folder.write("ab.golden.exr");
    folder.write("a.b.golden.exr");
    CHECK(
        check::existing_goldens(folder / "a") ==
        std::vector<std::filesystem::path>{folder / "a.golden.0001.exr", folder / "a.golden.exr"});
}
