// SPDX-License-Identifier: Apache-2.0
#include "session/render_loop.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "gpu/context_loss.h"
#include "gpu/egl_context.h"
#include "scheduling/elapsed.h"
#include "session/scene_messages.h"
#include "session/viewers/picture_refusal.h"

namespace raybundle {

namespace {

constexpr int encoder_threads = 1;
constexpr double solution_interval_s = 0.25;
/// Of the time: of first frames while others move, for those who answer and those who do not; of
/// statistics. In ms: what each may take at once.
constexpr double greeting_share = 0.1;
constexpr double silent_greeting_share = 0.03;
constexpr double greeting_burst_ms = 250.0;
constexpr double statistics_share = 0.1;
constexpr double statistics_burst_ms = 20.0;
constexpr double solver_burst_ms = 50.0;
constexpr double rate_interval_s = 1.0;
constexpr std::chrono::milliseconds idle_wait(50);
/// llvmpipe compiles a shader again for textures whose sizes are powers of two, and for buffer
/// textures whose size in bytes is a multiple of 65 536 (Mesa 22.3 takes a part of it for a number
/// of levels): 800x800 is drawn as 24x24 is, 640x480 as 192x192, 512x512 as 64x64. The first time
/// not everything is there that is looked up later.
constexpr glm::uvec2 rehearsal_sizes[] = {{24, 24}, {24, 24}, {192, 192}, {64, 64}};

}  // namespace

RenderLoop::RenderLoop(Scene scene, PatchMesh mesh, const RenderLoopSettings& settings,
                       Server& server, ChangeLog& log)
    : scene_(std::move(scene)),
      mesh_(std::move(mesh)),
      settings_(settings),
      server_(server),
      log_(log),
      solver_(std::make_unique<Solver>(scene_, mesh_, settings.solver)),
      programs_(std::make_unique<ViewPrograms>(solver_->scene())),
      greeting_(greeting_share, greeting_burst_ms),
      silent_greeting_(silent_greeting_share, greeting_burst_ms),
      statistics_(statistics_share, statistics_burst_ms),
      solving_(1.0, solver_burst_ms),
      encoder_(encoder_threads,
               [this](const EncodedFrame& frame) {
                   metrics_.count_frame(frame.bytes.size());
                   server_.send_frame(frame.viewer, frame.header, frame.bytes);
                   server_.inbox().interrupt();
               }),
      review_(log, solver_->scene().side_count()),
      targets_(log),
      snapshots_(server, [this](std::uint32_t epoch) { return earlier_scene(epoch); }) {
    epoch_ = log_.epoch();
}

void RenderLoop::run(const std::atomic<bool>& stop) {
    rate_since_ = Clock::now();
    bool idle = true;
    while (!stop) {
        metrics_.count_turn();
        process_inbox(idle);
        start_pending_change();
        const bool collected = collect_frames();
        const bool sent = send_frames() || collected;
        if (sent) {
            collect_frames();  // a software renderer is done already: no iteration comes between
        }
        send_solutions();
        send_presence(Clock::now());
        check_pictures(Clock::now());
        const bool smoothed = smooth_pictures();
        const bool solved = solve();
        idle = !sent && !smoothed && !solved;
        if (idle) {
            server_.inbox().wait_for(idle_wait);
        }
    }
}

void RenderLoop::rehearse(const std::atomic<bool>& stop) {
    if (settings_.rehearse && sessions_.empty() && solver_->iterations() == 0) {
        for (const glm::uvec2& size : rehearsal_sizes) {
            rehearse_at(size, stop);
        }
    }
}

/// Software drivers compile shaders when they are first used, each for some tenths of a second: a
/// small picture goes through all that a viewer's does. Its iterations count as any others.
void RenderLoop::rehearse_at(const glm::uvec2& size, const std::atomic<bool>& stop) {
    if (stop) {
        return;
    }
    ViewerImage image(solver_->scene(), solver_->store(), *programs_, size);
    image.set_camera(scene_.cameras.front());
    image.rest();
    BundleReceiver* const receivers[] = {&image};
    do {
        solver_->step(receivers);
    } while (!solver_->between_groups() && !stop);
    if (stop) {
        return;
    }
    image.set_camera(scene_.cameras.front());
    image.request_statistics();
    image.smooth();
    image.compose(DisplayMode::photo, 0.0F);
    image.take();
    const auto movable = std::find_if(scene_.objects.begin(), scene_.objects.end(),
                                      [](const Object& object) { return object.movable; });
    if (movable != scene_.objects.end()) {
        solver_->rehearse_move(static_cast<std::uint32_t>(movable - scene_.objects.begin()),
                               movable->world_from_object(), receivers);
    }
}

void RenderLoop::refuse_waiting() {
    snapshots_.refuse_all();
    std::vector<ClientEvent> waiting = server_.inbox().drain();
    const std::vector<ClientEvent> changes = changes_.take_requests();
    waiting.insert(waiting.end(), changes.begin(), changes.end());
    for (const ClientEvent& event : waiting) {
        if (event.kind == ClientEvent::Kind::message) {
            server_.reply_error(event, v1::Error::INTERNAL, "the server is stopping");
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
        scheduler_.forget(event.viewer);
        requests_.forget(event.viewer);
        gate_.excuse(event.viewer);
        std::erase(receivers_, snapshots_.picture_of(event.viewer));
        snapshots_.forget(event.viewer);
        drop_image(*found->second);
        first_look_of_ = first_look_of_ == event.viewer ? 0 : first_look_of_;
        sessions_.erase(found);
        forget_leader(event.viewer);
        return;
    }
    const auto start = Clock::now();
    handle_message(*found->second, event);
    const double cost_ms = milliseconds_since(start);
    scheduler_.charge_besides(event.viewer, cost_ms);
    requests_.charge(event.viewer, cost_ms, sessions_.size());
}

void RenderLoop::join(const ClientEvent& event) {
    v1::Hello hello = event.message.hello();
    const glm::uvec2 size = served_size(ViewerSession::size_of(hello), nullptr);
    to_message(size, hello.mutable_viewport());
    if (const std::string reason = no_room_for(size, nullptr); !reason.empty()) {
        metrics_.count_refused_viewer();
        server_.reply_error(event, v1::Error::RESOURCE_EXHAUSTED, reason);
        server_.close(event.viewer, CloseCode::try_again_later, reason);
        return;
    }
    sessions_[event.viewer] =
        std::make_unique<ViewerSession>(event.viewer, hello, scene_.cameras.front());
    if (const v1::SetTarget* const target = targets_.of(hello.name())) {
        sessions_[event.viewer]->set_target(*target);
    }
    v1::ServerMessage message;
    v1::Welcome* welcome = message.mutable_welcome();
    welcome->set_protocol("1.0");
    welcome->set_server("raybundle " RAYBUNDLE_VERSION);
    welcome->set_viewer(event.viewer);
    welcome->set_role(event.role);
    welcome->set_epoch(epoch_);
    describe_scene(scene_, welcome->mutable_scene());
    fill_limits(welcome->mutable_limits());
    to_message(size, welcome->mutable_viewport());
    welcome->set_renderer(settings_.renderer);
    welcome->set_software_rendering(settings_.software_rendering);
    welcome->set_can_open_scenes(static_cast<bool>(settings_.scene_requests));
    welcome->set_saving(log_.saving());
    welcome->set_name(hello.name());
    review_.fill_welcome(welcome);
    sessions_[event.viewer]->set_role(event.role);
    presence_changed_ = true;
    server_.reply(event, message);
    if (!event.message.has_id()) {
        server_.send(event.viewer, message);
    }
    spdlog::info("viewer {} '{}' joined", event.viewer, hello.name());
}

void RenderLoop::handle_message(ViewerSession& session, const ClientEvent& event) {
    const v1::ClientMessage& message = event.message;
    try {
        switch (message.body_case()) {
            case v1::ClientMessage::kSetCamera:
                session.follow(0);
                session.set_camera(message.set_camera(), message.id());
                lead(session);
                break;
            case v1::ClientMessage::kSetViewport:
                set_viewport(session, event);
                return;
            case v1::ClientMessage::kSetDisplay:
                session.set_display(message.set_display());
                break;
            case v1::ClientMessage::kSetDepths:
                session.set_depths(message.set_depths().columns());
                break;
            case v1::ClientMessage::kSetHidden:
                if (!set_hidden(session, event)) {
                    return;
                }
                break;
            case v1::ClientMessage::kGetWalkMap:
                walk_maps_.ask(event, epoch_);
                return;
            case v1::ClientMessage::kSetTarget:
                if (!set_target(session, event)) {
                    return;
                }
                break;
            case v1::ClientMessage::kMoveObject:
            case v1::ClientMessage::kSetLight:
            case v1::ClientMessage::kSetMaterial:
            case v1::ClientMessage::kUndo:
                queue_change(event);
                return;  // answered when the change is made
            case v1::ClientMessage::kProbe:
                answer_probe(session, event);
                return;
            case v1::ClientMessage::kSnapshot:
                add_snapshot(session, event);
                return;  // answered when it is done
            case v1::ClientMessage::kCancelSnapshot:
                cancel_snapshot(event);
                return;
            case v1::ClientMessage::kListScenes:
            case v1::ClientMessage::kOpenScene:
                request_scenes(session, event);
                return;
            case v1::ClientMessage::kMeasureEffects:
                request_effects(event);
                return;
            default:
                if (handle_review(session, event)) {
                    return;
                }
                server_.reply_error(event, v1::Error::UNIMPLEMENTED,
                                    "this version of the server does not support this message");
                return;
        }
    } catch (const GpuError& error) {
        spdlog::error("viewer {}: {}", event.viewer, error.what());
        drop_image(session);
        const Refusal refusal = refusal_of(error);
        server_.reply_error(event, refusal.code, refusal.text);
        return;
    }
    server_.reply_ok(event);
}

v1::FrameHeader RenderLoop::figures() const {
    v1::FrameHeader header;
    header.set_epoch(epoch_);
    header.set_iterations(static_cast<std::uint32_t>(solver_->iterations()));
    header.set_settled(static_cast<float>(solver_->statistics().settled));
    return header;
}

void RenderLoop::send_solutions() {
    const auto now = Clock::now();
    update_rate(now);
    if (seconds(now - last_solution_) < solution_interval_s) {
        return;
    }
    last_solution_ = now;
    check_pin();
    snapshots_.report();
    for (const auto& [id, session] : sessions_) {
        v1::ServerMessage message;
        v1::Solution* solution = message.mutable_solution();
        solution->set_epoch(epoch_);
        solution->set_iterations(static_cast<std::uint32_t>(solver_->iterations()));
        solution->set_iterations_per_second(static_cast<float>(iterations_per_second_));
        solution->set_settled(static_cast<float>(solver_->statistics().settled));
        solution->set_saving(log_.saving());
        session->fill_solution(solution);
        server_.send(id, message);
    }
}

void RenderLoop::update_rate(Clock::time_point now) {
    const double elapsed = seconds(now - rate_since_);
    if (elapsed < rate_interval_s) {
        return;
    }
    check_context();
    iterations_per_second_ =
        static_cast<double>(solver_->iterations() - rate_iterations_) / elapsed;
    rate_iterations_ = solver_->iterations();
    rate_since_ = now;
    publish_figures(now);
}

/// Whether nobody who watches wants more iterations.
bool RenderLoop::nobody_waits() const {
    const auto content = [](const auto& entry) {
        const auto& session = entry.second;
        return session->paused() || (session->has_target() && session->target_met());
    };
    const auto paused = [](const auto& entry) { return entry.second->paused(); };
    if (std::all_of(sessions_.begin(), sessions_.end(), paused)) {
        return solver_->iterations() - iterations_at_change_ >= settings_.idle_iterations;
    }
    return std::all_of(sessions_.begin(), sessions_.end(), content);
}

bool RenderLoop::solve() {
    if (!solver_->correcting() && nobody_waits() && !snapshots_.waiting()) {
        return false;
    }
    if (!solver_may_run()) {
        return false;  // the encoder and the viewers can use the time
    }
    if (settings_.lost_after_change != 0 && iterations_at_change_ != 0 &&
        solver_->iterations() >= iterations_at_change_ + settings_.lost_after_change) {
        throw GpuError("lost as a test wants it");
    }
    choose_receivers();
    if (snapshots_.apart() && nobody_waits() && !solver_->correcting() &&
        solver_->between_groups()) {
        return true;  // all the time goes into the picture of an earlier scene
    }
    const auto start = Clock::now();
    solver_->step(receivers_);
    const double cost = milliseconds_since(start);
    last_step_ms_ = cost;
    if (!solver_->last_strategy()) {
        phase_budget_.note_bundle(Server::now_ms(), !solver_->correcting());
        note_phase_end();
        gate_.note_change(cost);
        end_change();
    }
    if (walking(Clock::now())) {
        solving_.charge(cost);
    }
    metrics_.note_step(solver_->last_strategy(), cost);
    if (solver_->last_strategy()) {
        gate_.note_iteration(cost);
        cost_.note_iteration(cost, receiver_pixels_);
        snapshots_.note_iteration(cost);
    }
    server_.set_ready(true);
    refresh_statistics(Clock::now());
    return true;
}

std::string RenderLoop::metrics() const {
    return metrics_.text();
}

}  // namespace raybundle
