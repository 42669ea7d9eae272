// SPDX-License-Identifier: Apache-2.0
// Text of EULUMDAT files (.ldt; Stockmar 1990): one value a line, in a fixed order. Empty lines are
// values that are not given, or come from programs that end lines twice.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "scene/other_file.h"
#include "scene/photometry/ies_profile.h"
#include "scene/photometry/ies_text.h"
#include "scene/photometry/photometric_values.h"

namespace raybundle {
namespace {

/// Lines that end twice (CR CR LF) end once.
std::string single_spaced(const std::string& text) {
    std::string kept;
    std::size_t number = 0;
    for (std::size_t at = 0; at < text.size(); ++number) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = std::string_view(text).substr(at, end - at);
        if (number % 2 == 0) {
            kept.append(line).append("\n");
        } else if (!compact(line).empty()) {
            return text;
        }
        at = end + 1;
    }
    return kept;
}

/// Reads lines that hold one value each. `what` names the value for errors.
class LineReader {
  public:
    LineReader(const std::string& file, std::string_view text) : reader_(file, text) {}

    [[nodiscard]] const IesReader& reader() const { return reader_; }
    /// Of the line that was read last.
    [[nodiscard]] int line() const { return line_; }
    [[noreturn]] void fail(const std::string& reason) const { reader_.fail(line_, reason); }

    std::string_view text(const std::string& what) {
        line_ = reader_.line();
        if (reader_.at_end()) {
            fail(fmt::format("the file ends where {} should be", what));
        }
        return reader_.next_line();
    }

    /// Empty lines before it are left out.
    double number(const std::string& what, double low = -IesReader::max_number,
                  double high = IesReader::max_number) {
        std::string digits;
        while (digits.empty()) {
            digits = compact(text(what));
        }
        return parsed(what, digits, low, high);
    }

    /// Nothing where its line is empty.
    std::optional<double> number_if_given(const std::string& what) {
        const std::string digits = compact(text(what));
        return digits.empty() ? std::nullopt
                              : std::optional(parsed(what, digits, -IesReader::max_number,
                                                     IesReader::max_number));
    }

    /// Of a value that the light does not depend on, where anything may stand; a note tells.
    std::optional<double> number_if_legible(const std::string& what,
                                            std::vector<std::string>& notes) {
        const std::string digits = compact(text(what));
        const std::optional<double> value = legible(digits);
        if (!value && digits.find_first_not_of('-') != std::string::npos) {
            notes.push_back(fmt::format("{} is not a number: \"{}\"", what,
                                        plain_message(digits.substr(0, 40))));
        }
        return value;
    }

    std::size_t count(const std::string& what, double low, double high) {
        const double value = number(what, low, high);
        if (value != std::floor(value)) {
            fail(fmt::format("{} is {}, not an integer", what, value));
        }
        return static_cast<std::size_t>(value);
    }

    std::vector<double> ascending(const std::string& what, std::size_t number_of, double high) {
        std::vector<double> values;
        for (std::size_t i = 0; i < number_of; ++i) {
            values.push_back(number(what, 0.0, high));
            if (i > 0 && values[i] <= values[i - 1]) {
                fail(fmt::format("{} {} is not above the one before it, {}", what, values[i],
                                 values[i - 1]));
            }
        }
        return values;
    }

    void require_end() {
        while (!reader_.at_end()) {
            const std::string rest = compact(text("the end"));
            if (rest.find_first_of("0123456789") == 0) {
                fail("more numbers follow than the planes and angles of the file have");
            }
        }
    }

  private:
    static std::optional<double> legible(std::string digits) {
        std::replace(digits.begin(), digits.end(), ',', '.');
        const std::size_t sign = digits.starts_with('+') ? 1 : 0;
        double value = 0.0;
        const char* last = digits.data() + digits.size();
        const auto [end, error] = std::from_chars(digits.data() + sign, last, value);
        return error == std::errc() && end == last ? std::optional(value) : std::nullopt;
    }

    double parsed(const std::string& what, const std::string& digits, double low,
                  double high) const {
        const std::optional<double> value = legible(digits);
        if (!value) {
            fail(fmt::format("{} is not a number: \"{}\"", what, digits.substr(0, 40)));
        }
        if (!(*value >= low && *value <= high)) {
            fail(fmt::format("{} is {}, not in [{}, {}]", what, *value, low, high));
        }
        return *value;
    }

