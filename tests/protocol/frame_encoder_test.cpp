// SPDX-License-Identifier: Apache-2.0
#include "stream/frame_encoder.h"

#include <gtest/gtest.h>
#include <png.h>
#include <turbojpeg.h>
#include <zlib.h>

#include <chrono>
#include <cstdlib>
#include <future>
#include <stdexcept>

#include "stream/image_encoder.h"

namespace raybundle {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Lower half red, upper half blue, in OpenGL's order of rows.
Bytes two_colours(int width, int height) {
    Bytes pixels;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool low = y < height / 2;
            pixels.insert(pixels.end(), {static_cast<std::uint8_t>(low ? 255 : 0), 0,
                                         static_cast<std::uint8_t>(low ? 0 : 255), 77});
        }
    }
    return pixels;
}

Bytes decode_jpeg(const Bytes& jpeg, int width, int height) {
    tjhandle decoder = tjInitDecompress();
    Bytes rgb(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    EXPECT_EQ(
        tjDecompress2(decoder, jpeg.data(), jpeg.size(), rgb.data(), width, 0, height, TJPF_RGB, 0),
        0);
    tjDestroy(decoder);
    return rgb;
}

int jpeg_sampling(const Bytes& jpeg) {
    tjhandle decoder = tjInitDecompress();
    int width = 0;
    int height = 0;
    int sampling = -1;
    int colours = 0;
    tjDecompressHeader3(decoder, jpeg.data(), jpeg.size(), &width, &height, &sampling, &colours);
    tjDestroy(decoder);
    return sampling;
}

Bytes decode_png(const Bytes& png, int width, int height) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&image, png.data(), png.size()), 0);
    EXPECT_EQ(static_cast<int>(image.width), width);
    EXPECT_EQ(static_cast<int>(image.height), height);
    image.format = PNG_FORMAT_RGB;
    Bytes rgb(PNG_IMAGE_SIZE(image));
    EXPECT_NE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr), 0);
    return rgb;
}

EncodeJob job(ViewerId viewer, std::uint32_t frame, int width = 64, int height = 48) {
    EncodeJob result;
    result.viewer = viewer;
    result.header.set_frame(frame);
    result.header.set_codec(v1::JPEG);
    result.header.set_quality(80);
    result.header.set_width(static_cast<std::uint32_t>(width));
    result.header.set_height(static_cast<std::uint32_t>(height));
    result.pixels = two_colours(width, height);
    return result;
}

TEST(ImageEncoder, PngIsLosslessAndTheRightWayUp) {
    const Bytes pixels = two_colours(33, 20);
    const Bytes rgb = decode_png(encode_png({pixels, 33, 20, true}), 33, 20);
    EXPECT_EQ(rgb[0], 0);
    EXPECT_EQ(rgb[2], 255);
    EXPECT_EQ(rgb[rgb.size() - 3], 255);
    EXPECT_EQ(rgb[rgb.size() - 1], 0);
    EXPECT_EQ(decode_png(encode_png({pixels, 33, 20, false}), 33, 20)[0], 255);
}

TEST(ImageEncoder, JpegIsCloseAndTheRightWayUp) {
    const Bytes pixels = two_colours(33, 20);
    JpegEncoder encoder;
    const Bytes rgb =
        decode_jpeg(encoder.encode({pixels, 33, 20, true}, 95, ChromaSampling::full), 33, 20);
    EXPECT_LT(rgb[0], 20);
    EXPECT_GT(rgb[2], 235);
    EXPECT_GT(rgb[rgb.size() - 3], 235);
}

TEST(ImageEncoder, RefusesBuffersThatAreTooSmall) {
    const Bytes pixels(10);
    JpegEncoder encoder;
    EXPECT_THROW(encoder.encode({pixels, 2, 2, true}, 80, ChromaSampling::full),
                 std::runtime_error);
    EXPECT_THROW(encode_png({pixels, 0, 2, true}), std::runtime_error);
    EXPECT_THROW(encode_png({pixels, -1, -2, true}), std::runtime_error);
}

