// SPDX-License-Identifier: Apache-2.0
#include "session/loop_metrics.h"

#include <limits>

#include "net/http/metrics_text.h"

namespace raybundle {

namespace {

void write_exchange(MetricsText& out, const ExchangeFigures& e) {
    const auto count = [&out](const char* name, const char* help, std::uint64_t value) {
        out.counter(name, help, static_cast<double>(value));
    };
    out.gauge("raybundle_merged_workers", "Other workers whose light is merged", e.workers);
    out.gauge("raybundle_exchange_working", "0 while light cannot be shared with other workers",
              e.working ? 1.0 : 0.0);
    count("raybundle_exchange_sent_total", "Estimates of light that were sent", e.published);
    count("raybundle_exchange_received_total", "Estimates of other workers that were merged",
          e.received);
    count("raybundle_exchange_refused_total", "Workers whose estimates were refused, each once",
          e.refused);
    count("raybundle_exchange_sent_bytes_total", "Bytes of estimates sent", e.bytes_sent);
    count("raybundle_exchange_received_bytes_total", "Bytes of estimates received",
          e.bytes_received);
}

}  // namespace

void LoopMetrics::count_frame(std::size_t bytes) {
    ++frames_;
    frame_bytes_ += bytes;
}

void LoopMetrics::note_step(std::optional<Strategy> strategy, double milliseconds) {
    const std::lock_guard lock(mutex_);
    Steps& steps = !strategy                            ? special_
                   : *strategy == Strategy::perspective ? perspective_
                   : *strategy == Strategy::opening     ? opening_
                                                        : layered_;
    ++steps.count;
    steps.seconds += milliseconds / 1000.0;
}

void LoopMetrics::publish(const LoopFigures& figures, TimePoint now) {
    const std::lock_guard lock(mutex_);
    const double elapsed = seconds(now - published_);
    const std::uint64_t frames = frames_;
    if (elapsed > 0.0) {
        frames_per_second_ = static_cast<double>(frames - frames_before_) / elapsed;
    }
    frames_before_ = frames;
    published_ = now;
    figures_ = figures;
}

std::string LoopMetrics::text() const {
    const std::lock_guard lock(mutex_);
    const LoopFigures& f = figures_;
    MetricsText out;
    out.counter("raybundle_iterations_total", "Solver iterations since loading",
                static_cast<double>(f.iterations));
    out.gauge("raybundle_iterations_per_second", "Solver iterations per second",
              f.iterations_per_second);
    out.family("raybundle_iteration_seconds", "summary",
               "Time of the GL thread in one step of the solver");
    for (const auto& [name, steps] :
         {std::pair("perspective", perspective_), std::pair("layered", layered_),
          std::pair("opening", opening_), std::pair("special", special_)}) {
        const std::string label = "strategy=\"" + std::string(name) + "\"";
        out.sample("raybundle_iteration_seconds_sum", label, steps.seconds);
        out.sample("raybundle_iteration_seconds_count", label, static_cast<double>(steps.count));
    }
    out.counter("raybundle_special_phases_total",
                "Special iteration phases: changes that waited together pass one",
                static_cast<double>(phases_));
    out.counter("raybundle_loop_turns_total",
                "Turns of the render loop: 20 a second while it has nothing to do",
                static_cast<double>(turns_));
    out.gauge("raybundle_settled", "Part of the last change already worked in, 0 to 1", f.settled);
    out.gauge("raybundle_relative_error", "Largest estimated relative error of a viewer's picture",
              f.relative_error.value_or(std::numeric_limits<double>::quiet_NaN()));
    out.gauge("raybundle_epoch", "Scene changes applied", f.epoch);
    out.gauge("raybundle_rendered_viewers", "Viewers with a picture", f.viewers);
    out.gauge("raybundle_moving_viewers", "Viewers whose picture moves", f.moving);
    out.gauge("raybundle_paused_viewers", "Viewers that acknowledge nothing", f.paused);
    out.counter("raybundle_viewers_refused_total", "Viewers refused because time is short",
                static_cast<double>(refused_));
    out.gauge("raybundle_frames_per_second", "Frames encoded per second, all viewers",
              frames_per_second_);
    out.counter("raybundle_frames_total", "Frames encoded", static_cast<double>(frames_));
    out.counter("raybundle_frame_bytes_total", "Bytes of encoded frames",
                static_cast<double>(frame_bytes_));
    out.gauge("raybundle_video_encoders", "Viewers whose moving picture is sent as video",
              static_cast<double>(video_encoders_));
    out.gauge("raybundle_video_memory_bytes", "Memory of the encoders of video, estimated",
              static_cast<double>(video_bytes_));
    out.gauge("raybundle_light_viewers", "Viewers that get light to draw by themselves",
              static_cast<double>(light_viewers_));
    out.counter("raybundle_light_messages_total", "Messages of light",
                static_cast<double>(light_messages_));
    out.counter("raybundle_light_bytes_total", "Bytes of light", static_cast<double>(light_bytes_));
    out.counter("raybundle_non_finite_total", "Contributions dropped because not finite",
                static_cast<double>(f.non_finite));
    out.gauge("raybundle_gl_memory_bytes", "OpenGL buffers and textures",
              static_cast<double>(f.gl_bytes));
    out.counter("raybundle_journal_failures_total", "Changes refused because not saved",
                static_cast<double>(f.journal_failures));
    out.gauge("raybundle_journal_working", "0 after a change could not be saved",
              f.journal_working ? 1.0 : 0.0);
    if (f.exchange) {
        write_exchange(out, *f.exchange);
    }
    return out.text();
}

}  // namespace raybundle
