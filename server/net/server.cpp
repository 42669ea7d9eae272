// SPDX-License-Identifier: Apache-2.0
#include "net/server.h"

#include <utility>

#include "net/access/listen_address.h"
#include "net/access/tls_certificate.h"
#include "net/clock.h"
#include "net/network_state.h"
#include "net/network_thread.h"

namespace raybundle {

class Server::Impl {
  public:
    explicit Impl(ServerSettings settings) : state(std::move(settings)), network(state) {}

    NetworkState state;
    NetworkThread network;
};

Server::Server(ServerSettings settings) : impl_(std::make_unique<Impl>(std::move(settings))) {}

Server::~Server() = default;

void Server::start() {
    impl_->network.start();
}

void Server::stop() {
    impl_->network.stop();
}

std::uint16_t Server::port() const {
    return impl_->network.port();
}

std::string Server::address() const {
    const auto& settings = impl_->state.settings;
    const std::string scheme = settings.tls_certificate.empty() ? "http://" : "https://";
    return scheme + host_and_port(settings.host, port());
}

Inbox& Server::inbox() {
    return impl_->state.inbox;
}

void Server::send(ViewerId viewer, const v1::ServerMessage& message) {
    if (const auto link = impl_->state.viewers.find(viewer)) {
        link->send(message);
        impl_->network.wake();
    }
}

void Server::broadcast(const v1::ServerMessage& message, ViewerId except) {
    const std::string json = to_json(message);
    if (message.has_presence()) {
        impl_->state.set_presence(json);
    }
    for (const auto& link : impl_->state.viewers.all()) {
        if (link->viewer() != except) {
            link->send_if_welcomed(json);
        }
    }
    impl_->network.wake();
}

void Server::reply(const ClientEvent& request, v1::ServerMessage answer) {
    for (const std::uint32_t id : request.superseded) {
        answer.set_reply_to(id);
        send(request.viewer, answer);
    }
    if (request.message.has_id()) {
        answer.set_reply_to(request.message.id());
        send(request.viewer, answer);
    }
}

void Server::reply_ok(const ClientEvent& request) {
    v1::ServerMessage answer;
    answer.mutable_ok();
    reply(request, std::move(answer));
}

void Server::reply_error(const ClientEvent& request, v1::Error::Code code,
                         const std::string& text) {
    v1::ServerMessage answer = to_message({code, text, std::nullopt});
    if (!request.message.has_id()) {
        send(request.viewer, answer);
    }
    reply(request, std::move(answer));
}

void Server::disconnect(ViewerId viewer, v1::Error::Code code, const std::string& text) {
    if (const auto link = impl_->state.viewers.find(viewer)) {
        link->send(to_message({code, text, std::nullopt}));
        link->close(CloseCode::policy_violation, text);
        impl_->network.wake();
    }
}

void Server::close(ViewerId viewer, CloseCode code, const std::string& text) {
    if (const auto link = impl_->state.viewers.find(viewer)) {
        link->close(code, text);
        impl_->network.wake();
    }
}

void Server::close_all(CloseCode code, const std::string& text) {
    for (const auto& link : impl_->state.viewers.all()) {
        link->close(code, text);
    }
    impl_->network.wake();
}

FrameAdvice Server::advise(ViewerId viewer, const FrameDemand& demand) {
    const auto link = impl_->state.viewers.find(viewer);
    return link ? link->advise(demand, server_time_ms()) : FrameAdvice{};
}

double Server::silence_ms(ViewerId viewer) const {
    const auto link = impl_->state.viewers.find(viewer);
    return link ? link->silence_ms(server_time_ms()) : 0.0;
}

bool Server::acknowledged(ViewerId viewer) const {
    const auto link = impl_->state.viewers.find(viewer);
    return link && link->acknowledged();
}

bool Server::answers(ViewerId viewer) const {
    const auto link = impl_->state.viewers.find(viewer);
    return link && link->answers();
}

void Server::send_frame(ViewerId viewer, const v1::FrameHeader& header,
                        const std::vector<std::uint8_t>& image) {
    const auto link = impl_->state.viewers.find(viewer);
    if (!link) {
        return;
    }
    ++impl_->state.counters.frames_queued;
    if (link->send_frame(header, image)) {
        ++impl_->state.counters.frames_replaced;
    }
    impl_->network.wake();
}

void Server::send_light(ViewerId viewer, const v1::LightHeader& header, std::string_view blocks) {
    if (const auto link = impl_->state.viewers.find(viewer)) {
        link->send_light(header, blocks);
        impl_->network.wake();
    }
}

bool Server::has_room_for_light(ViewerId viewer) const {
    const auto link = impl_->state.viewers.find(viewer);
    return link && link->has_room_for_light();
}

LightAcks& Server::light_acks() {
    return impl_->state.viewers.light_acks();
}

std::string Server::keep_content(std::string_view kind, ContentStore::Files files) {
    return impl_->state.contents.add(kind, std::move(files));
}

void Server::set_access(Access access) {
    impl_->state.gate.set_access(std::move(access));
    impl_->network.recheck_passes();
}

void Server::reload_certificate() {
    const ServerSettings& settings = impl_->state.settings;
    if (!settings.tls_certificate.empty()) {
        impl_->network.use_certificate(
            std::make_shared<const TlsCertificate>(settings.tls_certificate, settings.tls_key));
    }
}

AuditLog* Server::audit() const {
    return impl_->state.settings.audit.get();
}

void Server::set_ready(bool ready) {
    impl_->state.ready = ready;
}

void Server::set_editable_source(std::function<bool()> source) {
    impl_->state.set_editable_source(std::move(source));
}

void Server::set_metrics_source(std::function<std::string()> source) {
    impl_->state.set_metrics_source(std::move(source));
}

void Server::set_photometry_source(std::function<std::string()> source) {
    impl_->state.set_photometry_source(std::move(source));
}

void Server::set_document_source(const void* owner, DocumentSource source) {
    impl_->state.set_document_source(owner, std::move(source));
}

void Server::set_upload_factory(UploadFactory factory) {
    impl_->state.set_upload_factory(std::move(factory));
}

std::optional<std::string> Server::keep_snapshot(std::string bytes, std::string_view extension) {
    return impl_->state.snapshots.add(std::move(bytes), extension);
}

double Server::now_ms() {
    return server_time_ms();
}

}  // namespace raybundle
