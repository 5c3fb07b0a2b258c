#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "apps/renderer/output_settings.h"
#include "apps/renderer/setting.h"
#include "apps/renderer/setting_notations.h"
#include "apps/renderer/settings.h"
#include "core/image/exr.h"

// Every setting that the file of a frame depends on, once, in the order of help. The command line,
// the digest that --resume compares, the header of the EXR and the statistics are all made by
// visitors, which are called as visit(setting, value): `setting` is of a kind of setting.h, `value`
// refers to the member that it stands for. A new setting is a member and a line here.

namespace penumbra::renderer {

template <class Image, class V>
void each_frame_setting(Image& image, const V& visit) {
    visit(Written<ImageSettings>{"size", "WIDTHxHEIGHT", read_size, print_size,
                                 "Picture size in pixels [the scene's]"},
          image);
    visit(
        Written<std::optional<PixelRect>>{
            "crop", "X0,Y0,X1,Y1", read_crop, print_crop,
            "Render only columns X0 to X1-1 and rows Y0 to Y1-1, counted from the top left; "
            "the pixels are those of the whole picture"},
        image.crop);
}

template <class Image, class V>
void each_light_setting(Image& image, const V& visit) {
    visit(
        Choice<Method>{
            "method",
            {{"ratio", Method::kRatio},
             {"stochastic", Method::kStochastic},
             {"unshadowed", Method::kUnshadowed}},
            "ratio: analytic light times the estimated shadow; stochastic: plain Monte Carlo "
            "with the same rays; unshadowed: the analytic light alone"},
        image.method);
    visit(
        Choice<LobeAccuracy>{
            "unshadowed",
            {{"exact", LobeAccuracy::kExact}, {"fast", LobeAccuracy::kFast}},
            "Glossy light without shadows: exact, equal to the BRDF's integral to about 0.1 %, or "
            "fast, to about 1 %"},
        image.unshadowed);
    visit(Number{"spp", 1, 64, "Shadow rays per light and pixel, 1 to 64 [the scene's, else 1]"},
          image.samples_per_pixel);
    visit(Number{"aa", 1, 256, "Passes per frame at jittered places, for smooth edges"},
          image.passes);
    visit(Number{"light-tolerance", 0, 1,
                 "Each tile leaves out the faintest lights, as long as they give at most this "
                 "share of the others' light; 0 leaves out none"},
          image.light_tolerance);
    visit(Number{"seed", 0, std::numeric_limits<std::uint32_t>::max(),
                 "Seed of the random numbers: another one gives other noise"},
          image.seed);
}

// The constants of the noise estimate and the filter; docs/methods.md says what they do.
template <class Image, class V>
void each_noise_setting(Image& image, const V& visit) {
    auto& noise = image.noise;
    visit(
        Choice<std::optional<Denoise>>{
            "denoise",
            {{"noise-driven", Denoise::kNoiseDriven}, {"none", Denoise::kNone}},
            "How noise is filtered: noise-driven, as wide as it is noisy, or none; of ratio the "
            "shadow alone, of stochastic the light with its textures [noise-driven for ratio, "
            "else none]"},
        image.denoise);
    visit(
        Choice<denoise::LineRule>{
            "noise-rule",
            {{"maximum", denoise::LineRule::kMaximum}, {"mean", denoise::LineRule::kMean}},
            "How the shadow's variations along four lines through a pixel become its noise: "
            "their mean or their maximum"},
        noise.rule);
    visit(
        Number{"noise-radius", 2, denoise::kMaxLineRadius, "How far those lines reach, in pixels"},
        noise.radius);
    visit(Number{"noise-full", 1e-3, 1e3,
                 "The root of the variation that counts as full noise: larger values filter less"},
          noise.full_noise);
}

template <class Image, class V>
void each_filter_setting(Image& image, const V& visit) {
    auto& filter = image.filter;
    visit(Number{"filter-radius", 1, denoise::kMaxFilterRadius,
                 "Radius of the filter at full noise, in pixels"},
          filter.radius);
    visit(
        Number{"filter-gain", 0, 1e3,
               "How fast the radius grows with noise: as a share of that radius, up to all of it"},
        filter.radius_per_noise);
    visit(Number{"filter-smallest-radius", 0, denoise::kMaxFilterRadius}, filter.smallest_radius);
    visit(Number{"filter-normal-weight", 0, 1e3,
                 "How strongly pixels with other normals are kept out"},
          filter.normal_weight);
    visit(Number{"filter-plane-weight", 0, 1e3,
                 "How strongly pixels off the surface's plane are kept out"},
          filter.plane_weight);
}

// What the files hold.
template <class Output, class V>
void each_file_setting(Output& output, const V& visit) {
    visit(Written<AovSet>{"aov", "", read_aovs, print_aovs,
                          "Layers of each frame, a list with commas", aov_words()},
          output.aovs);
    visit(
        Choice<image::ExrCompression>{
            "compression", compression_words(),
            "Of the frames; dwaa is lossy and for the layer beauty alone"},
        output.compression);
    visit(
        Choice<bool>{
            "precision",
            {{"half", false}, {"float", true}},
            "Type of the channels that need no float (positions and depth always have it)"},
        output.float_precision);
    visit(
        Written<std::optional<std::string>>{
            "preview", "PATTERN.png", read_preview, print_preview,
            "Write tone-mapped pictures too; '####' stands for the frame number"},
        output.preview);
    visit(Number{"exposure", -100, 100, "Exposure of the previews in EV"}, output.exposure);
}

template <class Image, class Execution, class V>
void each_tracer_setting(Image& image, Execution& execution, const V& visit) {
    using shadow::TraceIsa;
    visit(
        Choice<TraceIsa>{
            "trace-isa",
            {{"avx2", TraceIsa::kAvx2}, {"avx512", TraceIsa::kAvx512}, {"auto", TraceIsa::kAuto}},
            "Instruction set of the ray tracer; another one may change one ray in a million"},
        execution.trace_isa);
    visit(Flag{"reproducible",
               "Settle shadow rays exactly, in our own arithmetic: equal bits on all processors "
               "with AVX2; tracing takes 0.4 to 1.3 times as long"},
          image.reproducible);
}

// All of them. The structures may be const.
template <class Image, class Execution, class Output, class V>
void each_setting(Image& image, Execution& execution, Output& output, const V& visit) {
    each_frame_setting(image, visit);
    each_light_setting(image, visit);
    each_noise_setting(image, visit);
    each_filter_setting(image, visit);
    each_file_setting(output, visit);
    each_tracer_setting(image, execution, visit);
}

}  // namespace penumbra::renderer
