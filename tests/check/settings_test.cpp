#include "apps/check/settings.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "tests/check/folder.h"

using namespace penumbra;
using check::CheckSettings;
using tests::Folder;

namespace {

const std::vector<check::RenderOption> kOptions = {
    {"spp", false}, {"size", false}, {"aov", false}, {"reproducible", true}};

CheckSettings read(const std::string& text) {
    const Folder folder;
    return check::read_settings(folder.write("shot.check.json", text), kOptions);
}

// The message of the InputError that `text` causes, without the file's name.
std::string refusal(const std::string& text) {
    try {
        static_cast<void>(read(text));
    } catch (const InputError& error) {
        const std::string message = error.what();
        return message.substr(message.find(".check.json: ") + 13);
    }
    return "";
}

}  // namespace

TEST_CASE("an empty object lets nothing differ") {
    const CheckSettings settings = read("{}");
    CHECK(settings.scene.empty());
    CHECK(settings.render.empty());
    CHECK_FALSE(settings.tolerates_anything());
}

TEST_CASE("render options become words of a command line") {
    const CheckSettings settings =
        read(R"({"render": {"spp": 4, "size": "64x32", "aov": ["beauty", "Z"],
                            "reproducible": true}})");
    CHECK(settings.render ==
          check::RenderValues{
              {"aov", "beauty,Z"}, {"reproducible", "true"}, {"size", "64x32"}, {"spp", "4"}});
    CHECK(read(R"({"render": {"reproducible": false}})").render.empty());
}

TEST_CASE("unknown keys and options are refused with the nearest known one") {
    CHECK(refusal(R"({"sene": "a.json"})") ==
          "the document: unknown key \"sene\"; did you mean \"scene\"?");
    CHECK(refusal(R"({"render": {"ssp": 4}})") ==
          "render: unknown key \"ssp\"; did you mean \"spp\"?");
    CHECK(refusal(R"({"diff": {"fail-abov": "flip=1"}})") ==
          "diff: unknown key \"fail-abov\"; did you mean \"fail-above\"?");
}

TEST_CASE("values of another kind are refused") {
    CHECK(refusal(R"({"render": {"spp": true}})").starts_with("render.spp: expected a text"));
    CHECK(refusal(R"({"render": {"reproducible": "yes"}})")
              .starts_with("render.reproducible: expected true or false"));
    CHECK(refusal(R"({"render": {"aov": [["Z"]]}})").starts_with("render.aov[0]: expected"));
    CHECK(refusal("[]").starts_with("the document: expected an object"));
    CHECK(refusal("{").starts_with("line 1, column"));
    CHECK(refusal(R"({"reason": "a", "reason": "b"})") ==
          "the document: the key \"reason\" stands twice");
}

TEST_CASE("whatever lets pictures differ needs a reason") {
    const std::vector<std::string> loose = {
        R"("fail-above": "flip=0.01")", R"("fail-above": ["max=0", "mae=1e-6"])",
        R"("fail-below": "psnr=40")",   R"("pixel-threshold": 0.001)",
        R"("ignore-layers": ["E"])",    R"("mask": "mask.png")"};
    for (const std::string& diff : loose) {
        CAPTURE(diff);
        CHECK(
            refusal("{\"diff\": {" + diff + "}}").starts_with("the document: \"reason\" is miss"));
        CHECK(refusal("{\"diff\": {" + diff + "}, \"reason\": \"  \"}") != "");
        CHECK(refusal("{\"diff\": {" + diff + "}, \"reason\": \"noise\"}") == "");
    }
    CHECK(refusal(R"({"diff": {"fail-above": "flip=0"}})") == "");
}

TEST_CASE("thresholds are those of penumbra diff") {
    const CheckSettings settings = read(
        R"({"diff": {"fail-above": ["flip=0.02", "max=1"], "fail-below": "ssim=0.9"}, "reason": "x"})");
    REQUIRE(settings.thresholds.size() == 3);
    CHECK(settings.thresholds[0].metric == diff::Metric::kFlip);
    CHECK(settings.thresholds[0].limit == 0.02);
    CHECK(settings.thresholds[2].metric == diff::Metric::kSsim);
    CHECK(refusal(R"({"diff": {"fail-above": "psnr=40"}, "reason": "x"})")
              .starts_with("diff.fail-above: "));
    CHECK(refusal(R"({"diff": {"fail-above": 0.1}, "reason": "x"})")
              .starts_with("diff.fail-above: expected a text"));
}

TEST_CASE("the scene and the mask are found from the file's folder") {
    const Folder folder;
    const CheckSettings settings = check::read_settings(
        folder.write(
            "goldens/shot.check.json",
            R"({"scene": "../scenes/shot.json", "diff": {"mask": "m.png"}, "reason": "x"})"),
        kOptions);
    CHECK(settings.scene == folder / "scenes/shot.json");
    CHECK(settings.mask == folder / "goldens/m.png");
}
