// SPDX-License-Identifier: Apache-2.0
#include "view/pixels/picture_view.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "view/camera_matrices.h"

namespace raybundle::picture_view_test {
namespace {

/// 160 x 120 pixels, from the origin along -z; a pixel is 1/60 wide at unit distance.
layout::ViewParameters view_along_z() {
    Camera camera;
    camera.eye = glm::vec3(0.0F);
    camera.target = glm::vec3(0.0F, 0.0F, -1.0F);
    camera.up = glm::vec3(0.0F, 1.0F, 0.0F);
    camera.vertical_fov = 2.0F * std::atan(1.0F);
    layout::ViewParameters view =
        make_view_parameters(camera, glm::vec3(0.0F), glm::uvec2(160, 120), 0.01F);
    view.size = picture_size(glm::uvec2(160, 120));
    return view;
}

Bounds box(const glm::vec3& low, const glm::vec3& high) {
    Bounds bounds;
    bounds.add(low);
    bounds.add(high);
    return bounds;
}

PixelRectangle rectangle_of_one(const Bounds& bounds) {
    return rectangle_of(std::span(&bounds, 1), view_along_z());
}

TEST(PictureView, ARectangleHoldsABoxAndLittleMore) {
    // At distance 2 it spans pixels 80 to 110 and 60 to 90.
    const PixelRectangle found = rectangle_of_one(box({0.0F, 0.0F, -3.0F}, {1.0F, 1.0F, -2.0F}));
    EXPECT_LE(found.x0, 80 - 2);
    EXPECT_LE(found.y0, 60 - 2);
    EXPECT_GE(found.x1, 110 + 2);
    EXPECT_GE(found.y1, 90 + 2);
    EXPECT_LE(found.width(), 30 + 2 * 12);
    EXPECT_LE(found.height(), 30 + 2 * 12);
}

TEST(PictureView, WhatIsBesideThePictureHasNoRectangle) {
    EXPECT_TRUE(rectangle_of_one(box({10.0F, 0.0F, -2.0F}, {11.0F, 1.0F, -1.0F})).empty());
    EXPECT_TRUE(rectangle_of_one(Bounds()).empty());
}

TEST(PictureView, WhatReachesBehindTheEyeMayBeAnywhere) {
    const PixelRectangle found = rectangle_of_one(box({-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}));
    EXPECT_EQ(found.width(), 160);
    EXPECT_EQ(found.height(), 120);
}

TEST(PictureView, TwoBoxesShareOneRectangle) {
    const std::array<Bounds, 2> boxes = {box({-1.0F, 0.0F, -2.0F}, {-0.9F, 0.1F, -2.0F}),
                                         box({0.9F, 0.0F, -2.0F}, {1.0F, 0.1F, -2.0F})};
    const PixelRectangle found = rectangle_of(boxes, view_along_z());
    EXPECT_LE(found.x0, 50);
    EXPECT_GE(found.x1, 110);
}

}  // namespace
}  // namespace raybundle::picture_view_test
