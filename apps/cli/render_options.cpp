#include "apps/cli/render_options.h"

#include <optional>

#include "apps/cli/option_checks.h"
#include "apps/renderer/settings_table.h"
#include "core/error.h"

namespace penumbra::cli {
namespace {

const renderer::Choice<ProgressStyle> kProgress = {
    "progress",
    {{"auto", ProgressStyle::kAuto},
     {"plain", ProgressStyle::kPlain},
     {"json", ProgressStyle::kJson},
     {"openjd", ProgressStyle::kOpenJd},
     {"none", ProgressStyle::kNone}},
    "What is printed meanwhile: plain lines, json objects, openjd messages or none; auto is one "
    "line with the time left on a terminal, else plain"};

renderer::Choice<std::optional<simd::Isa>> isa() {
    return isa_setting("Instruction set of everything but the ray tracer; changes no pixel");
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
    each_frame_setting(o.image, SettingDeclarer(command, o.texts));
    command.add_flag(
        "--resume", o.output.resume,
        "Skip frames whose file is complete and was made from the same scene and settings");
    command.add_flag("--dry-run", o.dry_run,
                     "Check everything, print the names of the frames, render nothing");
}

void declare_light(CLI::App& command, RenderOptions& o) {
    begin_group(command, "Light and shadow");
    each_light_setting(o.image, SettingDeclarer(command, o.texts));
}

void declare_filter(CLI::App& command, RenderOptions& o) {
    begin_group(command, "Filter of the shadow; the defaults suit most scenes");
    each_noise_setting(o.image, SettingDeclarer(command, o.texts));
    each_filter_setting(o.image, SettingDeclarer(command, o.texts));
}

void declare_files(CLI::App& command, RenderOptions& o) {
    begin_group(command, "What the files hold");
    each_file_setting(o.output, SettingDeclarer(command, o.texts));
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
    const SettingDeclarer declare(command, o.texts);
    declare(kProgress, o.progress);
    command
        .add_option("--threads", o.execution.threads,
                    "Threads; changes no pixel [what affinity, cgroup quota and Slurm allow]")
        ->check(in_range(1, 1024));
    declare(isa(), o.execution.isa);
    each_tracer_setting(o.image, o.execution, declare);
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
    const SettingReader read(o.texts);
    renderer::each_setting(o.image, o.execution, o.output, read);
    read(isa(), o.execution.isa);
    read(kProgress, o.progress);
    if (o.output.compression == image::ExrCompression::kDwaa &&
        o.output.aovs != renderer::AovSet{renderer::Aov::kBeauty})
        throw InputError(
            "--compression: dwaa loses digits: expected another one, or --aov beauty alone");
}

}  // namespace penumbra::cli
