#include "apps/cli/render_options.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "apps/cli/option_checks.h"
#include "core/error.h"

namespace penumbra::cli {
namespace {

using image::ExrCompression;

template <class T>
using Words = std::vector<std::pair<std::string, T>>;

const Words<renderer::Method> kMethods = {{"ratio", renderer::Method::kRatio},
                                          {"stochastic", renderer::Method::kStochastic},
                                          {"unshadowed", renderer::Method::kUnshadowed}};
const Words<renderer::Denoise> kDenoisers = {{"noise-driven", renderer::Denoise::kNoiseDriven},
                                             {"none", renderer::Denoise::kNone}};
const Words<denoise::LineRule> kLineRules = {{"maximum", denoise::LineRule::kMaximum},
                                             {"mean", denoise::LineRule::kMean}};
const Words<bool> kPrecisions = {{"half", false}, {"float", true}};
const Words<std::optional<simd::Isa>> kIsas = {
    {"auto", std::nullopt}, {"avx2", simd::Isa::kAvx2}, {"avx512", simd::Isa::kAvx512}};
const Words<shadow::TraceIsa> kTraceIsas = {{"avx2", shadow::TraceIsa::kAvx2},
                                            {"avx512", shadow::TraceIsa::kAvx512},
                                            {"auto", shadow::TraceIsa::kAuto}};
const Words<ProgressStyle> kProgressStyles = {{"auto", ProgressStyle::kAuto},
                                              {"plain", ProgressStyle::kPlain},
                                              {"json", ProgressStyle::kJson},
                                              {"openjd", ProgressStyle::kOpenJd},
                                              {"none", ProgressStyle::kNone}};

Words<ExrCompression> compressions() {
    Words<ExrCompression> words;
    for (const ExrCompression each : image::exr_compressions())
        words.emplace_back(image::name(each), each);
    return words;
}

template <class T>
std::vector<std::string> spellings(const Words<T>& words) {
    std::vector<std::string> names;
    for (const auto& [name, value] : words) names.push_back(name);
    return names;
}

// The parser has checked the spelling (CLI::IsMember).
template <class T>
T meaning(const Words<T>& words, const std::string& spelling) {
    for (const auto& [name, value] : words)
        if (name == spelling) return value;
    throw InputError(fmt::format("unknown word \"{}\"", spelling));
}

template <class T>
void add_words(CLI::App& command, const char* option, std::string& target, const Words<T>& words,
               const char* help) {
    command.add_option(option, target, help)
        ->check(CLI::IsMember(spellings(words)))
        ->capture_default_str();
}

// `count` integers with one separator between each two; empty if the text is anything else.
std::vector<int> integers(std::string_view text, char separator, std::size_t count) {
    std::vector<int> values;
    while (values.size() < count) {
        int value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{}) return {};
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        values.push_back(value);
        if (values.size() == count) break;
        if (text.empty() || text.front() != separator) return {};
        text.remove_prefix(1);
    }
    return text.empty() ? values : std::vector<int>{};
}

void require_png(const std::string& preview) {
    const std::size_t dot = preview.rfind('.');
    if (dot == std::string::npos || preview.substr(dot) != ".png")
        throw InputError(
            fmt::format("--preview: expected a name that ends in .png, got \"{}\"", preview));
}

// Options that follow stand under this heading.
void begin_group(CLI::App& command, const char* heading) {
    command.option_defaults()->group(heading);
}

void declare_frames(CLI::App& command, RenderOptions& o) {
    begin_group(command, "Frames");
    command
        .add_option("SCENE", o.scene,
                    "A scene (.json) or a model alone (.obj); without it the built-in scene")
        ->type_name("FILE.json|obj");
    command
        .add_option("-o,--output", o.output.pattern,
                    "Where frames go; '####' stands for the frame number, folders are created "
                    "[SCENE's name and .exr, with .#### before it for several frames]")
        ->type_name("PATTERN.exr");
    command
        .add_option("-f,--frames", o.frames,
                    "Which frames: 1-48, 1-100x2 (every second), 5,9,20-30 [the scene's range]")
        ->type_name("LIST");
    command.add_option("--size", o.size, "Picture size in pixels [the scene's]")
        ->type_name("WIDTHxHEIGHT");
    command
        .add_option(
            "--crop", o.crop,
            "Render only columns X0 to X1-1 and rows Y0 to Y1-1, counted from the top left; "
            "the pixels are those of the whole picture")
        ->type_name("X0,Y0,X1,Y1");
    command.add_flag(
        "--resume", o.output.resume,
        "Skip frames whose file is complete and was made from the same scene and settings");
    command.add_flag("--dry-run", o.dry_run,
                     "Check everything, print the names of the frames, render nothing");
}

void declare_light(CLI::App& command, RenderOptions& o) {
    begin_group(command, "Light and shadow");
    add_words(
        command, "--method", o.method, kMethods,
        "ratio: analytic light times the estimated shadow; stochastic: plain Monte Carlo with "
        "the same rays; unshadowed: the analytic light alone");
    command
        .add_option("--spp", o.image.samples_per_pixel,
                    "Shadow rays per light and pixel, 1 to 64 [the scene's, else 1]")
        ->check(in_range(1, 64));
    command
        .add_option("--aa", o.image.passes, "Passes per frame at jittered places, for smooth edges")
        ->check(in_range(1, 256))
        ->capture_default_str();
    command
        .add_option("--light-tolerance", o.image.light_tolerance,
                    "Each tile leaves out the faintest lights, as long as they give at most this "
                    "share of the others' light; 0 leaves out none")
        ->check(in_range(0.0, 1.0))
        ->capture_default_str();
    command
        .add_option("--seed", o.image.seed,
                    "Seed of the random numbers: another one gives other noise")
        ->check(in_range(0, std::numeric_limits<std::uint32_t>::max()))
        ->capture_default_str();
}

// The constants of the noise estimate and the filter; docs/methods.md says what they do.
void declare_filter(CLI::App& command, RenderOptions& o) {
    begin_group(command, "Filter of the shadow; the defaults suit most scenes");
    denoise::NoiseSettings& noise = o.image.noise;
    denoise::FilterSettings& filter = o.image.filter;
    add_words(command, "--denoise", o.denoise, kDenoisers,
              "How noise of the shadow is filtered: noise-driven, as wide as it is noisy, or none");
    add_words(command, "--noise-rule", o.noise_rule, kLineRules,
              "How the shadow's variations along four lines through a pixel become its noise: "
              "their mean or their maximum");
    const auto number = [&](const char* option, auto& target, double low, double high,
                            const char* help) {
        command.add_option(option, target, help)->check(in_range(low, high))->capture_default_str();
    };
    number("--noise-radius", noise.radius, 2, denoise::kMaxLineRadius,
           "How far those lines reach, in pixels");
    number("--noise-full", noise.full_noise, 1e-3, 1e3,
           "The root of the variation that counts as full noise: larger values filter less");
    number("--filter-radius", filter.radius, 1, denoise::kMaxFilterRadius,
           "Radius of the filter at full noise, in pixels");
    number("--filter-gain", filter.radius_per_noise, 0, 1e3,
           "How fast the radius grows with noise: as a share of that radius, up to all of it");
    number("--filter-normal-weight", filter.normal_weight, 0, 1e3,
           "How strongly pixels with other normals are kept out");
    number("--filter-plane-weight", filter.plane_weight, 0, 1e3,
           "How strongly pixels off the surface's plane are kept out");
}

std::vector<std::string> aov_names() {
    std::vector<std::string> names{"all"};
    for (const renderer::AovInfo& aov : renderer::aov_table()) names.emplace_back(aov.name);
    return names;
}

void declare_files(CLI::App& command, RenderOptions& o) {
    begin_group(command, "What the files hold");
    command.add_option("--aov", o.aovs, "Layers of each frame, a list with commas")
        ->check(list_of(aov_names()))
        ->capture_default_str();
    add_words(command, "--compression", o.compression, compressions(),
              "Of the frames; dwaa is lossy and for the layer beauty alone");
    add_words(command, "--precision", o.precision, kPrecisions,
              "Type of the channels that need no float (positions and depth always have it)");
    command
        .add_option("--preview", o.preview,
                    "Write tone-mapped pictures too; '####' stands for the frame number")
        ->type_name("PATTERN.png");
    command.add_option("--exposure", o.output.exposure, "Exposure of the previews in EV")
        ->check(in_range(-100.0, 100.0))
        ->capture_default_str();
    command
        .add_option("--stats", o.statistics,
                    "Write the times and counts of each frame, see docs/statistics.md")
        ->type_name("FILE.json");
    command
        .add_option("--trace", o.trace,
                    "Write what each thread did when, for ui.perfetto.dev or chrome://tracing")
        ->type_name("FILE.json");
}

void declare_execution(CLI::App& command, RenderOptions& o) {
    begin_group(command, "Running");
    add_words(command, "--progress", o.progress, kProgressStyles,
              "What is printed meanwhile: plain lines, json objects, openjd messages or none; auto "
              "is one line with the time left on a terminal, else plain");
    command
        .add_option("--threads", o.execution.threads,
                    "Threads; changes no pixel [what affinity, cgroup quota and Slurm allow]")
        ->check(in_range(1, 1024));
    add_words(command, "--isa", o.isa, kIsas,
              "Instruction set of everything but the ray tracer; changes no pixel");
    add_words(command, "--trace-isa", o.trace_isa, kTraceIsas,
              "Instruction set of the ray tracer; another one may change one ray in a million");
    command.add_flag("--reproducible", o.image.reproducible,
                     "Settle shadow rays exactly, in our own arithmetic: equal bits on all "
                     "processors with AVX2; tracing takes 0.4 to 1.3 times as long");
}

}  // namespace

