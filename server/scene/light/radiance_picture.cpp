// SPDX-License-Identifier: Apache-2.0
// After G. Ward, "Radiance File Formats", and the library's color.c.
#include "scene/light/picture_file.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "scene/gltf/gltf_loader.h"
#include "scene/material/colour_space.h"

namespace raybundle {
namespace {

constexpr const char* too_short = "cannot be decoded: it ends before its last pixel";

using Rgbe = std::array<std::uint8_t, 4>;

struct Header {
    glm::dmat3 rec709{1.0};   // of the file's colours
    glm::dvec3 divisor{1.0};  // all of EXPOSURE and COLORCORR
    bool rows = true;         // scanlines are rows, else columns
    bool bottom_up = false, right_to_left = false;
    int width = 0, height = 0;
    bool text_copy = false;  // its lines end with CR LF
};

class Decoder {
  public:
    Decoder(const std::string& file, std::span<const std::uint8_t> bytes)
        : file_(file), bytes_(bytes) {}

    PictureFile read() {
        read_header();
        read_resolution();
        PictureFile image{header_.width, header_.height, {}, header_.rec709};
        const auto width = static_cast<std::size_t>(header_.width);
        const int lines = header_.rows ? header_.height : header_.width;
        if ((bytes_.size() - at_) / sizeof(Rgbe) < static_cast<std::size_t>(lines)) {
            fail(too_short);
        }
        flat_ =
            bytes_.size() - at_ == sizeof(Rgbe) * width * static_cast<std::size_t>(header_.height);
        image.pixels.resize(width * static_cast<std::size_t>(header_.height));
        std::vector<Rgbe> line(
            static_cast<std::size_t>(header_.rows ? header_.width : header_.height));
        for (int i = 0; i < lines; ++i) {
            read_scanline(line);
            for (std::size_t k = 0; k < line.size(); ++k) {
                const std::size_t x = header_.rows ? k : static_cast<std::size_t>(i);
                const std::size_t y = header_.rows ? static_cast<std::size_t>(i) : k;
                const std::size_t column = header_.right_to_left ? width - 1 - x : x;
                const std::size_t row =
                    header_.bottom_up ? static_cast<std::size_t>(header_.height) - 1 - y : y;
                image.pixels[row * width + column] = colour(line[k]);
            }
        }
        if (header_.text_copy && at_ != bytes_.size()) {
            fail("was copied as text: its line ends have been converted, also within its pixels");
        }
        image.notes = std::move(notes_);
        return image;
    }

  private:
    [[noreturn]] void fail(const std::string& reason) const { throw SceneError(file_, "", reason); }

    std::string_view next_line() {
        constexpr std::size_t longest = 64U << 10U;
        std::size_t end = at_;
        while (end < bytes_.size() && bytes_[end] != '\n' && end - at_ < longest) {
            ++end;
        }
        if (end >= bytes_.size() || bytes_[end] != '\n') {
            fail("cannot be decoded: its header does not end");
        }
        std::string_view line(reinterpret_cast<const char*>(bytes_.data()) + at_, end - at_);
        at_ = end + 1;
        if (!line.empty() && line.back() == '\r') {
            line.remove_suffix(1);
            header_.text_copy = true;
        }
        return line;
    }

    /// The numbers of a text; nothing where they are not as many as the array has.
    template <std::size_t N>
    static std::optional<std::array<double, N>> numbers(std::string_view text) {
        std::array<double, N> values{};
        for (double& value : values) {
            text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
            const auto [end, error] =
                std::from_chars(text.data(), text.data() + text.size(), value);
            if (error != std::errc() || !std::isfinite(value)) {
                return std::nullopt;
            }
            text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        }
        return text.find_first_not_of(" \t") == std::string_view::npos ? std::optional(values)
                                                                       : std::nullopt;
    }

    template <std::size_t N>
    std::array<double, N> positive(std::string_view name, std::string_view text) const {
        const auto values = numbers<N>(text);
        for (std::size_t i = 0; i < N; ++i) {
            if (!values || !((*values)[i] > 0.0)) {
                fail(fmt::format("{}={}: {} above 0 expected", name, text,
                                 N == 1 ? "a number" : "numbers"));
            }
        }
        return *values;
    }

    void read_header() {
        std::string format;
        std::optional<std::array<double, 8>> primaries;
        next_line();  // #?RADIANCE, #?RGBE
        for (std::string_view line = next_line(); !line.empty(); line = next_line()) {
            const std::size_t equals = std::min(line.find('='), line.size());
            const std::string_view name = line.substr(0, equals);
            const std::string_view value = line.substr(std::min(equals + 1, line.size()));
            if (name == "EXPOSURE") {
                header_.divisor *= positive<1>(name, value)[0];
            } else if (name == "COLORCORR") {
                const auto c = positive<3>(name, value);
                header_.divisor *= glm::dvec3(c[0], c[1], c[2]);
            } else if (name == "PRIMARIES") {
                primaries = numbers<8>(value);
                if (!primaries || !rec709_from_primaries(*primaries)) {
                    notes_.push_back(fmt::format("PRIMARIES={} are no colour space and ignored",
                                                 value.substr(0, 80)));
                }
            } else if (name == "GAMMA") {
                const auto gamma = numbers<1>(value);
                if (!gamma || (*gamma)[0] != 1.0) {
                    notes_.push_back(
                        fmt::format("GAMMA={} is ignored: its numbers are read as "
                                    "linear",
                                    value.substr(0, 80)));
                }
            } else if (name == "FORMAT") {
                format = value.substr(0, value.find_last_not_of(" \t") + 1);
            }
        }
        if (format == "32-bit_rle_xyze") {
            header_.rec709 = rec709_from_xyz();
        } else if (format != "32-bit_rle_rgbe") {
            fail(
                fmt::format("FORMAT '{}' of a Radiance picture is neither 32-bit_rle_rgbe nor "
                            "32-bit_rle_xyze",
                            format.substr(0, 80)));
        } else if (primaries) {
            header_.rec709 = rec709_from_primaries(*primaries).value_or(glm::dmat3(1.0));
        }
    }

