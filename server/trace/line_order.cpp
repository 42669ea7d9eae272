// SPDX-License-Identifier: Apache-2.0
#include "trace/line_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raybundle {

namespace {

/// faces_far() of shaders/bundle/parallel.glsl.
bool faces_far(const LineHit& hit) {
    return (hit.surface & 1U) == 0U;
}

bool before(const LineHit& a, const LineHit& b) {
    const auto rank = [](const LineHit& hit) {
        return faces_far(hit) ? ~hit.surface : hit.surface;
    };
    return a.depth != b.depth ? a.depth < b.depth : rank(a) < rank(b);
}

/// Whether two surfaces are one plane, back to back.
bool coincide(const LineHit& a, const LineHit& b, const LineOrder& order) {
    const float length_a = glm::length(a.normal);
    const float length_b = glm::length(b.normal);
    if (glm::dot(a.normal, b.normal) >= -0.9999F * length_a * length_b) {
        return false;
    }
    const float cosine = std::max(std::abs(glm::dot(a.normal, order.axis)) / length_a,
                                  std::abs(glm::dot(b.normal, order.axis)) / length_b);
    return std::abs(a.depth - b.depth) * cosine <= order.tie;
}

}  // namespace

void order_line(std::span<LineHit> hits, const LineOrder& order) {
    for (std::size_t i = 1; i < hits.size(); ++i) {
        const LineHit hit = hits[i];
        std::size_t k = i;
        for (; k > 0 && before(hit, hits[k - 1]); --k) {
            hits[k] = hits[k - 1];
        }
        hits[k] = hit;
    }
    if (order.tie <= 0.0F) {
        return;
    }
    for (std::size_t i = 0; i + 1 < hits.size(); ++i) {
        for (std::size_t k = i + 1;
             k < hits.size() && faces_far(hits[i]) && hits[k].depth <= hits[i].depth + order.range;
             ++k) {
            if (!faces_far(hits[k]) && coincide(hits[i], hits[k], order)) {
                std::swap(hits[i].surface, hits[k].surface);
                std::swap(hits[i].normal, hits[k].normal);
            }
        }
    }
}

}  // namespace raybundle
