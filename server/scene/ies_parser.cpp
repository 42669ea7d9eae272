// SPDX-License-Identifier: Apache-2.0
// Text of IES files. LM-63-1986 has free lines before TILT, later ones keywords; what follows TILT
// has not changed since: a table of numbers in free format.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

#include "scene/gltf_loader.h"
#include "scene/ies_profile.h"

namespace raybundle {
namespace {

constexpr std::size_t max_file_bytes = 16U << 20U;
constexpr std::size_t max_values = 1U << 20U;  // of candela
constexpr double max_number = 1e9;

class Reader {
  public:
    Reader(const std::string& file, std::string_view text) : file_(file), rest_(text) {}

    [[noreturn]] void fail(const std::string& reason) const {
        throw SceneError(file_, fmt::format("line {}", line_), reason);
    }

    [[nodiscard]] bool at_end() const { return rest_.empty(); }

    /// The rest of this line.
    std::string_view next_line() {
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++line_;
        if (!line.empty() && line.back() == '\r') {
            line.remove_suffix(1);
        }
        return line;
    }

    double number(const std::string& what, double low = -max_number, double high = max_number) {
        skip_blanks();
        std::string_view digits = rest_;
        if (!digits.empty() && digits.front() == '+') {
            digits.remove_prefix(1);
        }
        double value = 0.0;
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (rest_.empty()) {
            fail(fmt::format("the file ends where {} should be", what));
        }
        if (error != std::errc() || !ends_number(end)) {
            fail(fmt::format("{} is not a number", what));
        }
        if (!(value >= low && value <= high)) {
            fail(fmt::format("{} is {}, not in [{}, {}]", what, value, low, high));
        }
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return value;
    }

    std::size_t count(const std::string& what, std::size_t high) {
        const double value = number(what, 1.0, static_cast<double>(high));
        if (value != std::floor(value)) {
            fail(fmt::format("{} is {}, not an integer", what, value));
        }
        return static_cast<std::size_t>(value);
    }

    std::vector<double> ascending(const std::string& what, std::size_t number_of, double low,
                                  double high) {
        std::vector<double> values;
        for (std::size_t i = 0; i < number_of; ++i) {
            values.push_back(number(what, low, high));
            if (i > 0 && values[i] <= values[i - 1]) {
                fail(fmt::format("{} {} is not above the one before it, {}", what, values[i],
                                 values[i - 1]));
            }
        }
        return values;
    }

  private:
    void skip_blanks() {
        while (!rest_.empty() && is_blank(rest_.front())) {
            line_ += rest_.front() == '\n' ? 1 : 0;
            rest_.remove_prefix(1);
        }
    }
    static bool is_blank(char c) {
        return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',';
    }
    [[nodiscard]] bool ends_number(const char* end) const {
        return end == rest_.data() + rest_.size() || is_blank(*end);
    }

