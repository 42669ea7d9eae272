// SPDX-License-Identifier: Apache-2.0
// Text of IES files. LM-63-1986 has free lines before TILT, later ones keywords; what follows TILT
// has not changed since: a table of numbers in free format.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "scene/other_file.h"
#include "scene/photometry/ies_profile.h"
#include "scene/photometry/ies_text.h"
#include "scene/photometry/photometric_values.h"

namespace raybundle {
namespace {

/// Year of the standard that a line names, as "IES:LM-63-2019" or "IESNA91" do; 0: none.
int year_of(std::string_view line) {
    const std::string key = compact(line);
    if (key.starts_with("IESNA91")) {
        return 1991;
    }
    std::size_t at = key.starts_with("[") ? std::string::npos : key.find("LM-63");
    if (at == std::string::npos) {
        return 0;
    }
    at += 5;
    at += at < key.size() && (key[at] < '0' || key[at] > '9') ? 1 : 0;
    int year = 0;
    std::size_t digits = 0;
    for (; digits < 4 && at < key.size() && key[at] >= '0' && key[at] <= '9'; ++at, ++digits) {
        year = 10 * year + (key[at] - '0');
    }
    if (digits == 2) {
        return year + (year >= 86 ? 1900 : 2000);
    }
    return digits == 4 ? year : 0;
}

/// What a file that has no TILT is instead, by its first bytes; empty: not known.
std::string other_format(const std::string& text, std::string_view bytes) {
    if (compact(text.substr(0, 200)).starts_with("<")) {
        return "this is XML or HTML, not the text of LM-63";
    }
    return other_file_kind({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

struct Head {
    int year = 0;  ///< of the standard; 0 where no line names one
    bool decimal_commas = false;
    std::optional<ColourRendering> colour_rendering;
};

/// The factors of TILT=INCLUDE are those of a tilted luminaire; it is measured upright, where its
/// factor is 1.
void skip_tilt(IesReader& reader) {
    reader.number("the lamp-to-luminaire geometry", 1, 3);
    const std::size_t pairs = reader.count("the number of tilt angles", 1000);
    reader.ascending("a tilt angle", pairs, -360, 360);
    for (std::size_t k = 0; k < pairs; ++k) {
        reader.number("a tilt factor", 0, 1e3);
    }
}

/// The part up to and with TILT. A file that TILT names is for tilted luminaires, too.
Head read_head(IesReader& reader, const std::string& text, std::string_view bytes,
               std::vector<std::string>& notes) {
    Head head;
    constexpr int max_lines = 10'000;
    for (int i = 0; i < max_lines && !reader.at_end(); ++i) {
        const std::string_view line = reader.next_line();
        head.year = head.year == 0 ? year_of(line) : head.year;
        if (const auto stated = keyword_colour_rendering(line)) {
            head.colour_rendering = stated;
        }
        const std::string key = compact(line);
        if (!key.starts_with("TILT=")) {
            continue;
        }
        const bool included = key.starts_with("TILT=INCLUDE");
        if (!included && !key.starts_with("TILT=NONE") && key != "TILT=") {
            notes.emplace_back(
                "the file of tilt factors that it names is not read: it is measured upright");
        }
        head.decimal_commas = resolve_commas(reader, included);
        if (included) {
            skip_tilt(reader);
        }
        return head;
    }
    const std::string other = other_format(text, bytes);
    if (!other.empty()) {
        reader.fail(1, other);
    }
    reader.fail("there is no line that begins with TILT=");
}

/// The limits of a range as they are meant: files have two decimals, and 359.99 for 360.
void snap_limits(std::vector<double>& angles) {
    constexpr double rounding = 0.01 + 1e-6;
    const auto snapped = [](double angle) {
        const double right = 90.0 * std::round(angle / 90.0);
        return std::abs(angle - right) <= rounding ? right : angle;
    };
    const double first = snapped(angles.front());
    const double last = snapped(angles.back());
    if (angles.size() == 1) {
        angles.front() = first;
    } else if (first < angles[1] && last > angles[angles.size() - 2]) {
        angles.front() = first;
        angles.back() = last;
    }
}

void check_type_c(const IesReader& reader, IesProfile::Data& data) {
    const std::vector<double>& v = data.vertical;
    const std::vector<double>& h = data.horizontal;
    if ((v.front() != 0.0 && v.front() != 90.0) || v.size() < 2) {
        reader.fail("vertical angles of type C begin at 0 or 90 and are at least two");
    }
    if (v.back() != 90.0 && v.back() != 180.0) {
        data.notes.push_back(
            fmt::format("its vertical angles end at {}°: it is dark beyond", v.back()));
    }
    const bool since_1995 = h.front() == 90.0 && h.back() == 270.0;
    if (!since_1995 && h.front() != 0.0 && h.size() > 1) {
        reader.fail("horizontal angles of type C go from 0 to 0, 90, 180 or 360");
    }
}

void check_types_a_and_b(const IesReader& reader, IesProfile::Data& data) {
    for (const auto& [angles, name] :
         {std::pair(&data.vertical, "vertical"), std::pair(&data.horizontal, "horizontal")}) {
        const bool single = angles->size() == 1;
        if (angles->front() > 0.0 || (!single && angles->back() <= 0.0) || angles->back() > 90.0) {
            reader.fail("angles of types A and B go from -90 or 0 to 90");
        }
        const bool whole = angles->front() == 0.0 || angles->front() == -90.0;
        if (!single && (!whole || angles->back() != 90.0)) {
            data.notes.push_back(fmt::format("its {} angles go from {}° to {}°: it is dark beyond",
                                             name, angles->front(), angles->back()));
        }
    }
}

/// Where planes of type C leave out the last one, as programs do that count 0 and 360 as the same:
/// its angle. Nothing where they do not.
std::optional<double> missing_plane(const IesReader& reader, const IesProfile::Data& data) {
    const std::vector<double>& h = data.horizontal;
    const double last = h.back();
    if (data.type != IesProfile::Type::c || h.size() == 1 || h.front() != 0.0 || last == 90.0 ||
        last == 180.0 || last == 360.0) {
        return std::nullopt;
    }
    const double end = last < 90.0 ? 90.0 : last < 180.0 ? 180.0 : 360.0;
    const double step = last - h[h.size() - 2];
    constexpr double rounding = 1e-6;
    if (h.size() < 3 || end - last > step + rounding) {
        reader.fail(
            fmt::format("horizontal angles of type C go from 0 to 0, 90, 180 or 360; these "
                        "end at {}, not one step of {} before {}",
                        last, step, end));
    }
    return end;
}

/// Adds that plane: it is as the one that the symmetry puts in its place.
void close_planes(double angle, IesProfile::Data& data) {
    const bool circle = angle == 360.0;
    const auto rows = static_cast<std::ptrdiff_t>(data.vertical.size());
    const auto source = circle ? data.candela.begin() : data.candela.end() - rows;
    const std::vector<double> plane(source, source + rows);
    data.candela.insert(data.candela.end(), plane.begin(), plane.end());
    const double last = data.horizontal.back();
    data.horizontal.push_back(angle);
    data.notes.push_back(fmt::format("its planes end at {}°: that at {}° is as that at {}°", last,
                                     angle, circle ? 0.0 : last));
}

/// Dimensions as LM-63 has them: the length along the plane of 0 degrees, the width across;
/// negative ones are diameters of something round.
IesProfile::Opening opening_of(double width, double length, double height) {
    IesProfile::Opening opening;
    opening.round = width < 0.0 || length < 0.0;
    opening.width = std::abs(width);
    opening.length = std::abs(length);
    if (opening.round) {  // one diameter stands for both
        opening.width = opening.width > 0.0 ? opening.width : opening.length;
        opening.length = opening.length > 0.0 ? opening.length : opening.width;
    }
    opening.heights.fill(std::abs(height));
    return opening;
}

/// Values in cd, with all factors. Returns the line of the lowest one.
int read_candela(IesReader& reader, double factor, IesProfile::Data& data) {
    const std::size_t count = data.vertical.size() * data.horizontal.size();
    data.candela.reserve(count);
    double lowest = 0.0;
    int line = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double value = reader.number("a candela value");
        data.candela.push_back(factor * value);
        line = value < lowest ? reader.line() : line;
        lowest = std::min(value, lowest);
    }
    if (reader.has_number()) {
        reader.fail(fmt::format("more numbers follow than {} x {} candela values",
                                data.vertical.size(), data.horizontal.size()));
    }
    return line;
}

}  // namespace

IesProfile parse_ies(const std::string& file, std::string_view bytes) {
    const std::string text = plain_photometric_text(file, bytes);
    IesReader reader(file, text);
    IesProfile::Data data;
    const Head head = read_head(reader, text, bytes, data.notes);
    data.colour_rendering = head.colour_rendering;
    if (head.decimal_commas) {
        data.notes.emplace_back("its decimal commas are read as decimal points");
    }
    // Negative ones are what says that intensities are absolute, as they always are here.
    const double lamps = reader.number("the number of lamps", -1e6, 1e6);
    data.lamp_lumens = std::abs(lamps) * reader.number("the lumens per lamp");
    const double multiplier = reader.number("the candela multiplier", 0, IesReader::max_number);
    const std::size_t rows = reader.count("the number of vertical angles", IesReader::max_values);
    const std::size_t columns =
        reader.count("the number of horizontal angles", IesReader::max_values);
    if (rows * columns > IesReader::max_values) {
        reader.fail(
            fmt::format("{} x {} values; the limit is {}", rows, columns, IesReader::max_values));
    }
    data.type = static_cast<IesProfile::Type>(reader.count("the photometric type", 3));
    const double metres = reader.count("the units type", 2) == 1 ? 0.3048 : 1.0;
    const double width = metres * reader.number("the width");
    const double length = metres * reader.number("the length");
    data.opening = opening_of(width, length, metres * reader.number("the height"));
    const double ballast = reader.number("the ballast factor", 0, 1e6);
    // Since 2002 it is not used any more, in 2019 it says how the file was made.
    const double lamp_factor = reader.number("the ballast-lamp photometric factor", 0, 1e6);
    data.input_watts = reader.number("the input watts");
    data.vertical = reader.ascending("a vertical angle", rows, -90, 180);
    data.horizontal = reader.ascending("a horizontal angle", columns, -90, 360);
    snap_limits(data.vertical);
    snap_limits(data.horizontal);
    const bool type_c = data.type == IesProfile::Type::c;
    type_c ? check_type_c(reader, data) : check_types_a_and_b(reader, data);
    const double factor = multiplier * ballast * (head.year >= 2002 ? 1.0 : lamp_factor);
    const std::optional<double> missing = missing_plane(reader, data);
    const int lowest_line = read_candela(reader, factor, data);
    if (missing) {
        close_planes(*missing, data);
    }
    return checked_profile(reader, std::move(data), lowest_line);
}

}  // namespace raybundle
