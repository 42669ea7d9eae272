// SPDX-License-Identifier: Apache-2.0
#include "view/final_picture.h"

#include <algorithm>
#include <cmath>

namespace raybundle {
namespace {

constexpr unsigned finest_grid = 8;
constexpr std::size_t most_pixels = std::size_t{1}
                                    << 21U;  // drawn, of all pictures but larger ones
constexpr std::uint64_t first_look = 64;     // iterations
/// Finer pixels are due when this share of the noise is less than what the pixels do not resolve.
/// That is estimated too low where light changes within them along edges.
constexpr double due_share = 0.2;
/// The finest ones, four times as many again, take most of the time from then on, so they are due
/// only where noise is not the larger part by much. Cornell box, 128x128, 20 s: 1.0 % of error,
/// 1.4 % where they were due as the coarser ones are.
constexpr double due_share_of_finest = 0.7;
/// Paths of a pixel for each iteration, at most, beside those of the first rounds: a few percent of
/// the time. Fewer where the squared error is known well.
constexpr double most_rounds = 0.03;  // of 8 paths
constexpr std::uint64_t first_rounds = 1;

std::size_t pixel_count(glm::uvec2 size, unsigned grid) {
    return std::size_t{size.x} * size.y * grid * grid;
}

/// Means of grid x grid elements. wide: size of the result; of `channels` numbers each.
template <typename Sum, typename Element, typename Finish>
auto means(const Element* fine, glm::uvec2 size, unsigned grid, unsigned channels, Finish finish) {
    std::vector<Element> result(std::size_t{size.x} * size.y * channels);
    std::vector<Sum> sums(std::size_t{size.x} * channels);
    const std::size_t row_length = std::size_t{size.x} * grid * channels;
    for (std::size_t y = 0; y < size.y; ++y) {
        std::fill(sums.begin(), sums.end(), Sum{});
        for (std::size_t row = y * grid; row < (y + 1) * grid; ++row) {
            for (std::size_t i = 0; i < row_length; ++i) {
                sums[i / (grid * channels) * channels + i % channels] +=
                    Sum(fine[row * row_length + i]);
            }
        }
        std::transform(sums.begin(), sums.end(),
                       result.begin() + static_cast<std::ptrdiff_t>(y * sums.size()), finish);
    }
    return result;
}

}  // namespace

FinalPicture::FinalPicture(const GpuScene& scene, const RadianceStore& store,
                           const ViewPrograms& programs, const Camera& camera, glm::uvec2 size,
                           PixelGrid grid)
    : size_(glm::max(size, glm::uvec2(1))),
      most_grid_(grid == PixelGrid::adaptive ? finest_grid : 1),
      next_look_(first_look),
      image_(scene, store, programs, size_) {
    while (most_grid_ > 1 && pixel_count(size_, most_grid_) > most_pixels) {
        most_grid_ /= 2;
    }
    image_.set_camera(camera);
    image_.rest();
}

bool FinalPicture::may_refine() const {
    return grid_ < most_grid_;
}

/// Whether pixels that are drawn as so many along an edge are to be drawn as twice as many.
/// unresolved, noise: relative, as they are then.
bool FinalPicture::finer_is_due(unsigned grid, double unresolved, double noise) const {
    const double share = 2 * grid == finest_grid ? due_share_of_finest : due_share;
    return 2 * grid <= most_grid_ && unresolved > share * noise;
}

void FinalPicture::prepare() {
    if (may_refine() && iterations_ == next_look_) {
        next_look_ *= 2;
        measure();
        if (statistics_.known &&
            finer_is_due(grid_, statistics_.discretisation, statistics_.noise)) {
            image_.refine(2);
            grid_ *= 2;
            image_.smooth();
            measure();  // what was found of the coarser pixels holds no more
        }
    }
    image_.smooth();
    ++iterations_;
}

const ImageStatistics& FinalPicture::measure() {
    image_.request_statistics();
    image_.finish_statistics();
    by_samples_ = image_.statistics();
    if (check_ != nullptr && by_samples_.known) {
        measure_pixels();
    }
    statistics_ = measured_.with(by_samples_);
    return statistics_;
}

/// Traces paths until the true error is known well, or as many as there is time for.
void FinalPicture::measure_pixels() {
    const std::vector<glm::vec4> picture = read_radiance();
    check_->look_for_sparks(picture);
    SquaredError square = check_->measure(picture);
    if (iterations_ >= next_check_) {
        next_check_ = static_cast<std::uint64_t>(
            std::ceil(next_check_factor * static_cast<double>(iterations_)));
        const std::uint64_t most =
            first_rounds +
            static_cast<std::uint64_t>(most_rounds * static_cast<double>(iterations_));
        while (square.standard_error > known_well * square.value && check_->rounds() < most) {
            check_->add_round();
            square = check_->measure(picture);
        }
    }
    checked_ = {square, check_->pixels(), check_->rounds() * ImageEstimate::batches};
    measured_.take(square, by_samples_);
}

bool FinalPicture::meets(double target) const {
    return may_refine() ? statistics_.error_high <= target : statistics_.meets(target);
}

double FinalPicture::samples_factor_to(double target) const {
    const SampleOrder order = image_.sample_order();
    const auto samples = static_cast<double>(by_samples_.samples);
    double unresolved = 1.0;
    for (unsigned grid = grid_;; grid *= 2) {
        const double factor = measured_.samples_factor_to(target, by_samples_, order, unresolved);
        double noise = 0.0;
        if (std::isfinite(factor)) {
            const auto then = static_cast<std::uint64_t>(std::min(samples * factor, 1e18));
            noise = by_samples_.noise *
                    std::sqrt(variance_of_mean(then, order) /
                              variance_of_mean(by_samples_.samples, order) / factor);
        }
        if (!finer_is_due(grid, unresolved * statistics_.discretisation, noise)) {
            return factor;
        }
        unresolved = unresolved_share(2 * grid) / unresolved_share(grid_);
    }
}

std::vector<glm::vec4> FinalPicture::read_radiance() {
    const std::vector<glm::vec4> fine = image_.read_radiance();
    const auto count = static_cast<float>(grid_ * grid_);
    return means<glm::dvec4>(fine.data(), size_, grid_, 1, [count](const glm::dvec4& sum) {
        return glm::vec4(sum / double{count});
    });
}

std::vector<std::uint8_t> FinalPicture::read_display() {
    image_.compose(DisplayMode::photo, image_.automatic_exposure());
    const std::span<const std::uint8_t> fine = image_.take();
    const unsigned count = grid_ * grid_;
    return means<unsigned>(fine.data(), size_, grid_, 4, [count](unsigned sum) {
        return static_cast<std::uint8_t>((sum + count / 2) / count);
    });
}

}  // namespace raybundle
