// SPDX-License-Identifier: Apache-2.0
// Pins stay on their surface, whatever number its sides get.
#include "session/review/pin_place.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "session/messages/scene_messages.h"
#include "test_folder.h"

namespace raybundle {
namespace {

/// Two-sided plates of 1 m, one above the other, each an object of two triangles whose fronts look
/// up. Further ones come behind them, as MeshGrowth numbers them: fronts stay, backs follow.
struct Plates {
    Scene scene;
    PatchMesh mesh;

    explicit Plates(std::uint32_t count) {
        for (std::uint32_t object = 0; object < count; ++object) {
            scene.objects.emplace_back().id = object + 1;
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const glm::vec2 corner : {glm::vec2(0, 0), {0, 1}, {1, 1}, {1, 0}}) {
                mesh.positions.emplace_back(corner.x, object, corner.y);
                mesh.vertex_object.push_back(object);
            }
            mesh.triangles.emplace_back(first, first + 1, first + 2);
            mesh.triangles.emplace_back(first, first + 2, first + 3);
        }
        for (const bool back : {false, true}) {
            for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
                if (back) {
                    mesh.back_side.push_back(static_cast<std::uint32_t>(mesh.side_count()));
                }
                mesh.side_triangle.push_back(t);
            }
        }
    }
};

/// On the second triangle of the second plate.
constexpr std::uint32_t kPinTriangle = 3;
constexpr glm::vec3 kPinSpot(0.7F, 1.0F, 0.2F);

Pin pin_on(const Plates& plates, std::uint32_t side) {
    Pin pin;
    pin.message.set_object(2);
    to_message(kPinSpot, pin.message.mutable_position());
    to_message(kPinSpot, pin.message.mutable_local_position());
    put_on(plates.scene, plates.mesh, side, kPinSpot, pin);
    return pin;
}

TEST(PinPlace, IsTheSameSideWhenObjectsHaveBeenAdded) {
    const Plates before(2);
    const Plates after(4);
    const std::uint32_t back = before.mesh.back_side[kPinTriangle];
    ASSERT_NE(back, after.mesh.back_side[kPinTriangle]) << "it gets another number";
    Pin above = pin_on(before, kPinTriangle);
    Pin below = pin_on(before, back);
    EXPECT_EQ(side_of(before.scene, before.mesh, below), back);
    EXPECT_EQ(side_of(after.scene, after.mesh, above), kPinTriangle);
    EXPECT_EQ(side_of(after.scene, after.mesh, below), after.mesh.back_side[kPinTriangle]);
    // They are taken back again, as where the change could not be saved.
    EXPECT_EQ(side_of(before.scene, before.mesh, below), back);
}

TEST(PinPlace, IsNowhereWhileItsObjectIsNotThere) {
    Plates plates(2);
    Pin pin = pin_on(plates, kPinTriangle);
    plates.scene.objects[1].removed = true;
    EXPECT_EQ(side_of(plates.scene, plates.mesh, pin), std::nullopt);
    plates.scene.objects[1].removed = false;
    EXPECT_EQ(side_of(plates.scene, plates.mesh, pin), kPinTriangle);
    const Plates fewer(1);  // a server of the project that has not heard of it yet
    EXPECT_EQ(side_of(fewer.scene, fewer.mesh, pin), std::nullopt);
}

TEST(PinPlace, MovesWithItsObject) {
    Plates plates(2);
    Pin pin = pin_on(plates, plates.mesh.back_side[kPinTriangle]);
    pin.triangles = 0;  // looked for again
    plates.scene.objects[1].transform.translation = {3.0F, 1.0F, 0.0F};
    EXPECT_EQ(side_of(plates.scene, plates.mesh, pin), plates.mesh.back_side[kPinTriangle]);
}

TEST(PinPlace, IsTheNamedSideWhereThePointLiesOnIt) {
    const Plates plates(2);
    const std::uint32_t back = plates.mesh.back_side[kPinTriangle];
    const glm::vec3 eye = kPinSpot + glm::vec3(0, 3, 0);
    const glm::vec3 rounded = kPinSpot + glm::vec3(0, 5e-4F, 0);
    for (const std::uint32_t side : {kPinTriangle, back}) {
        const auto found = side_near(plates.scene, plates.mesh, side, rounded, eye, 1e-3F);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->side, side) << "also where the eye sees the other one";
    }
}

