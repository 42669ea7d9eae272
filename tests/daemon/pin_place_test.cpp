// SPDX-License-Identifier: Apache-2.0
// Pins stay on their surface, whatever number its sides get.
#include "session/review/pin_place.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>

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
