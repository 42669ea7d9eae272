// SPDX-License-Identifier: Apache-2.0
#include "stream/yuv_picture.h"

#include <algorithm>
#include <array>

namespace raybundle {
namespace {

/// A row of the matrix in 1/65536, for values 0..255 to the limited range.
using Weights = std::array<int, 3>;
constexpr double kRed = 0.2126;
constexpr double kBlue = 0.0722;
constexpr double kGreen = 1.0 - kRed - kBlue;

constexpr int fixed(double weight) {
    return static_cast<int>(weight * 65536.0 + (weight < 0.0 ? -0.5 : 0.5));
}

constexpr double kLuma = 219.0 / 255.0;
constexpr double kChromaU = 112.0 / 255.0 / (1.0 - kBlue);
constexpr double kChromaV = 112.0 / 255.0 / (1.0 - kRed);
constexpr Weights kY{fixed(kLuma * kRed), fixed(kLuma* kGreen), fixed(kLuma* kBlue)};
constexpr Weights kU{fixed(-kChromaU * kRed), fixed(-kChromaU* kGreen),
                     fixed(kChromaU*(1.0 - kBlue))};
constexpr Weights kV{fixed(kChromaV * (1.0 - kRed)), fixed(-kChromaV* kGreen),
                     fixed(-kChromaV* kBlue)};

/// Sums of `count` pixels (a power of two, its logarithm is `shift`) to one value of a plane.
std::uint8_t apply(const Weights& weights, const Weights& sums, int offset, int shift) {
    const int sum = weights[0] * sums[0] + weights[1] * sums[1] + weights[2] * sums[2];
    const int half = 1 << (15 + shift);
    return static_cast<std::uint8_t>(((sum + half) >> (16 + shift)) + offset);
}

}  // namespace

void convert_to_yuv(const PixelView& pixels, const YuvPlanes& planes) {
    const auto width = static_cast<std::size_t>(pixels.width);
    const auto height = static_cast<std::size_t>(pixels.height);
    const auto row_of = [&](std::size_t y) {
        return pixels.rgbx.data() + 4 * width * (pixels.bottom_up ? height - 1 - y : y);
    };
    for (std::size_t y = 0; y < height; ++y) {
        const std::uint8_t* in = row_of(y);
        std::uint8_t* out = planes.y + y * planes.y_stride;
        for (std::size_t x = 0; x < width; ++x, in += 4) {
            out[x] = apply(kY, {in[0], in[1], in[2]}, 16, 0);
        }
    }
    for (std::size_t y = 0; y < height; y += 2) {
        const std::uint8_t* const upper = row_of(y);
        const std::uint8_t* const lower = row_of(std::min(y + 1, height - 1));
        std::uint8_t* const u = planes.u + y / 2 * planes.uv_stride;
        std::uint8_t* const v = planes.v + y / 2 * planes.uv_stride;
        for (std::size_t x = 0; x < width; x += 2) {
            const std::size_t left = 4 * x;
            const std::size_t right = 4 * std::min(x + 1, width - 1);
            Weights sums{};
            for (std::size_t i = 0; i < 3; ++i) {
                sums[i] = upper[left + i] + upper[right + i] + lower[left + i] + lower[right + i];
            }
            u[x / 2] = apply(kU, sums, 128, 2);
            v[x / 2] = apply(kV, sums, 128, 2);
        }
    }
}

}  // namespace raybundle
