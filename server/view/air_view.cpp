// SPDX-License-Identifier: Apache-2.0
#include "view/air_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace raybundle {
namespace {

constexpr double wanted_noise = 0.05;  // relative, of what is averaged over pixels
constexpr std::uint32_t chunk_size = 256;
constexpr unsigned block_edge = 8;  // pixels along an edge, over which paths scatter alike
constexpr std::uint64_t seed_of_views = 0x61697276696577ULL;  // other paths than those of patches
constexpr double to_the_sky = std::numeric_limits<double>::infinity();
// The additive recurrence of Roberts 2018 in the plane.
constexpr double recurrence_x = 0.7548776662466927, recurrence_y = 0.5698402909980532;

double fraction_of(double value) {
    return value - std::floor(value);
}

/// Mean of each value and those around it, up to `radius` pixels away along rows and columns.
std::vector<glm::dvec4> mean_around(const std::vector<glm::dvec4>& values, glm::uvec2 size,
                                    unsigned radius) {
    // Sums over all pixels left of and below each make sums over rectangles.
    std::vector<glm::dvec4> sums(std::size_t{size.x + 1} * (size.y + 1), glm::dvec4(0.0));
    const auto at = [&](unsigned x, unsigned y) -> glm::dvec4& {
        return sums[std::size_t{y} * (size.x + 1) + x];
    };
    for (unsigned y = 0; y < size.y; ++y) {
        glm::dvec4 row(0.0);
        for (unsigned x = 0; x < size.x; ++x) {
            row += values[std::size_t{y} * size.x + x];
            at(x + 1, y + 1) = at(x + 1, y) + row;
        }
    }
    std::vector<glm::dvec4> means(values.size());
    for (unsigned y = 0; y < size.y; ++y) {
        const unsigned y0 = y > radius ? y - radius : 0;
        const unsigned y1 = std::min(y + radius + 1, size.y);
        for (unsigned x = 0; x < size.x; ++x) {
            const unsigned x0 = x > radius ? x - radius : 0;
            const unsigned x1 = std::min(x + radius + 1, size.x);
            means[std::size_t{y} * size.x + x] =
                (at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0)) /
                (static_cast<double>(x1 - x0) * (y1 - y0));
        }
    }
    return means;
}

}  // namespace

void AirView::begin(const layout::ViewParameters& view, glm::uvec2 size, unsigned factor) {
    const bool same =
        view.clip_from_world == view_.clip_from_world && view.eye == view_.eye && size == size_;
    view_ = view;
    size_ = size;
    const bool same_factor = factor == factor_;
    factor_ = factor;
    if (!same) {
        restart();
    } else if (!same_factor && paths_ > 0) {
        upload();
    }
}

void AirView::restart() {
    paths_ = 0;
    batches_ = 0;
    next_upload_ = 0;
    sums_.assign(std::size_t{size_.x} * size_.y, glm::dvec4(0.0));
    by_surfaces_.assign(sums_.size(), glm::dvec3(0.0));
    const glm::uvec2 blocks = (size_ + block_edge - 1U) / block_edge;
    scatter_.assign(std::size_t{blocks.x} * blocks.y, glm::dvec3(0.0));
}

AirView::Sample AirView::sample(const AirPaths& air, std::uint64_t number) const {
    AirRandom random(seed_of_views, number);
    const auto n = static_cast<double>(number);
    const glm::dvec2 at(fraction_of(0.5 + n * recurrence_x), fraction_of(0.5 + n * recurrence_y));
    const glm::vec2 ndc(2.0 * at - 1.0);
    const glm::vec3 direction = glm::normalize(
        glm::vec3(view_.forward) + ndc.x * glm::vec3(view_.right) + ndc.y * glm::vec3(view_.up));
    const glm::uvec2 pixel = glm::min(glm::uvec2(at * glm::dvec2(size_)), size_ - 1U);
    const glm::vec3 eye(view_.eye);
    const std::optional<AirScene::Hit> hit = air.surfaces().meet(eye, direction, random);
    const double end = hit ? static_cast<double>(hit->distance) : to_the_sky;
    return {pixel.y * size_.x + pixel.x, air.along(eye, direction, end, random),
            air.opacity(air.way(eye, direction, end))};
}

