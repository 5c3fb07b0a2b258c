#include "apps/cli/render_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "apps/cli/option_checks.h"
#include "apps/cli/progress.h"
#include "apps/cli/render_options.h"
#include "apps/cli/say.h"
#include "apps/cli/signals.h"
#include "apps/cli/statistics_file.h"
#include "apps/renderer/builtin_scene.h"
#include "apps/renderer/frame_list.h"
#include "apps/renderer/renderer.h"
#include "core/error.h"
#include "core/image/publish.h"
#include "core/profile/trace.h"
#include "core/scene/read_scene.h"

namespace penumbra::cli {
namespace {

constexpr int kSomeFramesFailed = 3;

constexpr const char* kRenderFooter =
    "Examples:\n"
    "  penumbra render shot.json -o out/shot.####.exr -f 1-240 --resume\n"
    "  penumbra render dwarf.obj -o dwarf.exr --preview dwarf.png --aa 8\n"
    "  penumbra render shot.json -f 1 -o shot.exr --aov beauty,W,N,Z --size 960x540";

std::vector<int> frames_of(const RenderOptions& options, const Scene& scene) {
    if (!options.frames.empty()) return renderer::parse_frame_list(options.frames);
    std::vector<int> frames;
    for (int f = scene.animation.first_frame; f <= scene.animation.last_frame; ++f)
        frames.push_back(f);
    return frames;
}

std::string default_pattern(const RenderOptions& options, std::size_t frame_count) {
    const std::string stem =
        options.scene.empty() ? "penumbra" : std::filesystem::path(options.scene).stem().string();
    return stem + (frame_count > 1 ? ".####.exr" : ".exr");
}

void require_file_per_frame(const char* option, const std::string& pattern,
                            std::size_t frame_count) {
    if (frame_count > 1 && !renderer::has_frame_number(pattern))
        throw InputError(fmt::format("{}: {} frames need '####' in the file name, got \"{}\"",
                                     option, frame_count, pattern));
}

void require_files_of_their_own(const RenderOptions& options, const Scene& scene,
                                const std::vector<int>& frames) {
    std::vector<PlannedFile> outputs;
    for (const int frame : frames) {
        outputs.emplace_back("--output", renderer::expand_pattern(options.output.pattern, frame));
        if (options.output.preview)
            outputs.emplace_back("--preview",
                                 renderer::expand_pattern(*options.output.preview, frame));
    }
    if (!options.statistics.empty()) outputs.emplace_back("--stats", options.statistics);
    if (!options.trace.empty()) outputs.emplace_back("--trace", options.trace);
    require_distinct(outputs, scene.files);
}

void say_what_would_happen(const RenderOptions& options, const std::vector<int>& frames) {
    for (const int frame : frames)
        say(stdout, "{}\n", renderer::expand_pattern(options.output.pattern, frame));
}

int report_failures(const renderer::SequenceReport& report) {
    int failed = 0;
    for (const renderer::FrameReport& frame : report.frames) {
        if (frame.outcome != renderer::FrameOutcome::kFailed) continue;
        ++failed;
        say_error(fmt::format("frame {}: {}", frame.frame, frame.error));
    }
    if (report.interrupted) return interrupt_exit_code();
    return failed > 0 ? kSomeFramesFailed : 0;
}

int render(RenderOptions& options) {
    interpret(options);
    const Scene scene =
        options.scene.empty() ? renderer::read_builtin_scene() : read_scene(options.scene);
    for (const std::string& warning : scene.warnings)
        say(stderr, "warning: {}\n", one_line(warning));
    const std::vector<int> frames = frames_of(options, scene);
    if (options.output.pattern.empty())
        options.output.pattern = default_pattern(options, frames.size());
    require_file_per_frame("--output", options.output.pattern, frames.size());
    if (options.output.preview)
        require_file_per_frame("--preview", *options.output.preview, frames.size());
    require_files_of_their_own(options, scene, frames);
    renderer::check_settings(scene, options.image, options.execution);
    if (options.dry_run) {
        say_what_would_happen(options, frames);
        return 0;
    }

    profile::Profile profile;
    if (!options.trace.empty()) options.execution.profile = &profile;
    Progress progress(options.progress, static_cast<int>(frames.size()));
    const renderer::SequenceReport report = renderer::render_sequence(
        scene, frames, options.image, options.execution, options.output,
        [&](const renderer::FrameReport& frame) { progress.report(frame); }, catch_interrupts());
    const int exit_code = report_failures(report);
    if (!options.statistics.empty()) write_statistics(options.statistics, scene, options, report);
    if (!options.trace.empty())
        image::write_file_atomically(options.trace, profile::chrome_trace(profile, "penumbra"));
    return exit_code;
}

}  // namespace

std::shared_ptr<RenderOptions> add_render_command(CLI::App& app, int& exit_code) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Render frames to EXR");
    declare_options(*command, *options);
    command->footer(kRenderFooter);
    command->callback([options, command, &exit_code] {
        refuse_empty_values(*command);
        exit_code = render(*options);
    });
    return options;
}

}  // namespace penumbra::cli
