// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "scene/gltf_loader.h"

namespace raybundle {
namespace {

std::string error_text(const std::string& file, const std::string& json_path,
                       const std::string& reason) {
    return json_path.empty() ? file + ": " + reason : file + ": " + json_path + ": " + reason;
}

}  // namespace

SceneError::SceneError(std::string file, std::string json_path, std::string reason)
    : std::runtime_error(error_text(file, json_path, reason)),
      file_(std::move(file)),
      json_path_(std::move(json_path)),
      reason_(std::move(reason)) {}

glm::mat4 Transform::matrix() const {
    const glm::mat4 moved = glm::translate(glm::mat4(1.0F), translation);
    return glm::scale(moved * glm::mat4_cast(rotation), scale);
}

}  // namespace raybundle
