// SPDX-License-Identifier: Apache-2.0
// VP9 by libvpx, decoded by its decoder. The shelves of the test picture move as a camera's turn
// moves them.
#include "stream/video_encoder.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <vpx/vp8dx.h>
#include <vpx/vpx_decoder.h>

#include <cmath>
#include <stdexcept>

#include "net/ws/viewer_link.h"
#include "session/viewers/video_frames.h"
#include "stream/video_encoders.h"
#include "stream/yuv_picture.h"

namespace raybundle {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Soft shading with edges, moved by `shift` pixels; row 0 at the top.
Bytes shelves(int width, int height, int shift) {
    Bytes pixels;
    pixels.reserve(static_cast<std::size_t>(4) * static_cast<std::size_t>(width * height));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int place = x + shift;
            const bool board = (place / 40 + y / 30) % 2 == 0;
            const double shade = 0.5 + 0.5 * std::sin(0.02 * place) * std::cos(0.03 * y);
            const auto level = [&](double share) {
                return static_cast<std::uint8_t>((board ? 60.0 : 20.0) + share * 160.0 * shade);
            };
            pixels.insert(pixels.end(), {level(1.0), level(0.8), level(0.5), 0});
        }
    }
    return pixels;
}

struct Planes {
    int width = 0, height = 0;
    Bytes y, u, v;
};

Planes planes_of(const Bytes& pixels, int width, int height) {
    const auto luma = static_cast<std::size_t>(width);
    const auto chroma = (luma + 1) / 2;
    const auto rows = static_cast<std::size_t>(height);
    Planes planes{width, height, Bytes(luma * rows), Bytes(chroma * ((rows + 1) / 2)),
                  Bytes(chroma * ((rows + 1) / 2))};
    convert_to_yuv({pixels, width, height, false},
                   {planes.y.data(), planes.u.data(), planes.v.data(), luma, chroma});
    return planes;
}

class Decoder {
  public:
    Decoder() { EXPECT_EQ(vpx_codec_dec_init(&context_, vpx_codec_vp9_dx(), nullptr, 0), 0); }
    ~Decoder() { vpx_codec_destroy(&context_); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    /// Nothing where it cannot be decoded.
    std::optional<Planes> decode(const Bytes& bytes) {
        const auto size = static_cast<unsigned>(bytes.size());
        if (vpx_codec_decode(&context_, bytes.data(), size, nullptr, 0) != VPX_CODEC_OK) {
            return std::nullopt;
        }
        vpx_codec_iter_t next = nullptr;
        const vpx_image_t* const image = vpx_codec_get_frame(&context_, &next);
        if (image == nullptr) {
            return std::nullopt;
        }
        EXPECT_EQ(image->fmt, VPX_IMG_FMT_I420);
        EXPECT_EQ(image->cs, VPX_CS_BT_709);
        EXPECT_EQ(image->range, VPX_CR_STUDIO_RANGE);
        const auto width = static_cast<int>(image->d_w);
        const auto height = static_cast<int>(image->d_h);
        return Planes{width, height, plane(*image, 0, width, height),
                      plane(*image, 1, (width + 1) / 2, (height + 1) / 2),
                      plane(*image, 2, (width + 1) / 2, (height + 1) / 2)};
    }

  private:
    static Bytes plane(const vpx_image_t& image, int index, int width, int height) {
        Bytes bytes;
        for (int y = 0; y < height; ++y) {
            const unsigned char* const row = image.planes[index] + y * image.stride[index];
            bytes.insert(bytes.end(), row, row + width);
        }
        return bytes;
    }
    vpx_codec_ctx_t context_{};
};

/// Of luma, dB.
double psnr(const Planes& a, const Planes& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.y.size(); ++i) {
        sum += (a.y[i] - b.y[i]) * (a.y[i] - b.y[i]);
    }
    return 10.0 * std::log10(255.0 * 255.0 * static_cast<double>(a.y.size()) / std::max(sum, 1e-9));
}

constexpr int kWidth = 320;
constexpr int kHeight = 180;

VideoFrame encode(VideoEncoder& encoder, int shift, VideoFrameWish wish, int width = kWidth,
                  int height = kHeight) {
    return encoder.encode({shelves(width, height, shift), width, height, false}, wish);
}

