// SPDX-License-Identifier: Apache-2.0
#include "stream/frame_encoder.h"

#include <gtest/gtest.h>
#include <png.h>
#include <turbojpeg.h>

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

}  // namespace
}  // namespace raybundle