TEST(FrameEncoder, ChromaIsFullFromQualityNinety) {
    for (const auto& [quality, sampling] : {std::pair{85U, TJSAMP_420}, {95U, TJSAMP_444}}) {
        std::promise<EncodedFrame> encoded;
        FrameEncoder encoder(1, [&](EncodedFrame f) { encoded.set_value(std::move(f)); });
        EncodeJob next = job(1, 1);
        next.header.set_quality(quality);
        encoder.submit(std::move(next));
        EXPECT_EQ(jpeg_sampling(encoded.get_future().get().bytes), sampling);
    }
}

TEST(FrameEncoder, KeepsTheNewestJobOfEachViewerOnly) {
    std::promise<void> started;
    std::promise<void> release;
    std::mutex mutex;
    std::vector<std::pair<ViewerId, std::uint32_t>> delivered;
    {
        FrameEncoder encoder(1, [&](const EncodedFrame& f) {
            if (f.header.frame() == 1) {
                started.set_value();
                release.get_future().wait();
            }
            const std::lock_guard lock(mutex);
            delivered.emplace_back(f.viewer, f.header.frame());
        });
        encoder.submit(job(1, 1));
        started.get_future().wait();
        for (std::uint32_t frame = 2; frame < 50; ++frame) {
            encoder.submit(job(1, frame));
            encoder.submit(job(2, frame));
            encoder.submit(job(3, frame));
        }
        encoder.forget(3);
        EXPECT_TRUE(encoder.busy(1));
        EXPECT_FALSE(encoder.busy(3));
        release.set_value();
        while (encoder.busy(1) || encoder.busy(2)) {
            std::this_thread::yield();
        }
    }
    EXPECT_EQ(delivered,
              (std::vector<std::pair<ViewerId, std::uint32_t>>{{1, 1}, {1, 49}, {2, 49}}));
}

TEST(FrameEncoder, DropsWhatCannotBeEncodedAndGoesOn) {
    std::promise<EncodedFrame> encoded;
    FrameEncoder encoder(1, [&](EncodedFrame f) { encoded.set_value(std::move(f)); });
    EncodeJob broken = job(1, 1);
    broken.pixels.resize(5);
    encoder.submit(std::move(broken));
    while (encoder.busy(1)) {
        std::this_thread::yield();
    }
    encoder.submit(job(1, 2));
    EXPECT_EQ(encoded.get_future().get().header.frame(), 2U);
}

TEST(FrameEncoder, FramesOfAViewerStayInOrder) {
    std::mutex mutex;
    std::uint32_t last = 0;
    bool ordered = true;
    {
        FrameEncoder encoder(3, [&](const EncodedFrame& f) {
            const std::lock_guard lock(mutex);
            ordered = ordered && f.header.frame() > last;
            last = f.header.frame();
        });
        for (std::uint32_t frame = 1; frame <= 200; ++frame) {
            encoder.submit(job(1, frame, 64, frame % 2 == 0 ? 16 : 128));
            std::this_thread::yield();
        }
        while (encoder.busy(1)) {
            std::this_thread::yield();
        }
    }
    EXPECT_TRUE(ordered);
    EXPECT_EQ(last, 200U);
}

/// What a client does with the bytes; see protocol/README.md.
std::vector<double> decode_depths(const v1::FrameHeader& header, const Bytes& bytes) {
    const std::size_t columns = header.depth_columns();
    const std::size_t points = columns * header.depth_rows();
    Bytes rest(2 * points);
    uLongf size = rest.size();
    EXPECT_EQ(uncompress(rest.data(), &size, bytes.data(), bytes.size()), Z_OK);
    EXPECT_EQ(size, rest.size());
    std::vector<std::uint16_t> values(points);
    std::vector<double> inverse(points);
    const auto at = [&](std::size_t column, std::size_t row) {
        return column == 0 || row == 0 ? 0 : int{values[(row - 1) * columns + column - 1]};
    };
    for (std::size_t i = 0; i < points; ++i) {
        const int zigzag = rest[i] | (rest[points + i] << 8);
        const int difference = (zigzag >> 1) ^ -(zigzag & 1);
        const std::size_t column = i % columns + 1;
        const std::size_t row = i / columns + 1;
        const int left = at(column - 1, row);
        values[i] = static_cast<std::uint16_t>(left + at(column, row - 1) -
                                               at(column - 1, row - 1) + difference);
        inverse[i] = values[i] / 65535.0 / static_cast<double>(header.depth_nearest());
    }
    return inverse;
}

