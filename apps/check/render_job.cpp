#include "apps/check/render_job.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/error.h"

namespace penumbra::check {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestLog = 16384;

std::vector<std::string> render_command(const Check& check, const CheckSettings& settings,
                                        const RenderSettings& how, const fs::path& stem) {
    RenderValues values = settings.render;
    for (const auto& [option, value] : how.overrides) values[option] = value;
    std::string scene = (settings.scene.empty() ? check.scene : settings.scene).string();
    if (scene.starts_with('-')) scene.insert(0, "./");  // a file, not an option
    std::vector<std::string> command{how.program.string(),
                                     "render",
                                     scene,
                                     fmt::format("--output={}.####.exr", stem.string()),
                                     "--progress=none",
                                     fmt::format("--threads={}", how.threads)};
    for (const RenderOption& option : how.options) {
        const auto value = values.find(option.name);
        if (value == values.end()) continue;
        command.push_back(option.is_flag ? fmt::format("--{}", option.name)
                                         : fmt::format("--{}={}", option.name, value->second));
    }
    return command;
}

// "--spp" -> "shot.check.json: render.spp"
std::map<std::string, std::string> places_of_options(const Check& check,
                                                     const CheckSettings& settings,
                                                     const RenderSettings& how) {
    std::map<std::string, std::string> places;
    for (const auto& [option, value] : settings.render)
        if (!how.overrides.contains(option))
            places["--" + option] = fmt::format("{}: render.{}", check.settings.string(), option);
    return places;
}

// Pictures of this stem in its folder, by frame.
std::vector<RenderedFrame> find_frames(const fs::path& stem) {
    const std::string before = stem.filename().string() + ".";
    constexpr std::string_view kAfter = ".exr";
    std::vector<RenderedFrame> frames;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(stem.parent_path(), ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.size() <= before.size() + kAfter.size() || !name.starts_with(before) ||
            !name.ends_with(kAfter))
            continue;
        const std::string number =
            name.substr(before.size(), name.size() - before.size() - kAfter.size());
        if (is_frame_number(number)) frames.push_back({number, entry.path()});
    }
    const auto value = [](const std::string& text) {
        long long number = 0;
        std::from_chars(text.data(), text.data() + text.size(), number);
        return number;
    };
    std::sort(frames.begin(), frames.end(), [&](const RenderedFrame& a, const RenderedFrame& b) {
        return value(a.number) < value(b.number);
    });
    return frames;
}

const fs::path& made_ready(const fs::path& stem) {
    std::error_code error;
    fs::create_directories(stem.parent_path(), error);
    if (error) throw OutputError(stem.parent_path(), error.message());
    for (const RenderedFrame& stale : find_frames(stem)) fs::remove(stale.file, error);
    return stem;
}

std::string read_log(const fs::path& file) {
    std::ifstream stream(file);
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (text.size() > kLongestLog) text = "...\n" + text.substr(text.size() - kLongestLog);
    return text;
}

// The messages of the lines "error: ...", joined; the last line where there is none.
std::string message_of(std::string_view log) {
    constexpr std::string_view kError = "error: ";
    std::string message, last;
    while (!log.empty()) {
        const std::string_view line = log.substr(0, log.find('\n'));
        log.remove_prefix(std::min(log.size(), line.size() + 1));
        if (!line.empty()) last = line;
        if (line.starts_with(kError))
            message += (message.empty() ? "" : "; ") + std::string(line.substr(kError.size()));
    }
    return !message.empty() ? message : !last.empty() ? last : "without a message";
}

}  // namespace

RenderJob::RenderJob(const Check& check, const CheckSettings& settings, const RenderSettings& how,
                     fs::path stem)
    : stem_(std::move(stem)),
      places_(places_of_options(check, settings, how)),
      command_(render_command(check, settings, how, made_ready(stem_))),
      timeout_seconds_(how.timeout_seconds),
      process_(command_, log_file()) {}

fs::path RenderJob::log_file() const {
    return stem_.string() + ".log";
}

bool RenderJob::poll() {
    const auto ending = process_.poll();
    seconds_ = watch_.seconds();
    if (ending) {
        ending_ = *ending;
        log_ = read_log(log_file());
        return true;
    }
    if (seconds_ > timeout_seconds_ && !is_timed_out_) {
        is_timed_out_ = true;
        process_.kill();
    }
    return false;
}

// What the renderer says of an option is about a value in a file.
std::string RenderJob::message() const {
    const std::string said = message_of(log_);
    const auto place = places_.find(said.substr(0, said.find(':')));
    return place == places_.end() ? said : place->second + said.substr(place->first.size());
}

std::optional<Error> RenderJob::error() const {
    if (is_timed_out_)
        return Error{ErrorKind::kTimeout,
                     fmt::format("rendering took longer than {:g} s", timeout_seconds_)};
    if (ending_.signal == SIGKILL)
        return Error{ErrorKind::kCrash,
                     "the renderer was killed (SIGKILL): most often there was not enough memory, "
                     "try fewer --jobs"};
    if (ending_.signal != 0)
        return Error{ErrorKind::kCrash, fmt::format("the renderer crashed (signal {}: {})",
                                                    ending_.signal, strsignal(ending_.signal))};
    if (ending_.exit_code == 0) return std::nullopt;
    if (ending_.exit_code == 2) return Error{ErrorKind::kScene, message()};
    if (ending_.exit_code == 3) return Error{ErrorKind::kRender, message()};
    return Error{ErrorKind::kCrash, fmt::format("the renderer ended with exit code {}: {}",
                                                ending_.exit_code, message())};
}

void RenderJob::describe(CheckOutcome& outcome) const {
    outcome.command = command_;
    outcome.seconds = seconds_;
    outcome.log = log_;
    outcome.error = error();
    if (!outcome.error && frames().empty())
        outcome.error = Error{ErrorKind::kRender, "the renderer wrote no picture"};
}

std::vector<RenderedFrame> RenderJob::frames() const {
    return find_frames(stem_);
}

}  // namespace penumbra::check
