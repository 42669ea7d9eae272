// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/walk_mapper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <future>
#include <map>

#include "session/messages/scene_messages.h"

namespace raybundle {
namespace {

/// A slab of 4 x 4 m, its top at a height that its object's place says.
Scene slab() {
    Scene scene;
    Object object;
    object.id = 1;
    for (const glm::vec2& corner : {glm::vec2(-2, -2), {2, -2}, {2, 2}, {-2, 2}}) {
        Vertex vertex;
        vertex.position = {corner.x, 0.0F, corner.y};
        object.bounds.add(vertex.position);
        scene.vertices.push_back(vertex);
    }
    for (const auto& corners : {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}}) {
        Triangle triangle;
        std::copy(corners.begin(), corners.end(), std::begin(triangle.vertex));
        triangle.object = 0;
        scene.triangles.push_back(triangle);
    }
    scene.objects.push_back(object);
    return scene;
}

ClientEvent request(ViewerId viewer, std::uint32_t id) {
    ClientEvent event;
    event.viewer = viewer;
    event.message.set_id(id);
    to_message(glm::vec3(0.0F, 1.6F, 0.0F), event.message.mutable_get_walk_map()->mutable_eye());
    return event;
}

TEST(WalkMapperTest, AnswersAsThingsWereWhenAskedAndHoldsUpNobody) {
    Scene scene = slab();
    std::mutex mutex;
    std::map<std::uint32_t, std::optional<WalkMap>> answers;
    std::map<std::uint32_t, std::uint32_t> epochs;
    std::promise<void> first_begun, go_on, all;
    WalkMapper mapper(
        scene, 1.0,
        [&](const ClientEvent& event, const std::optional<WalkMap>& map, std::uint32_t epoch) {
            const std::uint32_t id = event.message.id();
            if (id == 1) {
                first_begun.set_value();
                go_on.get_future().wait();
            }
            const std::lock_guard lock(mutex);
            answers[id] = map;
            epochs[id] = epoch;
            if (answers.size() == 4) {
                all.set_value();
            }
        });
    mapper.ask(request(7, 1), 3);
    first_begun.get_future().wait();
    // The caller goes on while a map takes long, and the scene with it.
    scene.objects[0].transform.translation.y = 0.5F;
    mapper.ask(request(7, 2), 4);
    mapper.ask(request(8, 3), 4);
    scene.objects[0].transform.translation.y = 1.0F;
    mapper.ask(request(7, 4), 5);
    go_on.set_value();
    all.get_future().wait();
    const std::lock_guard lock(mutex);
    ASSERT_TRUE(answers[1] && answers[3] && answers[4]);
    EXPECT_FALSE(answers[2]) << "replaced";
    EXPECT_EQ(answers[1]->floor, 0.0F);
    EXPECT_EQ(answers[3]->floor, 0.5F);
    EXPECT_EQ(answers[4]->floor, 1.0F);
    EXPECT_EQ(epochs[3], 4U);
    EXPECT_EQ(epochs[4], 5U);
}

}  // namespace
}  // namespace raybundle
