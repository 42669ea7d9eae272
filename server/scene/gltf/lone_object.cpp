// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/lone_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "scene/disjoint_sets.h"

namespace raybundle {
namespace {

constexpr std::size_t most_parts = 256;
constexpr std::size_t fewest_triangles = 8;  // a quad or two is no thing
/// A part that spans this share of the scene in two axes is a wall, a floor or the whole building.
constexpr float structure_share = 0.5F;
constexpr float nothing_to_move = 0.7F;

struct Part {
    std::vector<std::uint32_t> triangles;
    Bounds bounds;  // object space
    [[nodiscard]] float size() const { return glm::length(bounds.extent()); }
};

struct PositionHash {
    std::size_t operator()(const glm::vec3& p) const {
        std::size_t sum = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float value = p[axis] == 0.0F ? 0.0F : p[axis];  // -0 is 0
            sum = sum * 0x9e3779b97f4a7c15U + std::bit_cast<std::uint32_t>(value);
        }
        return sum ^ (sum >> 29U);
    }
};

/// Triangles that share corners belong together, whatever normals the file gives these.
std::vector<Part> connected_parts(const Scene& scene) {
    DisjointSets sets(scene.vertices.size());
    std::unordered_map<glm::vec3, std::uint32_t, PositionHash> first;
    for (std::uint32_t i = 0; i < scene.vertices.size(); ++i) {
        const auto [known, added] = first.emplace(scene.vertices[i].position, i);
        if (!added) {
            sets.join(i, known->second);
        }
    }
    for (const Triangle& triangle : scene.triangles) {
        sets.join(triangle.vertex[0], triangle.vertex[1]);
        sets.join(triangle.vertex[1], triangle.vertex[2]);
    }
    std::map<std::uint32_t, Part> found;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        Part& part = found[sets.find(scene.triangles[t].vertex[0])];
        part.triangles.push_back(t);
        for (const std::uint32_t vertex : scene.triangles[t].vertex) {
            part.bounds.add(scene.vertices[vertex].position);
        }
    }
    std::vector<Part> parts;
    for (auto& [set, part] : found) {
        parts.push_back(std::move(part));
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.size() > b.size(); });
    return parts;
}

int spanned_axes(const Bounds& bounds, const Bounds& all, float share) {
    int count = 0;
    for (int axis = 0; axis < 3; ++axis) {
        count += bounds.extent()[axis] >= share * all.extent()[axis] ? 1 : 0;
    }
    return count;
}

bool lies_in(const Bounds& inner, const Bounds& outer) {
    const glm::vec3 margin(1e-3F * glm::length(outer.extent()));
    return glm::all(glm::greaterThanEqual(inner.min, outer.min - margin)) &&
           glm::all(glm::lessThanEqual(inner.max, outer.max + margin));
}

/// Things, the largest first; what is within one of them is part of it.
std::vector<Part> things_of(std::vector<Part> parts, const Bounds& all) {
    std::vector<Part> things;
    for (Part& part : parts) {
        const auto holder = std::find_if(things.begin(), things.end(), [&](const Part& thing) {
            return spanned_axes(thing.bounds, all, structure_share) < 2 &&
                   lies_in(part.bounds, thing.bounds);
        });
        if (holder != things.end()) {
            holder->triangles.insert(holder->triangles.end(), part.triangles.begin(),
                                     part.triangles.end());
        } else {
            things.push_back(std::move(part));
        }
    }
    return things;
}

/// After the material of most of its triangles.
std::string name_of_part(const Scene& scene, const Part& part, std::map<std::string, int>& names) {
    std::map<std::uint32_t, std::size_t> counts;
    for (const std::uint32_t t : part.triangles) {
        ++counts[scene.triangles[t].material];
    }
    const auto most =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    const std::string& material = scene.materials[most->first].name;
    const std::string name = material.empty() ? "part" : material;
    return fmt::format("{} {}", name, ++names[name]);
}

}  // namespace

std::size_t split_lone_object(Scene& scene) {
    if (scene.objects.size() != 1 || scene.objects[0].movable) {
        return scene.objects.size();
    }
    const Object whole = scene.objects[0];
    std::map<std::string, int> names;
    Bounds rest;
    for (const Part& part : things_of(connected_parts(scene), whole.bounds)) {
        const int spans = spanned_axes(part.bounds, whole.bounds, structure_share);
        const bool apart = part.triangles.size() >= fewest_triangles &&
                           spanned_axes(part.bounds, whole.bounds, nothing_to_move) < 2 &&
                           scene.objects.size() < most_parts;
        if (!apart) {
            rest.add(part.bounds.min);
            rest.add(part.bounds.max);
            continue;
        }
        Object object = whole;
        object.id = static_cast<std::uint32_t>(scene.objects.size() + 1);
        object.name = name_of_part(scene, part, names);
        object.path.push_back(whole.name);
        object.movable = true;
        object.kind = spans >= 2 ? ObjectKind::structure : ObjectKind::thing;
        object.bounds = part.bounds;
        for (const std::uint32_t t : part.triangles) {
            scene.triangles[t].object = object.id - 1;
        }
        scene.objects.push_back(std::move(object));
    }
    if (rest.empty()) {  // nothing would be left of object 1
        for (Triangle& triangle : scene.triangles) {
            triangle.object = 0;
        }
        scene.objects.assign(1, whole);
        return 1;
    }
    scene.objects[0].bounds = rest;
    std::stable_sort(scene.triangles.begin(), scene.triangles.end(),
                     [](const Triangle& a, const Triangle& b) { return a.object < b.object; });
    return scene.objects.size();
}

}  // namespace raybundle