void declare_options(CLI::App& command, RenderOptions& options) {
    declare_frames(command, options);
    declare_light(command, options);
    declare_filter(command, options);
    declare_files(command, options);
    declare_execution(command, options);
}

void interpret(RenderOptions& o) {
    constexpr int kLargestSide = 16384;  // as for a scene's film.size
    if (!o.size.empty()) {
        const std::vector<int> size = integers(o.size, 'x', 2);
        if (size.empty() || size[0] < 1 || size[1] < 1 || size[0] > kLargestSide ||
            size[1] > kLargestSide)
            throw InputError(fmt::format("--size: expected WIDTHxHEIGHT, each 1 to {}, got \"{}\"",
                                         kLargestSide, o.size));
        o.image.width = size[0];
        o.image.height = size[1];
    }
    if (!o.crop.empty()) {
        const std::vector<int> c = integers(o.crop, ',', 4);
        if (c.empty() || c[0] < 0 || c[1] < 0 || c[2] <= c[0] || c[3] <= c[1])
            throw InputError(fmt::format(
                "--crop: expected X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1, got \"{}\"", o.crop));
        o.image.crop = PixelRect{.x0 = c[0], .y0 = c[1], .x1 = c[2], .y1 = c[3]};
    }
    o.image.method = meaning(kMethods, o.method);
    o.image.denoise = meaning(kDenoisers, o.denoise);
    o.image.noise.rule = meaning(kLineRules, o.noise_rule);
    o.output.aovs = renderer::parse_aov_list(o.aovs);
    o.output.compression = meaning(compressions(), o.compression);
    if (o.output.compression == ExrCompression::kDwaa &&
        o.output.aovs != renderer::AovSet{renderer::Aov::kBeauty})
        throw InputError(
            "--compression: dwaa loses digits: expected another one, or --aov beauty alone");
    o.output.float_precision = meaning(kPrecisions, o.precision);
    if (!o.preview.empty()) {
        require_png(o.preview);
        o.output.preview = o.preview;
    }
    o.execution.isa = meaning(kIsas, o.isa);
    o.execution.trace_isa = meaning(kTraceIsas, o.trace_isa);
}

ProgressStyle progress_style(const RenderOptions& options) {
    return meaning(kProgressStyles, options.progress);
}

}  // namespace penumbra::cli