void AirView::note_scatter(const Sample& sample) {
    const glm::uvec2 at(sample.pixel % size_.x, sample.pixel / size_.x);
    const auto light = static_cast<double>(luminance(glm::vec3(sample.light.all())));
    scatter_[std::size_t{at.y / block_edge} * ((size_.x + block_edge - 1) / block_edge) +
             at.x / block_edge] += glm::dvec3(1.0, light, light * light);
}

void AirView::refine(const ScatteredLight& light, float unit) {
    if (changes_ != light.changes()) {
        changes_ = light.changes();
        restart();
    }
    std::vector<Sample> samples(batch_paths);
    const AirPaths air = light.paths();
    tbb::parallel_for(std::uint32_t{0}, batch_paths / chunk_size, [&](std::uint32_t chunk) {
        for (std::uint32_t i = chunk * chunk_size; i < (chunk + 1) * chunk_size; ++i) {
            samples[i] = sample(air, paths_ + i);
        }
    });
    unit_ = unit;
    reflected_flux_ = light.reflected_flux();
    const auto weight = static_cast<double>(++batches_);
    for (const Sample& s : samples) {
        sums_[s.pixel] += weight * glm::dvec4(s.light.lamps, s.opacity);
        by_surfaces_[s.pixel] +=
            weight * s.light.surfaces / glm::max(reflected_flux_, glm::dvec3(1e-300));
        note_scatter(s);
    }
    paths_ += batch_paths;
    if (paths_ >= next_upload_) {
        constexpr std::uint64_t share = 8;
        upload();
        next_upload_ = paths_ + paths_ / share;
    }
}

/// Variance of single paths, relative to the square of their mean over neighbours.
double AirView::relative_variance() const {
    double variance = 0.0;
    double squares = 0.0;
    for (const glm::dvec3& s : scatter_) {
        if (s.x > 1.0) {
            variance += std::max(s.z - s.y * s.y / s.x, 0.0) * s.x / (s.x - 1.0);
            squares += s.y * s.y / s.x;
        }
    }
    return squares > 0.0 ? variance / squares : 0.0;
}

void AirView::upload() {
    // Weights that rise leave 3/4 of the paths.
    const double paths_of_pixel =
        0.75 * static_cast<double>(paths_) / static_cast<double>(sums_.size());
    const double variance = relative_variance();
    const double edge = std::sqrt(variance / (wanted_noise * wanted_noise * paths_of_pixel));
    // Two means over squares, one after the other, weigh as one over half as many pixels again.
    const auto r = static_cast<unsigned>(std::max(std::ceil(0.5 * (edge / 1.5 - 1.0)), 0.0));
    const double pixels = (1.5 * (2.0 * r + 1.0)) * (1.5 * (2.0 * r + 1.0));
    std::vector<glm::dvec4> smooth = sums_;
    for (std::size_t i = 0; i < smooth.size(); ++i) {
        smooth[i] += glm::dvec4(by_surfaces_[i] * reflected_flux_, 0.0);
    }
    if (r > 0) {
        smooth = mean_around(mean_around(smooth, size_, r), size_, r);
    }
    std::vector<glm::vec4> texels(1 + sums_.size());
    texels[0] = glm::vec4(size_, factor_,
                          std::min(variance / (paths_of_pixel * (r > 0 ? pixels : 1.0)), 1.0));
    const double share = 1.0 / static_cast<double>(unit_);
    const auto batches = static_cast<double>(batches_);
    const double weight_of_pixel =
        0.5 * batches * (batches + 1.0) * batch_paths / static_cast<double>(sums_.size());
    for (std::size_t i = 0; i < smooth.size(); ++i) {
        const glm::dvec4& sum = smooth[i];
        texels[1 + i] = sum.w > 0.0 ? glm::vec4(glm::dvec3(sum) * (share / sum.w),
                                                std::min(sum.w / weight_of_pixel, 1.0))
                                    : glm::vec4(0.0F);
    }
    const std::size_t bytes = texels.size() * sizeof(glm::vec4);
    if (texels_.bytes() != bytes) {
        texels_ = Buffer("air before pixels", bytes);
        texture_ = create_buffer_texture("air before pixels", GL_RGBA32F, texels_);
    }
    texels_.write<glm::vec4>(texels, 0);
}

void AirView::bind() const {
    glBindTextureUnit(UNIT_PIXEL_AIR, texture_.get());
}

std::size_t AirView::bytes() const {
    return texels_.bytes();
}

}  // namespace raybundle
