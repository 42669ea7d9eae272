// SPDX-License-Identifier: Apache-2.0
#include "render_loop.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "gpu/egl_context.h"
#include "scene_messages.h"

namespace raybundle {

namespace {

constexpr int encoder_threads = 1;
constexpr double solution_interval_s = 0.25;
constexpr double rate_interval_s = 1.0;
constexpr std::size_t max_pending_requests = 64;  // of one object; older ones are answered at once
constexpr std::chrono::milliseconds idle_wait(50);
constexpr const char* no_memory = "the server has no memory for a picture of this size";
constexpr std::uint32_t max_width = 3840;
constexpr std::uint32_t max_height = 2160;

double seconds(std::chrono::steady_clock::duration d) {
    return std::chrono::duration<double>(d).count();
}

v1::ServerMessage ok() {
    v1::ServerMessage message;
    message.mutable_ok();
    return message;
}

}  // namespace

RenderLoop::RenderLoop(Scene scene, const PatchMesh& mesh, const RenderLoopSettings& settings,
                       Server& server)
    : scene_(std::move(scene)),
      settings_(settings),
      server_(server),
      solver_(scene_, mesh, settings.solver),
      programs_(solver_.scene()),
      encoder_(encoder_threads, [this](const EncodedFrame& frame) {
          ++metric_frames_;
          metric_bytes_ += frame.bytes.size();
          server_.send_frame(frame.viewer, frame.header, frame.bytes);
          server_.inbox().interrupt();
      }) {}

void RenderLoop::run(const std::atomic<bool>& stop) {
    rate_since_ = Clock::now();
    while (!stop) {
        for (const ClientEvent& event : server_.inbox().drain()) {
            handle(event);
        }
        start_pending_move();
        const bool sent = send_frames();
        send_solutions();
        const bool solved = solve();
        if (!sent && !solved) {
            server_.inbox().wait_for(idle_wait);
        }
    }
}

void RenderLoop::handle(const ClientEvent& event) {
    if (event.kind == ClientEvent::Kind::joined) {
        join(event);
        return;
    }
    const auto found = sessions_.find(event.viewer);
    if (found == sessions_.end()) {
        return;
    }
    if (event.kind == ClientEvent::Kind::left) {
        encoder_.forget(event.viewer);
        sessions_.erase(found);
        refresh_receivers();
        return;
    }
    handle_message(*found->second, event);
}

void RenderLoop::join(const ClientEvent& event) {
    const v1::Hello& hello = event.message.hello();
    try {
        sessions_[event.viewer] =
            std::make_unique<ViewerSession>(event.viewer, hello, solver_.scene(), solver_.store(),
                                            programs_, scene_.cameras.front());
    } catch (const GpuError& error) {
        sessions_.erase(event.viewer);
        spdlog::error("no picture for viewer {}: {}", event.viewer, error.what());
        server_.disconnect(event.viewer, v1::Error::RESOURCE_EXHAUSTED, no_memory);
        return;
    }
    refresh_receivers();
    v1::ServerMessage message;
    v1::Welcome* welcome = message.mutable_welcome();
    welcome->set_protocol("1.0");
    welcome->set_server("raybundle " RAYBUNDLE_VERSION);
    welcome->set_viewer(event.viewer);
    welcome->set_role(event.role);
    welcome->set_epoch(epoch_);
    describe_scene(scene_, welcome->mutable_scene());
    welcome->mutable_limits()->set_max_width(max_width);
    welcome->mutable_limits()->set_max_height(max_height);
    welcome->mutable_limits()->set_max_message_bytes(65536);
    server_.reply(event, message);
    if (!event.message.has_id()) {
        server_.send(event.viewer, message);
    }
    spdlog::info("viewer {} '{}' joined", event.viewer, hello.name());
}

void RenderLoop::refresh_receivers() {
    receivers_.clear();
    for (const auto& [id, session] : sessions_) {
        receivers_.push_back(&session->image());
    }
    metric_viewers_ = static_cast<std::uint32_t>(sessions_.size());
}

void RenderLoop::handle_message(ViewerSession& session, const ClientEvent& event) {
    const v1::ClientMessage& message = event.message;
    try {
        switch (message.body_case()) {
            case v1::ClientMessage::kSetCamera:
                session.set_camera(message.set_camera(), message.id());
                break;
            case v1::ClientMessage::kSetViewport:
                session.set_viewport(
                    {message.set_viewport().width(), message.set_viewport().height()});
                break;
            case v1::ClientMessage::kSetDisplay:
                session.set_display(message.set_display());
                break;
            case v1::ClientMessage::kSetTarget:
                session.set_target(message.set_target());
                break;
            case v1::ClientMessage::kMoveObject:
                queue_move(event);
                return;  // answered when the move is applied
            case v1::ClientMessage::kProbe:
                answer_probe(session, event);
                return;
            default:
                server_.reply_error(event, v1::Error::UNIMPLEMENTED,
                                    "this version of the server does not support this message");
                return;
        }
    } catch (const GpuError& error) {
        spdlog::error("viewer {}: {}", event.viewer, error.what());
        server_.reply_error(event, v1::Error::RESOURCE_EXHAUSTED, no_memory);
        return;
    }
    server_.reply(event, ok());
}

void RenderLoop::queue_move(const ClientEvent& event) {
    const std::uint32_t id = event.message.move_object().object();
    const bool known = id >= 1 && id <= scene_.objects.size();
    if (!known || !scene_.objects[id - 1].movable) {
        server_.reply_error(event, known ? v1::Error::INVALID_ARGUMENT : v1::Error::NOT_FOUND,
                            "moveObject.object: no movable object " + std::to_string(id));
        return;
    }
    // The newest place of an object wins; it keeps its turn among the objects.
    for (PendingMove& pending : pending_moves_) {
        if (pending.object == id - 1 && pending.requests.size() < max_pending_requests) {
            pending.requests.push_back(event);
            return;
        }
    }
    pending_moves_.push_back({id - 1, {event}});
}

void RenderLoop::start_pending_move() {
    if (pending_moves_.empty() || solver_.correcting()) {
        return;
    }
    const PendingMove pending = std::move(pending_moves_.front());
    pending_moves_.pop_front();
    Object& object = scene_.objects[pending.object];
    const v1::MoveObject& move = pending.requests.back().message.move_object();
    object.transform = from_message(move.transform());
    solver_.move_object(pending.object, object.world_from_object(), receivers_);
    iterations_at_change_ = solver_.iterations();
    ++epoch_;
    v1::ServerMessage message;
    message.mutable_scene_changed()->set_epoch(epoch_);
    message.mutable_scene_changed()->set_by(pending.requests.back().viewer);
    *message.mutable_scene_changed()->mutable_move_object() = move;
    for (const ClientEvent& request : pending.requests) {
        server_.reply(request, message);
    }
    server_.broadcast(message, pending.requests.back().viewer);
    for (const auto& [id, session] : sessions_) {
        session->note_change();
    }
}

void RenderLoop::answer_probe(ViewerSession& session, const ClientEvent& event) {
    const v1::Probe& probe = event.message.probe();
    if (!probe.has_pixel()) {
        server_.reply_error(event, v1::Error::UNIMPLEMENTED,
                            "probe.ray: only pixels can be probed");
        return;
    }
    const glm::uvec2 size = session.image().size();
    const glm::vec2 pixel(probe.pixel().x(), probe.pixel().y());
    if (!(pixel.x >= 0.0F && pixel.y >= 0.0F && pixel.x < static_cast<float>(size.x) &&
          pixel.y < static_cast<float>(size.y))) {
        server_.reply_error(event, v1::Error::INVALID_ARGUMENT, "probe.pixel: outside the picture");
        return;
    }
    const std::optional<PixelProbe> hit = session.image().probe(glm::uvec2(pixel));
    v1::ServerMessage message;
    v1::ProbeResult* result = message.mutable_probe_result();
    result->set_hit(hit.has_value());
    result->set_epoch(epoch_);
    if (hit) {
        to_message(hit->position, result->mutable_position());
        to_message(hit->normal, result->mutable_normal());
        result->set_object(scene_.objects[hit->object].id);
        result->set_patch(hit->patch);
        result->set_illuminance(luminance(hit->irradiance));
        result->set_luminance(luminance(hit->radiance));
        if (hit->relative_error) {
            result->set_relative_error(static_cast<float>(*hit->relative_error));
        }
    }
    server_.reply(event, message);
}

v1::FrameHeader RenderLoop::figures() const {
    v1::FrameHeader header;
    header.set_epoch(epoch_);
    header.set_iterations(static_cast<std::uint32_t>(solver_.iterations()));
    header.set_settled(static_cast<float>(solver_.statistics().settled));
    return header;
}

/// Sends finished frames to the encoder and renders due ones. True if anything was done.
bool RenderLoop::send_frames() {
    bool worked = false;
    const auto now = Clock::now();
    for (const auto& [id, session] : sessions_) {
        if (session->frame_finished()) {
            auto [header, pixels] = session->take_frame();
            encoder_.submit({id, header, {pixels.begin(), pixels.end()}, false});
            worked = true;
        }
        // While a change is being worked in, the picture is between two states: finish first.
        if (solver_.correcting() || !session->due(now) || encoder_.busy(id)) {
            continue;
        }
        const FrameAdvice advice = server_.advise(id, session->demand(now));
        if (advice.send) {
            session->render(advice, figures(), now);
            worked = true;
        }
    }
    return worked;
}

void RenderLoop::send_solutions() {
    const auto now = Clock::now();
    update_rate(now);
    if (seconds(now - last_solution_) < solution_interval_s) {
        return;
    }
    last_solution_ = now;
    for (const auto& [id, session] : sessions_) {
        v1::ServerMessage message;
        v1::Solution* solution = message.mutable_solution();
        solution->set_epoch(epoch_);
        solution->set_iterations(static_cast<std::uint32_t>(solver_.iterations()));
        solution->set_iterations_per_second(static_cast<float>(iterations_per_second_));
        solution->set_settled(static_cast<float>(solver_.statistics().settled));
        session->fill_solution(solution);
        server_.send(id, message);
    }
}

void RenderLoop::update_rate(Clock::time_point now) {
    const double elapsed = seconds(now - rate_since_);
    if (elapsed < rate_interval_s) {
        return;
    }
    iterations_per_second_ = static_cast<double>(solver_.iterations() - rate_iterations_) / elapsed;
    rate_iterations_ = solver_.iterations();
    rate_since_ = now;
    metric_rate_ = iterations_per_second_;
    metric_settled_ = solver_.statistics().settled;
    metric_iterations_ = solver_.iterations();
    metric_epoch_ = epoch_;
    metric_non_finite_ = solver_.non_finite();
}

bool RenderLoop::idle() const {
    if (solver_.correcting()) {
        return false;
    }
    if (sessions_.empty()) {
        return solver_.iterations() - iterations_at_change_ >= settings_.idle_iterations;
    }
    return std::all_of(sessions_.begin(), sessions_.end(), [](const auto& entry) {
        return entry.second->has_target() && entry.second->target_met();
    });
}

bool RenderLoop::solve() {
    if (idle()) {
        return false;
    }
    solver_.step(receivers_);
    server_.set_ready(true);
    const auto now = Clock::now();
    for (const auto& [id, session] : sessions_) {
        session->refresh_statistics(now);
    }
    return true;
}

std::string RenderLoop::metrics() const {
    std::string text;
    const auto add = [&text](const char* name, const char* type, const char* help, double value) {
        text += std::string("# HELP ") + name + " " + help + "\n# TYPE " + name + " " + type +
                "\n" + name + " " + std::to_string(value) + "\n";
    };
    add("raybundle_iterations_total", "counter", "Solver iterations since loading",
        static_cast<double>(metric_iterations_));
    add("raybundle_iterations_per_second", "gauge", "Solver iterations per second", metric_rate_);
    add("raybundle_settled", "gauge", "Part of the last change already worked in, 0..1",
        metric_settled_);
    add("raybundle_epoch", "gauge", "Scene changes applied", metric_epoch_);
    add("raybundle_rendered_viewers", "gauge", "Viewers with a picture", metric_viewers_);
    add("raybundle_frames_total", "counter", "Frames encoded", static_cast<double>(metric_frames_));
    add("raybundle_frame_bytes_total", "counter", "Bytes of encoded frames",
        static_cast<double>(metric_bytes_));
    add("raybundle_non_finite_total", "counter", "Contributions dropped because not finite",
        static_cast<double>(metric_non_finite_));
    return text;
}

}  // namespace raybundle
