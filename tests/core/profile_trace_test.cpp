#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/profile/trace.h"

namespace penumbra::profile {
namespace {

using nlohmann::json;

json trace_of(const Profile& profile, const char* title = "test") {
    return json::parse(chrome_trace(profile, title));
}

const json* find(const json& trace, const std::string& name) {
    for (const json& event : trace["traceEvents"])
        if (event["name"] == name) return &event;
    return nullptr;
}

}  // namespace

TEST_CASE("a slice becomes a complete event in microseconds since the first slice") {
    Profile profile;
    profile.make_tracks(2);
    profile.track(0).add({.name = "frame", .begin = 5'000'000'000, .end = 5'000'002'001});
    profile.track(1).add({.name = "trace",
                          .begin = 5'000'000'250,
                          .end = 5'000'001'250,
                          .first = {"x", 64},
                          .second = {"y", -128},
                          .third = {"rays", 4096},
                          .kind = Kind::kPass});
    const json trace = trace_of(profile);
    const json* const event = find(trace, "trace");
    REQUIRE(event != nullptr);
    CHECK((*event)["ph"] == "X");
    CHECK((*event)["cat"] == "pass");
    CHECK((*event)["ts"].get<double>() == doctest::Approx(0.25));
    CHECK((*event)["dur"].get<double>() == doctest::Approx(1.0));
    CHECK((*event)["tid"] == 1);
    CHECK((*event)["args"] == json{{"x", 64}, {"y", -128}, {"rays", 4096}});
    CHECK((*find(trace, "frame"))["dur"].get<double>() == doctest::Approx(2.001));
    CHECK_FALSE(find(trace, "frame")->contains("args"));
}

TEST_CASE("every thread has a name and its gaps are events of their own") {
    Profile profile;
    profile.make_tracks(2);
    profile.track(0).add({.name = "frame", .begin = 0, .end = 1000});
    const json trace = trace_of(profile);
    int names = 0;
    for (const json& event : trace["traceEvents"]) names += event["name"] == "thread_name";
    CHECK(names == 2);
    REQUIRE(find(trace, "idle") != nullptr);
    CHECK((*find(trace, "idle"))["tid"] == 1);
    CHECK((*find(trace, "idle"))["cat"] == "idle");
}

TEST_CASE("titles may hold what JSON must escape, and an empty profile is a valid trace") {
    const char* const title = "a \"quoted\" back\\slash\nline";
    const json trace = trace_of(Profile(), title);
    CHECK(trace["otherData"]["title"] == title);
    CHECK(trace["otherData"]["dropped_slices"] == 0);
    CHECK(trace["traceEvents"].size() == 1);
}

}  // namespace penumbra::profile
