// SPDX-License-Identifier: Apache-2.0
#include "reference/measures/image_metrics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace raybundle {
namespace {

constexpr double mrse_floor = 0.01;       // of the mean
constexpr double luminance_floor = 1e-3;  // of the mean

double luminance_of(const glm::dvec3& rgb) {
    return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

void require_finite(std::span<const glm::dvec3> image, const char* which) {
    for (const glm::dvec3& v : image) {
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
            throw std::invalid_argument(std::string(which) + " has a value that is not finite");
        }
    }
}

/// Value below which a share of the values lies: nearest rank.
double percentile(std::vector<double>& values, double share) {
    const auto rank = static_cast<std::size_t>(
        std::max(std::ceil(share * static_cast<double>(values.size())) - 1.0, 0.0));
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Calls visit(I, R) for every pixel that counts.
template <typename Visit>
void for_each_measured(std::span<const glm::dvec3> image, std::span<const glm::dvec3> reference,
                       const std::vector<bool>& measured, const Visit& visit) {
    for (std::size_t i = 0; i < image.size(); ++i) {
        if (measured[i]) {
            visit(image[i], reference[i]);
        }
    }
}

}  // namespace

ImageMetrics compare_images(std::span<const glm::dvec3> image,
                            std::span<const glm::dvec3> reference,
                            const std::vector<bool>& measured) {
    if (image.size() != reference.size() || image.size() != measured.size()) {
        throw std::invalid_argument("pictures of different sizes");
    }
    require_finite(image, "the picture");
    require_finite(reference, "the reference");
    ImageMetrics result;
    double difference = 0.0;
    double square = 0.0;
    glm::dvec3 sum(0.0);
    for_each_measured(image, reference, measured, [&](const glm::dvec3& i, const glm::dvec3& r) {
        difference += glm::dot(i - r, i - r);
        square += glm::dot(r, r);
        sum += r;
        ++result.pixels;
    });
    if (result.pixels == 0) {
        throw std::invalid_argument("no pixel is left to measure");
    }
    const auto count = static_cast<double>(result.pixels);
    const double mean = (sum.r + sum.g + sum.b) / (3.0 * count);
    if (!(square > 0.0) || !(mean > 0.0)) {
        throw std::invalid_argument("the reference is black");
    }
    const double least = luminance_floor * luminance_of(sum) / count;
    std::vector<double> relative;
    relative.reserve(result.pixels);
    for_each_measured(image, reference, measured, [&](const glm::dvec3& i, const glm::dvec3& r) {
        const glm::dvec3 ratio = (i - r) / (r + mrse_floor * mean);
        result.mrse += glm::dot(ratio, ratio);
        relative.push_back(std::abs(luminance_of(i) - luminance_of(r)) /
                           std::max(luminance_of(r), least));
    });
    result.mrse /= 3.0 * count;
    result.relative_rmse = std::sqrt(difference / square);
    result.median = percentile(relative, 0.5);
    result.p95 = percentile(relative, 0.95);
    return result;
}

std::vector<bool> without_emitters(const std::vector<bool>& sees_emitter, glm::uvec2 size) {
    std::vector<bool> measured(sees_emitter.size(), true);
    const auto width = static_cast<int>(size.x);
    const auto height = static_cast<int>(size.y);
    const auto index = [width](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (!sees_emitter[index(x, y)]) {
                continue;
            }
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j) {
                for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i) {
                    measured[index(i, j)] = false;
                }
            }
        }
    }
    return measured;
}

}  // namespace raybundle