EncodedFrame encoded_with(DepthMap depths) {
    std::promise<EncodedFrame> promise;
    FrameEncoder encoder(1, [&](EncodedFrame frame) { promise.set_value(std::move(frame)); });
    EncodeJob job{7, {}, two_colours(32, 16), false, std::move(depths)};
    job.header.set_codec(v1::JPEG);
    job.header.set_quality(80);
    job.header.set_width(32);
    job.header.set_height(16);
    encoder.submit(std::move(job));
    return promise.get_future().get();
}

/// A floor seen at a slant, a box before it, and nothing above.
DepthMap floor_and_box() {
    DepthMap depths{160, 120, {}};
    for (unsigned row = 0; row < depths.rows; ++row) {
        for (unsigned column = 0; column < depths.columns; ++column) {
            const bool box = column > 40 && column < 90 && row > 30 && row < 80;
            const float floor = 0.004F * static_cast<float>(row) - 0.1F;
            depths.inverse.push_back(box ? 0.5F : std::max(floor, 0.0F));
        }
    }
    return depths;
}

TEST(FrameEncoder, DepthsFollowTheImageAndComeOutAsTheyWentIn) {
    const DepthMap depths = floor_and_box();
    const EncodedFrame frame = encoded_with(depths);
    const std::size_t length = frame.header.depth_bytes();
    ASSERT_LT(length, frame.bytes.size());
    EXPECT_EQ(frame.header.depth_columns(), depths.columns);
    EXPECT_EQ(frame.header.depth_rows(), depths.rows);
    EXPECT_NEAR(static_cast<double>(frame.header.depth_nearest()), 1.0 / 0.5, 1e-6);
    EXPECT_LT(length, 3000U) << "planes and silhouettes are all there is to tell";
    const auto middle = frame.bytes.end() - static_cast<std::ptrdiff_t>(length);
    const auto inverse = decode_depths(frame.header, Bytes(middle, frame.bytes.end()));
    for (std::size_t i = 0; i < inverse.size(); ++i) {
        ASSERT_NEAR(inverse[i], static_cast<double>(depths.inverse[i]), 0.5 / 65535.0) << i;
    }
    EXPECT_EQ(decode_jpeg(Bytes(frame.bytes.begin(), middle), 32, 16).size(), 32U * 16U * 3U);
}

TEST(FrameEncoder, DepthsOfNothingAtAllAndOfNoiseAreDepthsToo) {
    DepthMap nothing{3, 2, std::vector<float>(6, 0.0F)};
    const EncodedFrame empty = encoded_with(nothing);
    EXPECT_EQ(empty.header.depth_nearest(), 0.0F);
    EXPECT_GT(empty.header.depth_bytes(), 0U);
    DepthMap noise{64, 64, {}};
    std::uint32_t state = 1;
    for (int i = 0; i < 64 * 64; ++i) {
        state = state * 1664525U + 1013904223U;
        noise.inverse.push_back(static_cast<float>(state >> 8U) * 0x1p-24F * 7.0F);
    }
    const EncodedFrame frame = encoded_with(noise);
    const auto middle = frame.bytes.end() - static_cast<std::ptrdiff_t>(frame.header.depth_bytes());
    const auto inverse = decode_depths(frame.header, Bytes(middle, frame.bytes.end()));
    for (std::size_t i = 0; i < inverse.size(); ++i) {
        ASSERT_NEAR(inverse[i], static_cast<double>(noise.inverse[i]), 7.0 / 65535.0) << i;
    }
}

TEST(FrameEncoder, WithoutDepthsAFrameSaysNothingOfThem) {
    const EncodedFrame frame = encoded_with({});
    EXPECT_FALSE(frame.header.has_depth_bytes());
    EXPECT_FALSE(frame.header.has_depth_nearest());
}

}  // namespace
}  // namespace raybundle