    IesReader reader_;
    int line_ = 1;
};

enum class Symmetry : std::size_t { none, vertical, c0_c180, c90_c270, both };

struct Head {
    Symmetry symmetry = Symmetry::none;
    std::size_t planes = 0, angles = 0;
    double light_output_ratio = 0.0;  ///< 0: not given
    double factor = 1.0;
    std::size_t lamp_sets = 0;
};

/// Millimetres; the length lies across the plane C0, of what is round it is the diameter.
IesProfile::Opening read_opening(LineReader& in) {
    const auto metres = [&](const char* what) {
        return std::max(in.number_if_given(what).value_or(0.0), 0.0) / 1000.0;
    };
    IesProfile::Opening opening;
    opening.width = metres("the luminous length");
    opening.length = metres("the luminous width");
    opening.round = opening.length == 0.0;
    opening.length = opening.round ? opening.width : opening.length;
    opening.heights = {metres("the luminous height in C0"), metres("the luminous height in C90"),
                       metres("the luminous height in C180"),
                       metres("the luminous height in C270")};
    return opening;
}

Head read_head(LineReader& in, IesProfile::Data& data) {
    Head head;
    in.text("the company");
    in.count("the type indicator", 0, 3);
    head.symmetry = static_cast<Symmetry>(in.count("the symmetry", 0, 4));
    head.planes = in.count("the number of C planes", 1, IesReader::max_values);
    in.number("the distance of C planes", 0, 360);
    head.angles = in.count("the number of angles in a plane", 2, IesReader::max_values);
    in.number("the distance of angles in a plane", 0, 180);
    for (const char* what :
         {"the report number", "the name", "the number", "the file's name", "the date"}) {
        in.text(what);
    }
    if (head.planes * head.angles > IesReader::max_values) {
        in.fail(fmt::format("{} x {} values; the limit is {}", head.planes, head.angles,
                            IesReader::max_values));
    }
    for (const char* size : {"the length", "the width", "the height"}) {
        in.number_if_legible(size, data.notes);
    }
    data.opening = read_opening(in);
    in.number_if_legible("the downward flux fraction", data.notes);
    head.light_output_ratio =
        in.number_if_legible("the light output ratio", data.notes).value_or(0.0) / 100.0;
    head.factor = in.number_if_given("the conversion factor").value_or(1.0);
    if (head.factor == 0.0) {
        data.notes.emplace_back("its conversion factor is 0, which is read as 1");
        head.factor = 1.0;
    }
    if (head.factor < 0.0) {
        in.fail(fmt::format("the conversion factor is {}, below 0", head.factor));
    }
    if (const double tilt = in.number_if_given("the tilt").value_or(0.0); tilt != 0.0) {
        data.notes.push_back(
            fmt::format("it was measured tilted by {}°: it is aimed upright", tilt));
    }
    head.lamp_sets = in.count("the number of lamp sets", 1, 20);
    return head;
}

/// The first set is what the luminaire is measured with; others are alternatives to it.
void read_lamps(LineReader& in, std::size_t sets, IesProfile::Data& data) {
    for (std::size_t set = 0; set < sets; ++set) {
        in.number("the number of lamps");  // negative: absolute photometry; the flux is of all
        in.text("the lamp's type");
        const double flux = in.number("the flux of the lamps", 0);
        if (set == 0 && flux == 0.0) {
            in.fail("the flux of its first lamp set is 0, so that its cd/klm are dark");
        }
        in.text("the colour of the light");
        const std::string_view rendering = in.text("the colour rendering");
        const double watts = in.number_if_legible("the power", data.notes).value_or(0.0);
        if (set == 0) {
            data.colour_rendering = read_colour_rendering(rendering);
            data.lamp_lumens = flux;
            data.input_watts = watts;
        }
    }
    if (sets > 1) {
        data.notes.push_back(
            fmt::format("it has {} lamp sets to choose from: the first one is read", sets));
    }
}

/// Which planes the file holds, by its symmetry, as indices into all of its planes, and where they
/// are in the profile.
void choose_planes(const LineReader& in, Symmetry symmetry, const std::vector<double>& all,
                   std::vector<double>& planes) {
    constexpr double rounding = 0.01 + 1e-6;
    const auto is = [&](std::size_t index, double angle) {
        return std::abs(all[index] - angle) <= rounding;
    };
    const bool closed = is(all.size() - 1, 360.0) && all.size() > 1;
    const std::size_t circle = all.size() - (closed ? 1 : 0);
    const auto upto = [&](std::size_t parts, double last) {
        if (circle % parts != 0 || !is(0, 0.0) || !is(circle / parts, last)) {
            in.fail(
                fmt::format("{} C planes do not fit symmetry {}: one of them is at 0° and "
                            "one at {}°, which is number {} of them",
                            all.size(), static_cast<int>(symmetry), last,
                            static_cast<double>(circle) / static_cast<double>(parts) + 1.0));
        }
        planes.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(circle / parts) + 1);
        planes.back() = last;
    };
    switch (symmetry) {
        case Symmetry::none:
            planes = all;
            if (!is(0, 0.0)) {
                in.fail("the first C plane is not at 0°");
            }
            break;
        case Symmetry::vertical:
            planes = {0.0};
            break;
        case Symmetry::c0_c180:
            upto(2, 180.0);
            break;
        case Symmetry::both:
            upto(4, 90.0);
            break;
        case Symmetry::c90_c270: {
            upto(4, 90.0);  // checks; the file's planes are C270 by way of C0 to C90
            const std::size_t from = 3 * (circle / 4);
            planes.clear();
            // As LM-63 has it: 90° to 270°, mirrored at that plane: C is at 180° - C.
            for (std::size_t k = 0; k <= circle / 2; ++k) {
                const std::size_t index = (from + k) % circle;
                planes.push_back(180.0 - (from + k < circle ? all[index] - 360.0 : all[index]));
            }
            planes.front() = 270.0;
            planes.back() = 90.0;
        }
    }
    planes.front() += planes.front() < rounding ? -planes.front() : 0.0;
}