TEST(PinPlace, IsWhatIsThereWhereTheNamedSideIsElsewhere) {
    Plates plates(2);
    const std::uint32_t back = plates.mesh.back_side[kPinTriangle];
    const glm::vec3 up(0, 3, 0);
    const auto found = [&](const glm::vec3& point, const std::optional<glm::vec3>& eye) {
        return side_near(plates.scene, plates.mesh, 0, point, eye, 1e-3F);
    };
    EXPECT_EQ(found(kPinSpot, kPinSpot + up)->side, kPinTriangle);
    EXPECT_EQ(found(kPinSpot, kPinSpot - up)->side, back);
    EXPECT_EQ(found(kPinSpot, std::nullopt)->side, kPinTriangle);
    // What was there has gone since: the plate below is the nearest, and far.
    plates.scene.objects[1].transform.translation = {0.0F, 7.0F, 0.0F};
    EXPECT_NEAR(found(kPinSpot, kPinSpot + up)->distance, 1.0F, 1e-6F);
    EXPECT_EQ(found(kPinSpot + glm::vec3(0, 7, 0), std::nullopt)->side, kPinTriangle);
    plates.scene.objects[0].removed = true;
    EXPECT_NEAR(found(kPinSpot, std::nullopt)->distance, 7.0F, 1e-6F);
    plates.scene.objects[1].removed = true;
    EXPECT_FALSE(found(kPinSpot, std::nullopt));
}

TEST(PinPlace, IsTheWallThatIsSeenBestInACorner) {
    // The plate above stands on the edge x = 0 of the one below.
    Plates plates(2);
    plates.scene.objects[1].transform.translation = {1.0F, 0.0F, 0.0F};
    plates.scene.objects[1].transform.rotation =
        glm::angleAxis(glm::radians(90.0F), glm::vec3(0, 0, 1));
    const glm::vec3 corner(0.0F, 0.0F, 0.5F);
    const auto object = [&](const glm::vec3& eye) {
        const auto found = side_near(plates.scene, plates.mesh, 999, corner, eye, 1e-3F);
        return plates.mesh
            .vertex_object[plates.mesh.triangles[plates.mesh.side_triangle[found->side]].x];
    };
    EXPECT_EQ(object({0.1F, 2.0F, 0.5F}), 0U);
    EXPECT_EQ(object({2.0F, 0.1F, 0.5F}), 1U);
}

TEST(PinPlace, OfAPinOnNothingIsNone) {
    const Plates plates(2);
    Pin pin;
    EXPECT_EQ(side_of(plates.scene, plates.mesh, pin), std::nullopt);
}

class JournalOfPins : public testing::Test {
  protected:
    [[nodiscard]] JournalSettings settings() const {
        return {folder_.path("session.db"), "plates", "digest"};
    }
    /// The one pin that a server finds which begins now.
    [[nodiscard]] Pin restarted() const {
        ChangeLog log(settings());
        const ReviewBoard board(log);
        return board.pins().at(1);
    }

    TestFolder folder_;
};

TEST_F(JournalOfPins, KeepsTheirSidesAlsoWhereTheSceneHasGrownMeanwhile) {
    const Plates before(2);
    {
        ChangeLog log(settings());
        ReviewBoard board(log);
        ASSERT_NE(board.add_pin(pin_on(before, before.mesh.back_side[kPinTriangle])), nullptr);
    }
    const Plates after(3);
    Pin pin = restarted();
    EXPECT_EQ(side_of(after.scene, after.mesh, pin), after.mesh.back_side[kPinTriangle]);
    pin = restarted();
    EXPECT_EQ(side_of(before.scene, before.mesh, pin), before.mesh.back_side[kPinTriangle]);
}

TEST_F(JournalOfPins, NumbersThemOnWhereTheLastOneWasRemoved) {
    const Plates plates(2);
    for (const std::uint32_t number : {1U, 2U, 3U}) {
        ChangeLog log(settings());
        ReviewBoard board(log);
        const Pin* const added = board.add_pin(pin_on(plates, kPinTriangle));
        ASSERT_NE(added, nullptr);
        EXPECT_EQ(added->message.pin(), number);
        EXPECT_TRUE(board.remove_pin(number));
        const v1::ViewpointChanged* const viewpoint = board.add_viewpoint({});
        ASSERT_NE(viewpoint, nullptr);
        EXPECT_EQ(viewpoint->viewpoint(), number);
        EXPECT_TRUE(board.remove_viewpoint(number));
    }
}

TEST_F(JournalOfPins, OfEarlierVersionsHasNumbersOfSidesOnly) {
    const Plates before(2);
    const Plates after(4);
    for (const std::uint32_t side : {kPinTriangle, before.mesh.back_side[kPinTriangle]}) {
        v1::JournalPin note;
        *note.mutable_pin() = pin_on(before, side).message;
        note.mutable_pin()->set_pin(1);
        note.set_patch(side);
        {
            ChangeLog log(settings());
            ASSERT_TRUE(log.keep_note(NoteKind::pin, 1, note.SerializeAsString()));
        }
        for (const Plates* plates : {&before, &after}) {
            Pin pin = restarted();
            EXPECT_EQ(side_of(plates->scene, plates->mesh, pin),
                      side == kPinTriangle ? kPinTriangle : plates->mesh.back_side[kPinTriangle]);
            EXPECT_TRUE(pin.place) << "from then on it is known";
        }
    }
}

}  // namespace
}  // namespace raybundle