TEST(VideoEncoder, ColoursAreThoseOfBt709) {
    // White, black, and pure red: Y 63, Cb 102, Cr 240 of BT.709 in limited range.
    const Bytes pixels{255, 255, 255, 0, 255, 255, 255, 0, 0, 0, 0, 0, 0,   0, 0, 0,
                       255, 0,   0,   0, 255, 0,   0,   0, 0, 0, 0, 0, 255, 0, 0, 0};
    const Planes planes = planes_of(pixels, 8, 1);
    EXPECT_EQ((Bytes{planes.y[0], planes.y[2], planes.y[4]}), (Bytes{235, 16, 63}));
    EXPECT_EQ((Bytes{planes.u[0], planes.u[1], planes.u[2]}), (Bytes{128, 128, 102}));
    EXPECT_EQ((Bytes{planes.v[0], planes.v[1], planes.v[2]}), (Bytes{128, 128, 240}));
}

/// At the finest quantizer that is allowed, step 8 of 63, coefficients are off by half a step of
/// VP9's table at the index that this is (about 32: step 33 in units of 1/8 of a level): uniformly
/// distributed errors of 4.1 levels' step have an rms of 4.1 / sqrt(12) = 1.2 levels, 46.6 dB. Dead
/// zones and skipped blocks cost up to 6 dB of that.
TEST(VideoEncoder, AMovingPictureComesOutAsItWentIn) {
    VideoEncoder encoder;
    Decoder decoder;
    for (int i = 0; i < 12; ++i) {
        const VideoFrame frame = encode(encoder, 3 * i, {60'000, false});
        EXPECT_EQ(frame.key, i == 0);
        const auto decoded = decoder.decode(frame.bytes);
        ASSERT_TRUE(decoded) << i;
        EXPECT_GE(psnr(*decoded, planes_of(shelves(kWidth, kHeight, 3 * i), kWidth, kHeight)), 40.0)
            << i;
    }
}

/// Rate control may be off by its buffer, 2.5 frames, over the run.
TEST(VideoEncoder, FramesTakeWhatTheLineLetsThem) {
    constexpr std::size_t kBytes = 1200;
    constexpr int kFrames = 30;
    VideoEncoder encoder;
    std::size_t key = 0;
    std::size_t others = 0;
    for (int i = 0; i <= kFrames; ++i) {
        const VideoFrame frame = encode(encoder, 5 * i, {kBytes, false});
        (i == 0 ? key : others) += frame.bytes.size();
    }
    EXPECT_LE(others, kBytes * kFrames + 5 * kBytes / 2);
    EXPECT_GT(key, 0U);
    // It follows a line that becomes slower.
    std::size_t slower = 0;
    for (int i = 0; i < kFrames; ++i) {
        slower += encode(encoder, 5 * (kFrames + 1 + i), {kBytes / 2, false}).bytes.size();
    }
    EXPECT_LE(slower, kBytes / 2 * kFrames + 5 * kBytes / 2);
}

TEST(VideoEncoder, AKeyFrameIsOneOnDemandAndNeedsNothingBeforeIt) {
    VideoEncoder encoder;
    for (int i = 0; i < 3; ++i) {
        encode(encoder, i, {8000, false});
    }
    const VideoFrame other = encode(encoder, 4, {8000, false});
    EXPECT_FALSE(other.key);
    EXPECT_FALSE(Decoder().decode(other.bytes)) << "it would show what it should not";
    const VideoFrame frame = encode(encoder, 5, {8000, true});
    EXPECT_TRUE(frame.key);
    Decoder late;
    EXPECT_TRUE(late.decode(frame.bytes));
    EXPECT_TRUE(late.decode(encode(encoder, 6, {8000, false}).bytes));
}

TEST(VideoEncoder, OddSizesAndChangesOfSizeAreKeyFramesOfThatSize) {
    VideoEncoder encoder;
    Decoder decoder;
    for (const auto& [width, height] :
         {std::pair{1, 1}, {2, 1}, {3, 5}, {17, 33}, {321, 181}, {64, 64}, {1, 200}, {33, 17}}) {
        for (int i = 0; i < 2; ++i) {
            const VideoFrame frame = encode(encoder, i, {20'000, false}, width, height);
            EXPECT_EQ(frame.key, i == 0);
            const auto decoded = decoder.decode(frame.bytes);
            ASSERT_TRUE(decoded) << width << "x" << height;
            EXPECT_EQ(std::pair(decoded->width, decoded->height), std::pair(width, height));
            const Planes meant = planes_of(shelves(width, height, i), width, height);
            EXPECT_GE(psnr(*decoded, meant), 35.0) << width << "x" << height;
        }
    }
}

TEST(VideoEncoder, RefusesWhatIsNoPictureAndGoesOnWithAKeyFrame) {
    VideoEncoder encoder;
    const Bytes pixels(10);
    EXPECT_THROW(encoder.encode({pixels, 2, 2, false}, {100, false}), std::runtime_error);
    EXPECT_THROW(encoder.encode({pixels, 0, 2, false}, {100, false}), std::runtime_error);
    EXPECT_THROW(encoder.encode({Bytes(4 * 8193), 8193, 1, false}, {100, false}),
                 std::runtime_error);
    EXPECT_TRUE(encode(encoder, 0, {8000, false}).key);
}

TEST(VideoEncoder, TheLargestPictureTakesNoMoreMemoryThanIsAccountedFor) {
    const auto in_use = [] {
        const struct mallinfo2 info = mallinfo2();
        return info.uordblks + info.hblkhd;
    };
    for (const auto& [width, height] : {std::pair{3840, 2160}, {640, 360}}) {
        const Bytes pixels(static_cast<std::size_t>(4) * static_cast<std::size_t>(width * height));
        const std::size_t before = in_use();
        VideoEncoder encoder;
        EXPECT_TRUE(encoder.encode({pixels, width, height, false}, {100'000, false}).key);
        EXPECT_FALSE(encoder.encode({pixels, width, height, false}, {100'000, false}).key);
        const std::size_t taken = in_use() - before;
        EXPECT_LE(taken, VideoEncoder::bytes_for(width, height)) << width;
        EXPECT_GE(2 * taken, VideoEncoder::bytes_for(width, height)) << width;
    }
}

TEST(VideoEncoders, OneForEachViewerAsFarAsThereIsMemory) {
    const std::size_t one = VideoEncoder::bytes_for(kWidth, kHeight);
    VideoEncoders videos(2 * one);
    const Bytes pixels = shelves(kWidth, kHeight, 0);
    const PixelView view{pixels, kWidth, kHeight, false};
    EXPECT_TRUE(videos.encode(1, view, {8000, false})->key);
    EXPECT_TRUE(videos.encode(2, view, {8000, false})->key);
    EXPECT_FALSE(videos.encode(1, view, {8000, false})->key);
    EXPECT_FALSE(videos.encode(3, view, {8000, false})) << "there is no room for three";
    EXPECT_EQ(videos.load().bytes, 2 * one);
    videos.end(1);
    EXPECT_EQ(videos.load().encoders, 1U);
    EXPECT_TRUE(videos.encode(3, view, {8000, false})->key);
    videos.end(2);
    videos.end(3);
    EXPECT_EQ(videos.load().bytes, 0U);
}

v1::FrameHeader header_of(std::uint32_t frame, bool key) {
    v1::FrameHeader header;
    header.set_frame(frame);
    header.set_codec(v1::VP9);
    header.set_key(key);
    header.set_width(kWidth);
    header.set_height(kHeight);
    header.set_quality(50);
    return header;
}

/// What was dropped, or could not be decoded, is followed by a key frame.
TEST(VideoLink, AsksForAKeyFrameWhereTheVideoIsBroken) {
    ViewerLink link(1, 100'000, {});
    const FrameDemand demand{true, false, kWidth * kHeight, true};
    v1::FrameHeader picture;
    picture.set_frame(1);
    picture.set_width(kWidth);
    picture.set_height(kHeight);
    picture.set_quality(80);
    EXPECT_EQ(link.advise(demand, 0.0).video_bytes, 0U) << "the line is not known yet";
    link.send_frame(picture, Bytes(4000));
    while (link.take(0.0)) {
    }
    v1::Ack ack;
    ack.set_frame(1);
    link.on_ack(ack, 40.0);
    const FrameAdvice known = link.advise(demand, 50.0);
    EXPECT_GT(known.video_bytes, 0U);
    EXPECT_FALSE(known.key);
    link.send_frame(header_of(2, true), Bytes(500));
    EXPECT_TRUE(link.send_frame(header_of(3, false), Bytes(100))) << "frame 2 still waits";
    const auto sent = link.take(60.0);
    ASSERT_TRUE(sent);
    const std::string text(sent->bytes.begin(), sent->bytes.end());
    EXPECT_NE(text.find("\"frame\":2"), std::string::npos) << "3 needs 2";
    ack.set_frame(2);
    link.on_ack(ack, 80.0);
    EXPECT_TRUE(link.advise(demand, 90.0).key);
    link.send_frame(header_of(4, true), Bytes(500));
    static_cast<void>(link.take(100.0));
    ack.set_frame(4);
    link.on_ack(ack, 120.0);
    EXPECT_FALSE(link.advise(demand, 130.0).key);
    ack.set_wants_key(true);
    link.on_ack(ack, 140.0);
    EXPECT_TRUE(link.advise(demand, 150.0).key);
}

TEST(VideoLink, PixelsBecomeFewerWhereTheQuantizerStaysCoarse) {
    CongestionWindow window;
    window.advise({true, false, 480'000, true}, 0.0);
    window.on_sent(1, 20'000, 80, 480'000, 0.0);
    window.on_ack(1, 0.0, 300.0);
    double now = 310.0;
    std::uint32_t frame = 1;
    const auto run = [&](int quality) {
        double scale = 0.0;
        for (int i = 0; i < 12; ++i, now += 40.0) {
            scale = window.advise({true, false, 480'000, true}, now).scale;
            window.on_video_sent(++frame, 1000, quality, false, now);
            window.on_ack(frame, 0.0, now + 20.0);
        }
        return scale;
    };
    EXPECT_EQ(run(60), 1.0);
    EXPECT_LT(run(12), 1.0);
    const double coarse = run(12);
    EXPECT_EQ(run(90), coarse) << "a video keeps its size";
    window.advise({false, false, 480'000, false}, now);
    EXPECT_GT(run(90), coarse) << "the next one begins with more";
}

TEST(VideoFrames, TheFirstCodecThatTheServerKnowsIsTaken) {
    const auto wanted = [](std::initializer_list<v1::Codec> codecs) {
        v1::Hello hello;
        for (const v1::Codec codec : codecs) {
            hello.add_codecs(codec);
        }
        return VideoFrames::wanted_by(hello);
    };
    EXPECT_TRUE(wanted({v1::VP9, v1::JPEG}));
    EXPECT_TRUE(wanted({v1::PNG, v1::VP9}));
    EXPECT_TRUE(wanted({static_cast<v1::Codec>(77), v1::VP9, v1::JPEG}));
    EXPECT_FALSE(wanted({v1::JPEG, v1::VP9}));
    EXPECT_FALSE(wanted({v1::JPEG, v1::PNG}));
    EXPECT_FALSE(wanted({}));
}

TEST(VideoFrames, KeyFramesBeginAVideoAndFollowJumpsAndSizes) {
    VideoFrames video;
    FrameAdvice advice;
    advice.video_bytes = 1000;
    Camera camera;
    camera.eye = {0.0F, 0.0F, 0.0F};
    camera.target = {0.0F, 0.0F, 5.0F};
    camera.vertical_fov = 0.7F;
    TimePoint now{};
    glm::uvec2 size{};
    const auto key = [&](glm::uvec2 fits, glm::uvec2 viewport) {
        size = video.next(advice, fits, viewport, camera, now);
        v1::FrameHeader header;
        video.fill(header);
        return header.key();
    };
    EXPECT_TRUE(key({800, 600}, {800, 600}));
    camera.eye.x = 0.1F;
    EXPECT_FALSE(key({800, 600}, {800, 600}));
    camera.target = {5.0F, 0.0F, 0.0F};
    EXPECT_TRUE(key({800, 600}, {800, 600})) << "a quarter turn";
    key({600, 450}, {800, 600});
    EXPECT_EQ(size.x, 600U);
    key({800, 600}, {800, 600});
    EXPECT_EQ(size.x, 600U) << "it does not flicker between sizes";
    now += std::chrono::seconds(3);
    key({800, 600}, {800, 600});
    EXPECT_EQ(size.x, 800U);
    EXPECT_TRUE(key({400, 600}, {400, 600})) << "another viewport";
    EXPECT_TRUE(video.end());
    EXPECT_FALSE(video.end());
    EXPECT_TRUE(key({400, 600}, {400, 600}));
}

}  // namespace
}  // namespace raybundle