/// Reads the table in cd. Returns the line of its lowest value.
int read_candela(LineReader& in, double factor, IesProfile::Data& data) {
    double lowest = 0.0;
    int line = 0;
    data.candela.reserve(data.horizontal.size() * data.vertical.size());
    for (std::size_t i = 0; i < data.horizontal.size() * data.vertical.size(); ++i) {
        const double value = in.number("an intensity");
        data.candela.push_back(factor * value);
        line = value < lowest ? in.line() : line;
        lowest = std::min(lowest, value);
    }
    in.require_end();
    return line;
}

/// Puts planes that came in descending order into ascending order.
void sort_planes(IesProfile::Data& data) {
    if (data.horizontal.size() < 2 || data.horizontal[0] < data.horizontal[1]) {
        return;
    }
    const std::size_t rows = data.vertical.size();
    const std::size_t columns = data.horizontal.size();
    std::reverse(data.horizontal.begin(), data.horizontal.end());
    for (std::size_t column = 0; column < columns / 2; ++column) {
        const auto low = data.candela.begin() + static_cast<std::ptrdiff_t>(column * rows);
        const auto high =
            data.candela.begin() + static_cast<std::ptrdiff_t>((columns - 1 - column) * rows);
        std::swap_ranges(low, low + static_cast<std::ptrdiff_t>(rows), high);
    }
}

/// The plane at 360° is as that at 0°.
void close_circle(IesProfile::Data& data) {
    if (data.horizontal.size() > 1 && data.horizontal.back() < 360.0 - 0.02) {
        const auto rows = static_cast<std::ptrdiff_t>(data.vertical.size());
        const std::vector<double> first(data.candela.begin(), data.candela.begin() + rows);
        data.candela.insert(data.candela.end(), first.begin(), first.end());
        data.horizontal.push_back(360.0);
    }
}

void compare_flux(const Head& head, IesProfile& profile) {
    constexpr double reported = 0.02;
    const double stated = head.light_output_ratio * profile.data().lamp_lumens;
    const double difference = stated > 0.0 ? profile.flux() / stated - 1.0 : 0.0;
    if (std::abs(difference) > reported) {
        profile.add_note(
            fmt::format("its intensities add up to {:.0f} lm, {:+.1f} % from the {:.0f} lm "
                        "that its lamps and its light output ratio give",
                        profile.flux(), 100.0 * difference, stated));
    }
}

}  // namespace

IesProfile parse_eulumdat(const std::string& file, std::string_view bytes) {
    const std::string text = single_spaced(plain_photometric_text(file, bytes));
    LineReader in(file, text);
    IesProfile::Data data;
    const Head head = read_head(in, data);
    read_lamps(in, head.lamp_sets, data);
    for (int k = 1; k <= 10; ++k) {
        in.number_if_legible("a direct ratio", data.notes);
    }
    const std::vector<double> all = in.ascending("a C angle", head.planes, 360.0);
    choose_planes(in, head.symmetry, all, data.horizontal);
    data.vertical = in.ascending("a gamma angle", head.angles, 180.0);
    const int lowest_line = read_candela(in, head.factor * data.lamp_lumens / 1000.0, data);
    sort_planes(data);
    if (head.symmetry == Symmetry::none) {
        close_circle(data);
    }
    IesProfile profile = checked_profile(in.reader(), std::move(data), lowest_line);
    compare_flux(head, profile);
    return profile;
}

}  // namespace raybundle