    /// "-Y 512 +X 1024": the axis of the scanlines first; a sign says where coordinates grow.
    void read_resolution() {
        const std::string_view line = next_line();
        std::array<int, 2> sizes{};
        std::array<char, 2> signs{}, axes{};
        std::string_view left = line;
        for (std::size_t i = 0; i < 2; ++i) {
            left.remove_prefix(std::min(left.find_first_not_of(' '), left.size()));
            if (left.size() < 3) {
                break;
            }
            signs[i] = left[0];
            axes[i] = left[1];
            left.remove_prefix(2);
            left.remove_prefix(std::min(left.find_first_not_of(' '), left.size()));
            const char* end = std::from_chars(left.data(), left.data() + left.size(), sizes[i]).ptr;
            left.remove_prefix(static_cast<std::size_t>(end - left.data()));
        }
        const std::size_t y = axes[0] == 'Y' ? 0 : 1;
        const bool known = axes[y] == 'Y' && axes[1 - y] == 'X' &&
                           (signs[0] == '+' || signs[0] == '-') &&
                           (signs[1] == '+' || signs[1] == '-');
        header_.rows = y == 0;
        header_.height = sizes[y];
        header_.width = sizes[1 - y];
        header_.bottom_up = signs[y] == '+';
        header_.right_to_left = signs[1 - y] == '-';
        if (!known || header_.width < 1 || header_.height < 1) {
            fail(fmt::format("'{}' is no resolution of a Radiance picture", line.substr(0, 80)));
        }
        if (std::int64_t{header_.width} * header_.height > max_picture_pixels) {
            fail(fmt::format("{} x {} pixels; the limit is {} pixels", header_.width,
                             header_.height, max_picture_pixels));
        }
    }

    std::uint8_t next_byte() {
        if (at_ >= bytes_.size()) {
            fail(too_short);
        }
        return bytes_[at_++];
    }

    Rgbe next_pixel() { return {next_byte(), next_byte(), next_byte(), next_byte()}; }

    void read_scanline(std::vector<Rgbe>& line) {
        const Rgbe first = next_pixel();
        const std::size_t length = std::size_t{first[2]} << 8U | first[3];
        if (first[0] == 2 && first[1] == 2 && first[2] < 128 && line.size() >= 8 &&
            line.size() < 32768) {
            if (length != line.size() && flat_) {  // a dark pixel that looks like a run
                return read_old_scanline(line, first);
            }
            if (length != line.size()) {
                fail("cannot be decoded: a scanline has another length than the picture");
            }
            for (std::size_t channel = 0; channel < 4; ++channel) {
                read_channel(line, channel);
            }
            return;
        }
        read_old_scanline(line, first);
    }

    /// Codes above 128 repeat the byte that follows.
    void read_channel(std::vector<Rgbe>& line, std::size_t channel) {
        for (std::size_t i = 0; i < line.size();) {
            const std::size_t code = next_byte();
            const bool run = code > 128;
            const std::size_t count = run ? code - 128 : code;
            if (count == 0 || count > line.size() - i) {
                fail("cannot be decoded: a run of pixels does not fit into its scanline");
            }
            const std::uint8_t repeated = run ? next_byte() : std::uint8_t{0};
            for (std::size_t k = 0; k < count; ++k, ++i) {
                line[i][channel] = run ? repeated : next_byte();
            }
        }
    }

    /// Pixels; 1, 1, 1, n repeats the one before n times, and another of these 256 n times.
    void read_old_scanline(std::vector<Rgbe>& line, Rgbe pixel) {
        unsigned shift = 0;
        for (std::size_t i = 0;;) {
            if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
                const std::size_t count = std::size_t{pixel[3]} << shift;
                if (i == 0 || shift > 16 || count > line.size() - i) {
                    fail("cannot be decoded: a run of pixels does not fit into its scanline");
                }
                for (std::size_t k = 0; k < count; ++k, ++i) {
                    line[i] = line[i - 1];
                }
                shift += 8;
            } else {
                line[i++] = pixel;
                shift = 0;
            }
            if (i == line.size()) {
                return;
            }
            pixel = next_pixel();
        }
    }

    [[nodiscard]] glm::vec3 colour(const Rgbe& p) const {
        if (p[3] == 0) {
            return glm::vec3(0.0F);
        }
        const double unit = std::ldexp(1.0, int{p[3]} - (128 + 8));
        return {glm::dvec3(p[0], p[1], p[2]) * unit / header_.divisor};
    }

    const std::string& file_;
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    bool flat_ = false;
    Header header_;
    std::vector<std::string> notes_;
};

}  // namespace

PictureFile read_radiance_picture(const std::string& file, std::span<const std::uint8_t> bytes) {
    return Decoder(file, bytes).read();
}

}  // namespace raybundle
