// SPDX-License-Identifier: Apache-2.0
#include "scene/contact/solid_shells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <iterator>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "scene/contact/box_tree.h"
#include "scene/contact/point_index.h"
#include "scene/contact/world_triangle.h"
#include "scene/disjoint_sets.h"
#include "scene/material/specular_surface.h"

namespace raybundle {
namespace {

constexpr std::size_t asked_points = 16;  // of a surface, to tell whether it lies within a shell
constexpr double clearly_inside = 0.75;   // winding number: 1 inside, 0 outside, between on it
// Triangles that may be looked at for that, in all; shells that come later count as not solid.
constexpr std::size_t most_looks = 200'000'000;

/// Triangles that are joined by edges.
struct Shell {
    std::vector<std::uint32_t> triangles;
    BoxTree::Box box{glm::dvec3(1e300), glm::dvec3(-1e300)};
    bool closed = true;
    bool opaque = true;
    bool double_sided = false;
};

bool is_opaque(const Material& material) {
    return material.alpha_mode == AlphaMode::opaque && !is_glass(material) && !transmits(material);
}

/// A triangle's edge, and whether it goes from the point with the lower number to the other.
struct EdgeUse {
    std::uint64_t edge = 0;  // numbers of its points, the lower first
    std::uint32_t triangle = 0;
    bool upwards = false;
};

class ShellSearch {
  public:
    explicit ShellSearch(const Scene& scene)
        : scene_(scene), groups_(scene.triangles.size()), lamp_places_(tree_of_lamps()) {
        find_edges();
        collect_shells();
    }

    /// Indices of the triangles of all solids.
    std::vector<std::uint32_t> run() {
        std::vector<BoxTree::Box> boxes(shells_.size());
        std::transform(shells_.begin(), shells_.end(), boxes.begin(),
                       [](const Shell& shell) { return shell.box; });
        const BoxTree tree(std::move(boxes));
        std::vector<std::uint32_t> found;
        for (std::uint32_t s = 0; s < shells_.size(); ++s) {
            const Shell& shell = shells_[s];
            if (shell.closed && shell.opaque && shell.double_sided && volume(shell) > 0.0 &&
                !holds_a_place(shell) && !holds_a_surface(s, tree)) {
                found.insert(found.end(), shell.triangles.begin(), shell.triangles.end());
            }
        }
        return found;
    }

    /// Lamps within closed shells.
    std::vector<EnclosedLight> enclosed_lights() {
        std::vector<EnclosedLight> found;
        const std::vector<Lamp> luminous = lamps();
        for (std::uint32_t s = 0; s < shells_.size(); ++s) {
            const Shell& shell = shells_[s];
            if (!shell.closed || !shell.opaque || volume(shell) == 0.0 || holds_a_camera(shell)) {
                continue;
            }
            const std::uint32_t first = shell.triangles.front();
            const std::string& object = scene_.objects[scene_.triangles[first].object].name;
            for (const std::uint32_t light : lamps_within(shell)) {
                found.push_back({scene_.punctual_lights[light].name, object});
            }
            for (const Lamp& lamp : luminous) {
                const Shell& other = shells_[lamp.shell];
                if (lamp.shell != s && holds_box(shell, other.box) &&
                    holds_all_of(shell, other.triangles)) {
                    found.push_back({*lamp.name, object});
                }
            }
            if (looks_ > most_looks) {  // holds() is not to be relied on any more
                return {};
            }
        }
        return found;
    }

