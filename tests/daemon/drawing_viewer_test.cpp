// SPDX-License-Identifier: Apache-2.0
// A viewer whose page draws by itself.
#include <gtest/gtest.h>

#include "session/viewers/viewer_session.h"

namespace raybundle {
namespace {

TEST(DrawingViewer, WantsNoPicturesUntilItRests) {
    ManualClock clock;
    const ViewerPaceSettings pace;
    ViewerSession session(1, v1::Hello(), Camera{}, pace, clock);
    v1::SetCamera camera;
    camera.mutable_eye()->set_z(4.0F);
    camera.mutable_target();
    session.set_camera(camera, 1);
    EXPECT_FALSE(session.draws_itself(clock.now()));
    EXPECT_TRUE(session.due(clock.now()));
    session.set_drawing(true);
    for (int i = 0; i < 20; ++i) {
        clock.advance_ms(100.0);
        session.set_camera(camera, 1);
        EXPECT_TRUE(session.draws_itself(clock.now()));
        EXPECT_FALSE(session.due(clock.now()));
    }
    clock.advance_ms(151.0);
    EXPECT_FALSE(session.draws_itself(clock.now()));
    EXPECT_TRUE(session.due(clock.now()));
    // Lights change without it: there is nothing that it would draw.
    session.note_change();
    EXPECT_TRUE(session.due(clock.now()));
    session.stay_in_motion(clock.now());  // somebody drags an object
    EXPECT_FALSE(session.due(clock.now()));
}

}  // namespace
}  // namespace raybundle
