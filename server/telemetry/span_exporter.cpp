// SPDX-License-Identifier: Apache-2.0
#include "telemetry/span_exporter.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>
#include <iterator>
#include <utility>

namespace raybundle {
namespace {

/// What OTLP says to try again: https://opentelemetry.io/docs/specs/otlp/#retryable-response-codes.
bool may_pass(int status) {
    return status == 0 || status == 429 || status == 502 || status == 503 || status == 504;
}

bool succeeded(int status) {
    return status >= 200 && status < 300;
}

}  // namespace

SpanExporter::SpanExporter(OtlpSettings settings)
    : settings_(std::move(settings)),
      post_(settings_.url, settings_.headers, settings_.ca_file),
      thread_([this] { run(); }) {
    spdlog::info("traces of changes go to {}", settings_.url.text());
}

void SpanExporter::stop() {
    {
        const std::lock_guard lock(mutex_);
        if (std::exchange(stopping_, true)) {
            return;
        }
        last_end_ = Clock::now() + last_time;
    }
    changed_.notify_all();
    thread_.join();
}

void SpanExporter::submit(std::vector<Span> spans) {
    {
        const std::lock_guard lock(mutex_);
        if (stopping_ || queue_.size() + spans.size() > max_queued) {
            dropped_ += spans.size();
            return;
        }
        queue_.insert(queue_.end(), std::make_move_iterator(spans.begin()),
                      std::make_move_iterator(spans.end()));
    }
    changed_.notify_all();
}

SpanExporter::Figures SpanExporter::figures() const {
    return {exported_, dropped_, failures_};
}

void SpanExporter::run() {
    sigset_t broken_pipe{};  // OpenSSL, under libcurl, writes without MSG_NOSIGNAL
    sigemptyset(&broken_pipe);
    sigaddset(&broken_pipe, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &broken_pipe, nullptr);
    for (;;) {
        const std::vector<Span> batch = take_batch();
        if (batch.empty()) {
            return;
        }
        deliver(batch);
    }
}

/// Waits for some. Empty: the program ends, and none is left.
std::vector<Span> SpanExporter::take_batch() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
    changed_.wait_for(lock, settings_.batch_time,
                      [this] { return stopping_ || queue_.size() >= max_batch; });
    const auto end = queue_.begin() +
                     static_cast<std::ptrdiff_t>(std::min<std::size_t>(queue_.size(), max_batch));
    std::vector<Span> batch(std::make_move_iterator(queue_.begin()), std::make_move_iterator(end));
    queue_.erase(queue_.begin(), end);
    return batch;
}

/// False: the program ends.
bool SpanExporter::rest(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return !changed_.wait_for(lock, time, [this] { return stopping_; });
}

SpanExporter::Clock::time_point SpanExporter::deadline(Clock::time_point begun) const {
    const std::lock_guard lock(mutex_);
    const Clock::time_point usual = begun + settings_.timeout;
    return stopping_ ? std::min(usual, last_end_) : usual;
}

void SpanExporter::deliver(const std::vector<Span>& batch) {
    const std::string message = otlp_message(settings_.source, batch);
    std::chrono::milliseconds pause = settings_.first_pause;
    for (int attempt = 1;; ++attempt, pause *= 2) {
        const auto begun = Clock::now();
        if (begun >= deadline(begun)) {
            dropped_ += batch.size();
            return;
        }
        const PostResult result =
            post_.send("application/x-protobuf", message, [&] { return deadline(begun); });
        if (succeeded(result.status)) {
            note_success(batch.size());
            return;
        }
        note_failure(result);
        if (!may_pass(result.status) || attempt == max_attempts || !rest(pause)) {
            dropped_ += batch.size();
            return;
        }
    }
}

/// A line where it begins to fail, and one where it ends.
void SpanExporter::note_failure(const PostResult& result) {
    ++failures_;
    if (!std::exchange(failing_, true)) {
        spdlog::warn(
            "traces do not reach {}: {}", settings_.url.text(),
            result.status == 0 ? result.problem : "status " + std::to_string(result.status));
    }
}

void SpanExporter::note_success(std::size_t spans) {
    exported_ += spans;
    if (std::exchange(failing_, false)) {
        spdlog::info("traces reach {} again", settings_.url.text());
    }
}

}  // namespace raybundle