    /// Of each material, whether it is on shells and all of these are sheets.
    [[nodiscard]] std::vector<bool> only_on_sheets() const {
        std::vector<char> sheet(scene_.materials.size(), 0);
        std::vector<char> body(scene_.materials.size(), 0);
        std::vector<Sheet> sheets;
        std::vector<BoxTree::Box> boxes;
        for (const Shell& shell : shells_) {
            const std::uint32_t material = scene_.triangles[shell.triangles.front()].material;
            if (scene_.materials[material].thickness <= 0.0F) {
                continue;
            }
            const Sheet found = sheet_of(shell);
            if (shell.closed || glm::length(found.across) < flattest * found.area) {
                body[material] = 1;
            } else {
                sheets.push_back(found);
                boxes.push_back(shell.box);
            }
        }
        const BoxTree tree(std::move(boxes));
        for (const Sheet& one : sheets) {
            (has_other_face(one, sheets, tree) ? body : sheet)[one.material] = 1;
        }
        std::vector<bool> result(sheet.size());
        for (std::size_t m = 0; m < result.size(); ++m) {
            result[m] = sheet[m] != 0 && body[m] == 0;
        }
        return result;
    }

  private:
    /// Area vectors shorter than this share of the area are those of something that nearly closes.
    static constexpr double flattest = 0.05;

    /// A shell that does not close; world space.
    struct Sheet {
        std::uint32_t material = 0, object = 0;
        BoxTree::Box box;
        glm::dvec3 across{0.0};  ///< its area as a vector, m²
        double area = 0.0;       ///< m²
    };

    [[nodiscard]] Sheet sheet_of(const Shell& shell) const {
        const Triangle& first = scene_.triangles[shell.triangles.front()];
        Sheet sheet{first.material, first.object, shell.box, {}, 0.0};
        for (const std::uint32_t t : shell.triangles) {
            const auto c = world_corners(scene_, scene_.triangles[t]);
            const glm::dvec3 across = 0.5 * glm::cross(c[1] - c[0], c[2] - c[0]);
            sheet.across += across;
            sheet.area += glm::length(across);
        }
        return sheet;
    }

    [[nodiscard]] bool has_other_face(const Sheet& one, const std::vector<Sheet>& sheets,
                                      const BoxTree& tree) const {
        const double reach = 2.0 * static_cast<double>(scene_.materials[one.material].thickness);
        bool found = false;
        tree.for_each_overlapping(
            {one.box.low - reach, one.box.high + reach}, [&](std::uint32_t index) {
                const Sheet& other = sheets[index];
                found = found || (other.material == one.material && other.object == one.object &&
                                  glm::length(one.across + other.across) <
                                      flattest * (one.area + other.area));
            });
        return found;
    }

    struct Lamp {
        std::uint32_t shell = 0;
        const std::string* name = nullptr;
    };

    /// Shells with a material that emits, or would if it were switched on.
    [[nodiscard]] std::vector<Lamp> lamps() const {
        std::vector<const std::string*> name_of(scene_.materials.size(), nullptr);
        for (const Light& light : scene_.lights) {
            name_of[static_cast<std::size_t>(light.material)] = &light.name;
        }
        std::vector<Lamp> found;
        for (std::uint32_t s = 0; s < shells_.size(); ++s) {
            for (const std::uint32_t t : shells_[s].triangles) {
                if (const std::string* name = name_of[scene_.triangles[t].material]) {
                    found.push_back({s, name});
                    break;
                }
            }
        }
        return found;
    }

    static bool holds_box(const Shell& shell, const BoxTree::Box& box) {
        return glm::all(glm::lessThanEqual(shell.box.low, box.low)) &&
               glm::all(glm::lessThanEqual(box.high, shell.box.high));
    }

    /// Joins triangles at their edges, and notes those that are not in a closed surface.
    void find_edges() {
        PointIndex points;
        std::vector<EdgeUse> uses;  // of one object
        std::uint32_t object = 0;
        for (const std::uint32_t t : by_object()) {
            const Triangle& triangle = scene_.triangles[t];
            if (triangle.object != object) {
                join_at_edges(uses);
                object = triangle.object;
                points = PointIndex();
            }
            std::array<std::uint32_t, 3> ids{};
            for (std::size_t k = 0; k < 3; ++k) {
                ids[k] = points.id_of(scene_.vertices[triangle.vertex[k]].position);
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax(ids[k], ids[(k + 1) % 3]);
                uses.push_back({std::uint64_t{low} << 32U | high, t, low == ids[k]});
            }
        }
        join_at_edges(uses);
    }