    const std::string& file_;
    std::string_view rest_;
    int line_ = 1;
};

/// The part up to and with TILT: the year of the standard, 0 where no line names one. The factors
/// of TILT=INCLUDE are those of a tilted luminaire; it is measured upright, where its factor is 1.
int read_head(Reader& reader) {
    int year = 0;
    constexpr int max_lines = 10'000;
    for (int i = 0; i < max_lines && !reader.at_end(); ++i) {
        const std::string_view line = reader.next_line();
        if (i == 0) {
            for (const int known : {1991, 1995, 2002, 2019}) {
                const std::string tail = std::to_string(known);
                const bool old = known == 1991 && line.starts_with("IESNA91");
                if (old || (line.starts_with("IES") && line.ends_with(tail))) {
                    year = known;
                }
            }
        }
        if (!line.starts_with("TILT=")) {
            continue;
        }
        const std::string_view value = line.substr(5);
        if (value.starts_with("INCLUDE")) {
            reader.number("the lamp-to-luminaire geometry", 1, 3);
            const std::size_t pairs = reader.count("the number of tilt angles", 1000);
            reader.ascending("a tilt angle", pairs, -360, 360);
            for (std::size_t k = 0; k < pairs; ++k) {
                reader.number("a tilt factor", 0, 1e3);
            }
        } else if (!value.starts_with("NONE")) {
            reader.fail("TILT names a file: only NONE and INCLUDE are supported");
        }
        return year;
    }
    reader.fail("there is no line that begins with TILT=");
}

void check_angles(const Reader& reader, const IesProfile::Data& data) {
    const std::vector<double>& v = data.vertical;
    const std::vector<double>& h = data.horizontal;
    const auto starts = [](const std::vector<double>& angles, double a, double b) {
        return angles.front() == a || angles.front() == b;
    };
    if (data.type == IesProfile::Type::c) {
        if (v.size() > 1 && (!starts(v, 0.0, 90.0) || (v.back() != 90.0 && v.back() != 180.0))) {
            reader.fail("vertical angles of type C go from 0 or 90 to 90 or 180");
        }
        const bool since_1995 = h.front() == 90.0 && h.back() == 270.0;
        if (!since_1995 && (h.front() != 0.0 || (h.size() > 1 && h.back() < 90.0))) {
            reader.fail("horizontal angles of type C go from 0 to 0, 90, 180 or 360");
        }
        return;
    }
    for (const std::vector<double>* angles : {&v, &h}) {
        if (!starts(*angles, 0.0, -90.0) || (angles->size() > 1 && angles->back() != 90.0)) {
            reader.fail("angles of types A and B go from -90 or 0 to 90");
        }
    }
}

}  // namespace

IesProfile parse_ies(const std::string& file, std::string_view text) {
    Reader reader(file, text);
    if (text.size() > max_file_bytes) {
        reader.fail(fmt::format("{} bytes; the limit is {}", text.size(), max_file_bytes));
    }
    const int year = read_head(reader);
    IesProfile::Data data;
    const double lamps = reader.number("the number of lamps", 0, 1e6);
    data.lamp_lumens = lamps * reader.number("the lumens per lamp", -1, max_number);
    const double multiplier = reader.number("the candela multiplier", 0, max_number);
    const std::size_t rows = reader.count("the number of vertical angles", max_values);
    const std::size_t columns = reader.count("the number of horizontal angles", max_values);
    if (rows * columns > max_values) {
        reader.fail(fmt::format("{} x {} values; the limit is {}", rows, columns, max_values));
    }
    data.type = static_cast<IesProfile::Type>(reader.count("the photometric type", 3));
    reader.count("the units type", 2);
    for (const char* length : {"the width", "the length", "the height"}) {
        reader.number(length);
    }
    const double ballast = reader.number("the ballast factor", 0, 1e6);
    // Since 2002 it is not used any more, in 2019 it says how the file was made.
    const double lamp_factor = reader.number("the ballast-lamp photometric factor", 0, 1e6);
    data.input_watts = reader.number("the input watts");
    data.vertical = reader.ascending("a vertical angle", rows, -90, 180);
    data.horizontal = reader.ascending("a horizontal angle", columns, -90, 360);
    check_angles(reader, data);
    const double factor = multiplier * ballast * (year >= 2002 ? 1.0 : lamp_factor);
    data.candela.reserve(rows * columns);
    for (std::size_t i = 0; i < rows * columns; ++i) {
        data.candela.push_back(factor * reader.number("a candela value", 0, max_number));
    }
    IesProfile profile(std::move(data));
    if (!(profile.flux() > 0.0) || !std::isfinite(profile.flux())) {
        reader.fail("the luminaire gives no light");
    }
    return profile;
}

IesProfile read_ies(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        throw SceneError(path, "", "cannot be opened");
    }
    std::string text(max_file_bytes + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return parse_ies(path, text);
}

}  // namespace raybundle
