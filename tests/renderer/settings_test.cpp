#include "apps/renderer/settings_table.h"

#include <doctest/doctest.h>

#include <map>
#include <set>
#include <type_traits>
#include <vector>

#include "apps/renderer/builtin_scene.h"
#include "apps/renderer/settings_digest.h"
#include "tests/renderer/support.h"

using namespace penumbra;
using namespace penumbra::tests;
using renderer::Choice;
using renderer::Flag;
using renderer::Number;
using renderer::Written;

namespace {

struct Settings {
    ImageSettings image{.width = 48, .height = 32, .crop = PixelRect{8, 8, 40, 24}};
    ExecutionSettings execution{.threads = 1};
    renderer::OutputSettings output{.aovs = all_aovs()};
};

template <class S, class V>
void each_setting(S& settings, const V& visit) {
    renderer::each_setting(settings.image, settings.execution, settings.output, visit);
}

// Another value of each kind.
template <class T>
void change(const Choice<T>& setting, T& value) {
    value = setting.words.front().second == value ? setting.words.back().second
                                                  : setting.words.front().second;
}
template <class T>
void change(const Number& setting, T& value) {
    const auto middle = static_cast<T>((setting.low + setting.high) / 2);
    value = value == middle ? static_cast<T>(setting.low) : middle;
}
void change(const Flag&, bool& value) {
    value = !value;
}
template <class T>
void change(const Written<T>& setting, T& value) {
    static const std::map<std::string_view, std::string_view> kOthers = {
        {"size", "64x48"}, {"crop", "0,8,40,24"}, {"aov", "beauty,E"}, {"preview", "other.png"}};
    CAPTURE(std::string(setting.name));
    REQUIRE_MESSAGE(kOthers.contains(setting.name), "the test needs another value in words");
    read_text(setting, kOthers.at(setting.name), value);
}

std::set<std::string> names() {
    std::set<std::string> all;
    const Settings defaults;
    each_setting(defaults, [&](const auto& setting, const auto&) {
        CHECK_MESSAGE(all.emplace(setting.name).second, "named twice: ", setting.name);
    });
    return all;
}

Settings with_changed(const Settings& base, const std::string& name) {
    Settings other = base;
    each_setting(other, [&](const auto& setting, auto& value) {
        if (setting.name == name) change(setting, value);
    });
    return other;
}

std::string described(const Settings& s) {
    return renderer::describe_settings(s.image, s.execution, s.output);
}

std::uint64_t pixels_of(const Settings& s) {
    static const Scene scene = renderer::read_builtin_scene();
    return digest(render(scene, s.image, s.execution));
}

// The members of a structure as addresses. Does not compile when there is another member: then it
// is a line of the table, or one of those that no file depends on.
using Members = std::vector<const void*>;
Members members(const denoise::NoiseSettings& noise) {
    const auto& [radius, full_noise, rule] = noise;
    return {&radius, &full_noise, &rule};
}
Members members(const denoise::FilterSettings& filter) {
    const auto& [radius, per_noise, smallest, normal, plane] = filter;
    return {&radius, &per_noise, &smallest, &normal, &plane};
}
Members members(const ImageSettings& image) {
    const auto& [width, height, crop, method, denoise, samples, passes, unshadowed, noise, filter,
                 seed, tolerance, reproducible] = image;
    Members all = {&width,  &height,     &crop, &method,    &denoise,     &samples,
                   &passes, &unshadowed, &seed, &tolerance, &reproducible};
    for (const Members& part : {members(noise), members(filter)})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}
Members members(const renderer::OutputSettings& output) {
    const auto& [pattern, preview, exposure, aovs, compression, precision, resume] = output;
    static_cast<void>(pattern);
    static_cast<void>(resume);
    return {&preview, &exposure, &aovs, &compression, &precision};
}

}  // namespace

TEST_CASE("a changed setting changes the digest, or no AOV") {
    using renderer::Denoise;
    using renderer::Method;
    for (const Method method : {Method::kRatio, Method::kStochastic, Method::kUnshadowed}) {
        for (const Denoise denoise : {Denoise::kNoiseDriven, Denoise::kNone}) {
            Settings base;
            base.image.method = method;
            base.image.denoise = denoise;
            for (const std::string& name : names()) {
                CAPTURE(name);
                const Settings other = with_changed(base, name);
                if (described(other) == described(base)) CHECK(pixels_of(other) == pixels_of(base));
            }
        }
    }
}

TEST_CASE("what changes nothing beside the others does not make --resume render anew") {
    Settings base;
    CHECK(described(with_changed(base, "exposure")) == described(base));
    CHECK(described(with_changed(base, "trace-isa")) != described(base));
    base.image.reproducible = true;
    CHECK(described(with_changed(base, "trace-isa")) == described(base));
    base.output.preview = "some.png";
    CHECK(described(with_changed(base, "exposure")) != described(base));
    CHECK(described(with_changed(base, "preview")) == described(base));
}

TEST_CASE("without a filter the noise estimate's settings still show in E, and in the digest") {
    Settings base;
    base.image.denoise = renderer::Denoise::kNone;
    for (const char* name : {"noise-radius", "noise-rule", "noise-full"}) {
        CAPTURE(name);
        const Settings other = with_changed(base, name);
        CHECK(pixels_of(other) != pixels_of(base));
        CHECK(described(other) != described(base));
    }
}

TEST_CASE("no member that a file depends on is missing in the table") {
    const Settings settings;
    std::set<const void*> visited;
    each_setting(settings, [&](const auto&, const auto& value) { visited.insert(&value); });
    visited.insert(&settings.image.width);  // of "size", which stands for the whole structure
    visited.insert(&settings.image.height);
    for (const void* member : members(settings.image)) CHECK(visited.contains(member));
    for (const void* member : members(settings.output)) CHECK(visited.contains(member));
    CHECK(visited.contains(&settings.execution.trace_isa));
}

TEST_CASE("what is said in words is read back as it was") {
    Settings settings;
    each_setting(settings, [&](const auto& setting, auto& value) {
        if constexpr (requires { read_text(setting, std::string_view{}, value); }) {
            CAPTURE(std::string(setting.name));
            change(setting, value);
            std::remove_reference_t<decltype(value)> back{};
            read_text(setting, text_of(setting, value), back);
            CHECK(text_of(setting, back) == text_of(setting, value));
        }
    });
}
