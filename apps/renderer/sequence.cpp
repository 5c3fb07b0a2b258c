#include "apps/renderer/sequence.h"

#include <array>
#include <exception>
#include <future>
#include <memory>
#include <new>

#include "apps/renderer/frame_file.h"
#include "apps/renderer/frame_list.h"
#include "apps/renderer/frame_plan.h"
#include "apps/renderer/renderer.h"
#include "apps/renderer/settings_digest.h"
#include "core/error.h"
#include "core/profile/stopwatch.h"

namespace penumbra::renderer {
namespace {

constexpr int kHistoryLength = 0;  // no pass reads another frame

// One frame on its way to the disk. Films alternate, so that the next frame renders meanwhile.
struct Writing {
    std::future<void> done;
    void wait() {
        if (done.valid()) done.get();
    }
};

class Sequence {
  public:
    Sequence(const Scene& scene, const ImageSettings& image, const ExecutionSettings& execution,
             const OutputSettings& output, const std::function<void(const FrameReport&)>& on_frame)
        : scene_(scene),
          image_(image),
          execution_(execution),
          output_(output),
          on_frame_(on_frame),
          settings_(describe_settings(completed(scene, image), execution, output)),
          digest_(settings_digest(scene, settings_)) {}

    SequenceReport run(const std::vector<int>& frames, const std::atomic<bool>& cancelled) {
        const profile::Stopwatch watch;
        const auto is_done_already = [&](int frame) { return !cancelled.load() && is_done(frame); };
        for (const PlannedFrame& planned :
             plan_frames(frames, kHistoryLength, scene_.animation, is_done_already)) {
            if (cancelled.load()) break;
            step(planned, cancelled);
        }
        writing_.wait();
        report_.interrupted = cancelled.load() && report_.frames.size() < frames.size();
        report_.wall_seconds = watch.seconds();
        return std::move(report_);
    }

  private:
    [[nodiscard]] bool is_done(int frame) const {
        return output_.resume && is_already_rendered(output_, frame, frame_digest(digest_, frame));
    }

    void step(const PlannedFrame& planned, const std::atomic<bool>& cancelled) {
        const int frame = planned.frame;
        FrameReport report{.frame = frame, .path = expand_pattern(output_.pattern, frame)};
        // Looked at again: others may have rendered it since the plan was made.
        if (planned.work == FrameWork::kSkip || is_done(frame)) {
            report.outcome = FrameOutcome::kSkipped;
            writing_.wait();
            finish(report);
            return;
        }
        // Made outside of what a frame may fail with: if it cannot be made, no frame can.
        if (!renderer_) renderer_ = std::make_unique<Renderer>(scene_, image_, execution_);
        const std::string error = capture([&] { render(frame, report, cancelled); });
        if (cancelled.load()) return;  // the film is unfinished
        writing_.wait();
        if (!error.empty()) {
            fail(report, error);
            return;
        }
        start_writing(report);
    }

    void render(int frame, FrameReport& report, const std::atomic<bool>& cancelled) {
        film_ = 1 - film_;
        report.statistics = renderer_->render(frame, output_.aovs, films_[film_], &cancelled);
    }

    void start_writing(const FrameReport& rendered) {
        const FrameIdentity identity{.frame = rendered.frame,
                                     .frames_per_second = scene_.animation.frames_per_second,
                                     .camera = renderer_->camera(),
                                     .digest = frame_digest(digest_, rendered.frame),
                                     .settings = settings_};
        writing_.done = std::async(std::launch::async, [this, identity, rendered, film = film_] {
            write(films_[film], identity, rendered);
        });
    }

    void write(const Film& film, const FrameIdentity& identity, FrameReport report) {
        const profile::Stopwatch watch;
        const std::string error = capture([&] {
            const image::ExrWriteReport written =
                write_frame(film, identity, output_, renderer_->threads());
            report.statistics.clamped_halves = written.clamped_values;
            report.statistics.non_finite_values = written.non_finite_values;
        });
        report.statistics.write_seconds = watch.seconds();
        if (error.empty())
            finish(report);
        else
            fail(report, error);
    }

    void fail(FrameReport report, const std::string& error) {
        report.outcome = FrameOutcome::kFailed;
        report.error = error;
        finish(report);
    }

    void finish(const FrameReport& report) {
        report_.frames.push_back(report);
        if (on_frame_) on_frame_(report);
    }

    // The message of what `body` throws, or nothing: one bad frame does not end the sequence.
    template <class Body>
    static std::string capture(const Body& body) {
        try {
            body();
            return "";
        } catch (const std::bad_alloc&) {
            return "out of memory";
        } catch (const std::exception& e) {
            return e.what();
        }
    }

    const Scene& scene_;
    const ImageSettings& image_;
    const ExecutionSettings& execution_;
    const OutputSettings& output_;
    const std::function<void(const FrameReport&)>& on_frame_;
    std::string settings_;
    std::string digest_;
    std::unique_ptr<Renderer> renderer_;
    std::array<Film, 2> films_;
    int film_ = 0;
    SequenceReport report_;
    Writing writing_;  // last: it is waited for before the rest goes
};

}  // namespace

SequenceReport render_sequence(const Scene& scene, const std::vector<int>& frames,
                               const ImageSettings& image, const ExecutionSettings& execution,
                               const OutputSettings& output,
                               const std::function<void(const FrameReport&)>& on_frame,
                               const std::atomic<bool>& cancelled) {
    check_settings(scene, image, execution);
    return Sequence(scene, image, execution, output, on_frame).run(frames, cancelled);
}

}  // namespace penumbra::renderer