    void join_at_edges(std::vector<EdgeUse>& uses) {
        std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
            return std::tie(a.edge, a.triangle, a.upwards) <
                   std::tie(b.edge, b.triangle, b.upwards);
        });
        for (auto first = uses.begin(); first != uses.end();) {
            const auto end = std::find_if(
                first, uses.end(), [&](const EdgeUse& use) { return use.edge != first->edge; });
            for (auto use = first; use != end; ++use) {
                groups_.join(use->triangle, first->triangle);
            }
            if (end - first != 2 || first->upwards == std::next(first)->upwards) {
                open_.push_back(first->triangle);
            }
            first = end;
        }
        uses.clear();
    }

    [[nodiscard]] std::vector<std::uint32_t> by_object() const {
        std::vector<std::uint32_t> order(scene_.triangles.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return scene_.triangles[a].object < scene_.triangles[b].object;
        });
        return order;
    }

    void collect_shells() {
        constexpr std::uint32_t none = 0xffffffffU;
        std::vector<std::uint32_t> shell_of(scene_.triangles.size(), none);
        for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
            std::uint32_t& number = shell_of[groups_.find(t)];
            if (number == none) {
                number = static_cast<std::uint32_t>(shells_.size());
                shells_.emplace_back();
            }
            Shell& shell = shells_[number];
            shell.triangles.push_back(t);
            const Material& material = scene_.materials[scene_.triangles[t].material];
            shell.opaque = shell.opaque && is_opaque(material);
            shell.double_sided = shell.double_sided || material.double_sided;
            for (const glm::dvec3& corner : world_corners(scene_, scene_.triangles[t])) {
                shell.box.low = glm::min(shell.box.low, corner);
                shell.box.high = glm::max(shell.box.high, corner);
            }
        }
        for (const std::uint32_t t : open_) {
            shells_[shell_of[groups_.find(t)]].closed = false;
        }
    }

    /// Above zero where fronts look outwards, m³.
    [[nodiscard]] double volume(const Shell& shell) const {
        const glm::dvec3 middle = 0.5 * (shell.box.low + shell.box.high);
        double sum = 0.0;
        for (const std::uint32_t t : shell.triangles) {
            const auto c = world_corners(scene_, scene_.triangles[t]);
            sum += glm::dot(c[0] - middle, glm::cross(c[1] - middle, c[2] - middle));
        }
        return sum / 6.0;
    }

    [[nodiscard]] bool holds_a_camera(const Shell& shell) {
        return std::any_of(scene_.cameras.begin(), scene_.cameras.end(),
                           [&](const Camera& camera) { return holds(shell, camera.eye); });
    }

    /// Numbers of the lights somewhere within a shell, in order.
    [[nodiscard]] std::vector<std::uint32_t> lamps_within(const Shell& shell) {
        std::vector<std::uint32_t> found;
        lamp_places_.for_each_overlapping(shell.box, [&](std::uint32_t place) {
            const PunctualLight& light = scene_.punctual_lights[placed_[place]];
            if (holds(shell, place_light(scene_, light).position)) {
                found.push_back(placed_[place]);
            }
        });
        std::sort(found.begin(), found.end());
        return found;
    }

    [[nodiscard]] bool holds_a_place(const Shell& shell) {
        return holds_a_camera(shell) || !lamps_within(shell).empty();
    }

    [[nodiscard]] BoxTree tree_of_lamps() {
        std::vector<BoxTree::Box> boxes;
        for (std::uint32_t i = 0; i < scene_.punctual_lights.size(); ++i) {
            const PlacedLight placed = place_light(scene_, scene_.punctual_lights[i]);
            if (placed.kind != PunctualKind::directional) {
                boxes.push_back({placed.position, placed.position});
                placed_.push_back(i);
            }
        }
        return BoxTree(std::move(boxes));
    }

    [[nodiscard]] bool holds_a_surface(std::uint32_t number, const BoxTree& tree) {
        const Shell& shell = shells_[number];
        bool found = false;
        tree.for_each_overlapping(shell.box, [&](std::uint32_t other) {
            const BoxTree::Box& box = shells_[other].box;
            if (!found && other != number && holds_box(shell, box)) {
                found = holds_all_of(shell, shells_[other].triangles);
            }
        });
        return found;
    }

    [[nodiscard]] bool holds_all_of(const Shell& shell, std::span<const std::uint32_t> triangles) {
        const std::size_t step = (triangles.size() + asked_points - 1) / asked_points;
        for (std::size_t i = 0; i < triangles.size(); i += step) {
            const auto corners = world_corners(scene_, scene_.triangles[triangles[i]]);
            if (!holds(shell, (corners[0] + corners[1] + corners[2]) / 3.0)) {
                return false;
            }
        }
        return true;
    }

    /// By the solid angle of all triangles (van Oosterom and Strackee 1983, "The Solid Angle of a
    /// Plane Triangle"). True where that would take too long.
    [[nodiscard]] bool holds(const Shell& shell, const glm::dvec3& point) {
        if (!shell.box.overlaps({point, point})) {
            return false;
        }
        looks_ += shell.triangles.size();
        if (looks_ > most_looks) {
            return true;
        }
        double sum = 0.0;
        for (const std::uint32_t t : shell.triangles) {
            auto c = world_corners(scene_, scene_.triangles[t]);
            std::array<double, 3> length{};
            for (std::size_t k = 0; k < 3; ++k) {
                c[k] -= point;
                length[k] = glm::length(c[k]);
            }
            const double above = glm::dot(c[0], glm::cross(c[1], c[2]));
            const double below =
                length[0] * length[1] * length[2] + glm::dot(c[0], c[1]) * length[2] +
                glm::dot(c[1], c[2]) * length[0] + glm::dot(c[2], c[0]) * length[1];
            sum += 2.0 * std::atan2(above, below);
        }
        return std::abs(sum) > clearly_inside * 4.0 * glm::pi<double>();
    }

    const Scene& scene_;
    DisjointSets groups_;
    std::vector<std::uint32_t> placed_;  // lights that are somewhere
    BoxTree lamp_places_;                // of these
    std::vector<Shell> shells_;
    std::vector<std::uint32_t> open_;  // triangles at edges that do not join two
    std::size_t looks_ = 0;
};

}  // namespace

std::vector<EnclosedLight> find_enclosed_lights(const Scene& scene) {
    return ShellSearch(scene).enclosed_lights();
}

std::size_t mark_solid_shells(Scene& scene) {
    if (std::none_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& material) { return material.double_sided; })) {
        return 0;
    }
    const std::vector<std::uint32_t> solid = ShellSearch(scene).run();
    for (const std::uint32_t t : solid) {
        scene.triangles[t].solid = true;
    }
    return solid.size();
}

std::vector<std::string> thin_open_glass(Scene& scene) {
    const auto is_body = [](const Material& material) {
        return specular_kind(material) == SpecularKind::glass;
    };
    if (std::none_of(scene.materials.begin(), scene.materials.end(), is_body)) {
        return {};
    }
    const std::vector<bool> open = ShellSearch(scene).only_on_sheets();
    std::vector<std::string> names;
    for (std::size_t i = 0; i < open.size(); ++i) {
        Material& material = scene.materials[i];
        if (!open[i] || !is_body(material)) {
            continue;
        }
        material.thickness = -material.thickness;
        names.push_back(material.name);
    }
    return names;
}

}  // namespace raybundle
