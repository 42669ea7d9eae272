// SPDX-License-Identifier: Apache-2.0
#include "scene/neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace raybundle {
namespace {

constexpr double gap = 3.0;                 // radii: from there on the scene's diameter doubles
constexpr double least_solid_angle = 3e-5;  // sr
constexpr double least_flux = 1e-3;         // of the neighbourhood's own

/// Coordinate on whose both sides lies half of the area.
float median(std::span<const ScenePiece> pieces, std::vector<std::size_t>& order, int axis,
             double half_area) {
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return pieces[a].centre[axis] < pieces[b].centre[axis];
    });
    double sum = 0.0;
    for (const std::size_t i : order) {
        sum += static_cast<double>(pieces[i].area);
        if (sum >= half_area) {
            return pieces[i].centre[axis];
        }
    }
    return pieces[order.back()].centre[axis];
}

/// Pieces as seen from afar. They are turned at random, so that half of their area is seen; those
/// that emit face who sees them.
struct Seen {
    double solid_angle = 0.0;  // sr
    double illuminance = 0.0;  // lx

    void add(const ScenePiece& piece, double distance) {
        const double square = std::max(distance * distance, 1e-30);
        solid_angle += 0.5 * static_cast<double>(piece.area) / square;
        illuminance += static_cast<double>(piece.emission) / square;
    }
};

/// Compares fluxes over pi.
bool matters_little(const Seen& seen, const Neighbourhood& neighbourhood) {
    const double arriving = seen.illuminance * neighbourhood.radius * neighbourhood.radius;
    return seen.solid_angle < least_solid_angle && arriving <= least_flux * neighbourhood.emission;
}

/// The pieces as seen from the median of their area.
class Surroundings {
  public:
    explicit Surroundings(std::span<const ScenePiece> pieces)
        : pieces_(pieces), order_(pieces.size()), distance_(pieces.size()) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        for (const ScenePiece& piece : pieces) {
            half_area_ += 0.5 * static_cast<double>(piece.area);
        }
        for (int axis = 0; axis < 3; ++axis) {
            middle_[axis] = median(pieces, order_, axis, half_area_);
        }
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            distance_[i] = static_cast<double>(glm::distance(pieces[i].centre, middle_));
        }
    }

    Neighbourhood neighbourhood() {
        Neighbourhood result;
        result.middle = middle_;
        result.radius = core_radius();
        std::sort(order_.begin(), order_.end(),
                  [&](std::size_t a, std::size_t b) { return nearest(a) < nearest(b); });
        const std::vector<Seen> beyond = seen_beyond();
        for (std::size_t k = 0; k < order_.size(); ++k) {
            if (nearest(order_[k]) > gap * result.radius && matters_little(beyond[k], result)) {
                result.strays.assign(order_.begin() + static_cast<std::ptrdiff_t>(k), order_.end());
                std::sort(result.strays.begin(), result.strays.end());
                break;
            }
            result.radius = std::max(result.radius, farthest(order_[k]));
            result.emission += static_cast<double>(pieces_[order_[k]].emission);
        }
        return result;
    }

  private:
    [[nodiscard]] double nearest(std::size_t i) const {
        return distance_[i] - static_cast<double>(pieces_[i].radius);
    }
    [[nodiscard]] double farthest(std::size_t i) const {
        return distance_[i] + static_cast<double>(pieces_[i].radius);
    }

    /// Of the smallest ball that holds half of the area.
    double core_radius() {
        std::sort(order_.begin(), order_.end(),
                  [&](std::size_t a, std::size_t b) { return farthest(a) < farthest(b); });
        double sum = 0.0;
        for (const std::size_t i : order_) {
            sum += static_cast<double>(pieces_[i].area);
            if (sum >= half_area_) {
                return farthest(i);
            }
        }
        return farthest(order_.back());
    }

    /// Of each place in order_: all pieces from there on.
    [[nodiscard]] std::vector<Seen> seen_beyond() const {
        std::vector<Seen> beyond(order_.size() + 1);
        for (std::size_t k = order_.size(); k-- > 0;) {
            beyond[k] = beyond[k + 1];
            beyond[k].add(pieces_[order_[k]], nearest(order_[k]));
        }
        return beyond;
    }

    std::span<const ScenePiece> pieces_;
    std::vector<std::size_t> order_;
    std::vector<double> distance_;  // of centres from the middle, m
    double half_area_ = 0.0;
    glm::vec3 middle_{0.0F};
};

}  // namespace

bool Neighbourhood::has_lost(const ScenePiece& piece) const {
    const double distance = static_cast<double>(glm::distance(piece.centre, middle)) -
                            static_cast<double>(piece.radius);
    Seen seen;
    seen.add(piece, distance);
    return distance > gap * radius && matters_little(seen, *this);
}

Neighbourhood find_neighbourhood(std::span<const ScenePiece> pieces) {
    return pieces.empty() ? Neighbourhood{} : Surroundings(pieces).neighbourhood();
}

}  // namespace raybundle
