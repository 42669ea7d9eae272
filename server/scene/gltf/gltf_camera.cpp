// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace raybundle {
namespace {

constexpr double min_vertical_fov = 1e-6;
constexpr double max_vertical_fov = 3.1;

/// glTF 2.0, 3.10: a camera looks along its node's -Z with +Y up; scale does not count.
bool place_camera(const GltfNode& node, const Bounds& bounds, Camera& camera) {
    const glm::dmat4& world = node.world_from_node;
    const glm::dvec3 back(world[2]);
    const glm::dvec3 up(world[1]);
    const double back_length = glm::length(back);
    const double up_length = glm::length(up);
    if (!(back_length > 0.0 && up_length > 0.0) || !std::isfinite(back_length * up_length)) {
        return false;
    }
    const glm::dvec3 forward = -back / back_length;
    const glm::dvec3 eye(world[3]);
    // Look at the depth of the scene's centre, so that orbiting starts around something.
    const double to_centre = glm::dot(glm::dvec3(bounds.centre()) - eye, forward);
    const double size = glm::length(glm::dvec3(bounds.extent()));
    const double distance = std::max(to_centre, 0.1 * size);
    camera.eye = glm::vec3(eye);
    camera.target = glm::vec3(eye + forward * distance);
    camera.up = glm::vec3(up / up_length);
    return camera.eye != camera.target;
}

}  // namespace

std::vector<Camera> read_cameras(GltfDocument& document, const GltfNodeTree& tree,
                                 const Bounds& bounds) {
    std::vector<Camera> cameras;
    for (const int index : tree.order) {
        const int camera_index = item(document.model().nodes, index).camera;
        if (camera_index < 0) {
            continue;
        }
        const GltfNode& node = item(tree.nodes, index);
        const tinygltf::Camera& source = item(document.model().cameras, camera_index);
        Camera camera;
        if (source.type != "perspective" || !(source.perspective.yfov >= min_vertical_fov) ||
            !place_camera(node, bounds, camera)) {
            document.note("orthographic and degenerate cameras are left out");
            continue;
        }
        camera.vertical_fov =
            static_cast<float>(std::min(source.perspective.yfov, max_vertical_fov));
        camera.name = node.name.empty() ? source.name : node.name;
        if (camera.name.empty()) {
            camera.name = fmt::format("camera {}", cameras.size() + 1);
        }
        cameras.push_back(std::move(camera));
    }
    return cameras;
}

}  // namespace raybundle
