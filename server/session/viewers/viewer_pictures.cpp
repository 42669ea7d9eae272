// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/viewer_pictures.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "session/messages/scene_messages.h"
#include "session/viewers/picture_refusal.h"

namespace raybundle {

void ViewerPictures::prepare(ViewerSession& session) {
    if (!session.has_image()) {
        const bool shown = first_look_ != nullptr && first_look_of_ == session.id();
        session.give_image(
            shown ? std::move(first_look_) : parts_.scene.make_picture(session.size()), shown);
        first_look_of_ = shown ? 0 : first_look_of_;
    }
    session.apply_view();
}

ViewerImage& ViewerPictures::first_look(const ViewerSession& session) {
    if (!first_look_) {
        first_look_ = parts_.scene.make_picture(session.size());
    }
    first_look_of_ = session.id();
    return *first_look_;
}

void ViewerPictures::drop(ViewerSession& session) {
    if (session.has_image()) {
        parts_.receivers.remove(&session.image());
        session.drop_image();
    }
}

void ViewerPictures::refuse(ViewerSession& session, const GpuError& error) {
    spdlog::error("no picture for viewer {}: {}", session.id(), error.what());
    drop(session);
    first_look_.reset();
    const Refusal refusal = refusal_of(error);
    parts_.server.send(session.id(), to_message(refusal));
    parts_.server.close(session.id(), CloseCode::try_again_later, refusal.text);
}

void ViewerPictures::forget(ViewerSession& session) {
    drop(session);
    first_look_of_ = first_look_of_ == session.id() ? 0 : first_look_of_;
}

void ViewerPictures::renew(const Solver& solver, const ViewPrograms& programs) {
    first_look_.reset();
    for (const auto& [id, session] : parts_.viewers) {
        if (session->has_image()) {
            session->give_image(std::make_unique<ViewerImage>(solver.scene(), solver.store(),
                                                              programs, session->size()),
                                false);
            session->apply_view();
        }
    }
}

std::size_t ViewerPictures::bytes() const {
    std::size_t sum = first_look_ ? first_look_->bytes() : 0;
    for (const auto& [id, session] : parts_.viewers) {
        sum += session->has_image() ? session->image().bytes() : 0;
    }
    return sum;
}

}  // namespace raybundle
