#include "apps/cli/render_options.h"

#include <fmt/format.h>

#include <charconv>
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
const Words<ExrCompression> kCompressions = {
    {"zip", ExrCompression::kZip},   {"zips", ExrCompression::kZips},
    {"piz", ExrCompression::kPiz},   {"rle", ExrCompression::kRle},
    {"dwaa", ExrCompression::kDwaa}, {"none", ExrCompression::kNone}};
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

void declare_what(CLI::App& command, RenderOptions& o) {
    command.add_option("SCENE", o.scene,
                       "Scene file (.json) or a model alone (.obj); without it the built-in scene");
    command.add_option("-o,--output", o.output.pattern,
                       "Where frames go; '####' is the frame number [SCENE's name .####.exr]");
    command.add_option("-f,--frames", o.frames,
                       "Frames: 1-48, 1-100x2, 5,9,20-30 [the scene's range]");
    command.add_option("--size", o.size, "Picture size WIDTHxHEIGHT in pixels [the scene's]");
    command.add_option(
        "--crop", o.crop,
        "X0,Y0,X1,Y1: render only this part, half-open from the top left; the pixels "
        "are those of the whole picture");
}

// The constants of the noise estimate and the filter; docs/methods.md says what they do.
void declare_filter(CLI::App& command, RenderOptions& o) {
    denoise::NoiseSettings& noise = o.image.noise;
    denoise::FilterSettings& filter = o.image.filter;
    add_words(command, "--noise-rule", o.noise_rule, kLineRules,
              "How the variations of the shadow along lines through a pixel become one number");
    const auto number = [&](const char* option, auto& target, double low, double high,
                            const char* help) {
        command.add_option(option, target, help)->check(in_range(low, high))->capture_default_str();
    };
    number("--noise-radius", noise.radius, 2, denoise::kMaxLineRadius, "Of those lines, in pixels");
    number("--noise-full", noise.full_noise, 1e-3, 1e3,
           "Root of the mean variation that counts as full noise");
    number("--filter-radius", filter.radius, 1, denoise::kMaxFilterRadius,
           "Of the filter at full noise, in pixels");
    number("--filter-gain", filter.radius_per_noise, 0, 1e3,
           "Share of that radius per unit of noise");
    number("--filter-normal-weight", filter.normal_weight, 0, 1e3,
           "How much other normals are kept out");
    number("--filter-plane-weight", filter.plane_weight, 0, 1e3,
           "How much other planes are kept out");
}

void declare_how(CLI::App& command, RenderOptions& o) {
    add_words(
        command, "--method", o.method, kMethods,
        "ratio: analytic light times the estimated shadow; stochastic: plain Monte Carlo with "
        "the same rays; unshadowed: the analytic light alone");
    command
        .add_option("--spp", o.image.samples_per_pixel,
                    "Shadow rays per light and pixel, 1 to 64 [the scene's, else 1]")
        ->check(in_range(1, 64));
    command.add_option("--aa", o.image.passes, "Jittered passes per frame, 1 to 256")
        ->check(in_range(1, 256))
        ->capture_default_str();
    add_words(command, "--denoise", o.denoise, kDenoisers, "How the shadow is filtered");
    declare_filter(command, o);
    command
        .add_option("--light-tolerance", o.image.light_tolerance,
                    "Lights whose bounds add up to at most this share of the others' are left out "
                    "per tile; 0 leaves out none")
        ->check(in_range(0.0, 1.0))
        ->capture_default_str();
    command.add_option("--seed", o.image.seed, "Seed of the random numbers")->capture_default_str();
}

void declare_output(CLI::App& command, RenderOptions& o) {
    std::string names = "What to write, of: all";
    for (const renderer::AovInfo& aov : renderer::aov_table())
        names += fmt::format(", {}", aov.name);
    command.add_option("--aov", o.aovs, names)->capture_default_str();
    add_words(command, "--compression", o.compression, kCompressions, "Of the EXR files");
    add_words(command, "--precision", o.precision, kPrecisions,
              "Of the channels that are half by default");
    command.add_flag(
        "--resume", o.output.resume,
        "Skip frames whose file is complete and was made from the same scene and settings");
    command.add_option("--preview", o.preview,
                       "Tone-mapped PNG beside each frame, a pattern like --output's");
    command.add_option("--exposure", o.output.exposure, "Of the previews, in EV")
        ->check(in_range(-100.0, 100.0))
        ->capture_default_str();
    command.add_option("--stats", o.statistics,
                       "Write times and counts per frame to this JSON file");
    add_words(command, "--progress", o.progress, kProgressStyles,
              "auto: a line with ETA on a terminal, else a line per frame");
    command.add_flag("--dry-run", o.dry_run, "Check everything and say what would be rendered");
}

void declare_execution(CLI::App& command, RenderOptions& o) {
    command
        .add_option("--threads", o.execution.threads,
                    "Threads; changes no pixel [what affinity, cgroup quota and Slurm allow]")
        ->check(in_range(1, 1024));
    add_words(command, "--isa", o.isa, kIsas, "Instruction set of the kernels; changes no pixel");
    add_words(command, "--trace-isa", o.trace_isa, kTraceIsas,
              "Instruction set of the ray tracer; another one may change one ray in a million");
}

}  // namespace

void declare_options(CLI::App& command, RenderOptions& options) {
    declare_what(command, options);
    declare_how(command, options);
    declare_output(command, options);
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
    o.output.compression = meaning(kCompressions, o.compression);
    if (o.output.compression == ExrCompression::kDwaa &&
        o.output.aovs != renderer::AovSet{renderer::Aov::kBeauty})
        throw InputError(
            "--compression: dwaa loses digits: expected another one, or --aov beauty alone");
    o.output.float_precision = meaning(kPrecisions, o.precision);
    if (!o.preview.empty()) o.output.preview = o.preview;
    o.execution.isa = meaning(kIsas, o.isa);
    o.execution.trace_isa = meaning(kTraceIsas, o.trace_isa);
}

ProgressStyle progress_style(const RenderOptions& options) {
    return meaning(kProgressStyles, options.progress);
}

}  // namespace penumbra::cli
