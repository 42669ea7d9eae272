// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace raybundle {

/// The bytes of a photometric file as ASCII text whose lines end with LF: without a byte order
/// mark, from UTF-16 with or without one, from lines that end with CR LF or CR alone; control
/// characters and no-break spaces are blanks. Throws SceneError where there are more than 16 MiB;
/// `file` is the name for it.
std::string plain_photometric_text(const std::string& file, std::string_view bytes);

/// In upper case and without blanks.
std::string compact(std::string_view line);

/// Text of a photometric file, by lines and then by numbers in free format.
class IesReader {
  public:
    static constexpr double max_number = 1e9;
    static constexpr std::size_t max_values = 1U << 20U;  ///< of candela

    /// file: its name for errors. Both must outlive the reader.
    IesReader(const std::string& file, std::string_view text) : file_(file), rest_(text) {}

    /// Throws SceneError with the line that is read now, or with another one.
    [[noreturn]] void fail(const std::string& reason) const { fail(line_, reason); }
    [[noreturn]] void fail(int line, const std::string& reason) const;

    [[nodiscard]] bool at_end() const { return rest_.empty(); }
    [[nodiscard]] int line() const { return line_; }
    [[nodiscard]] std::string_view rest() const { return rest_; }
    /// Commas between digits are decimal points from here on, else they separate numbers.
    void read_decimal_commas() { decimal_commas_ = true; }

    /// The rest of this line.
    std::string_view next_line();
    /// The next number. what: its name for errors. Fails outside of [low, high].
    double number(const std::string& what, double low = -max_number, double high = max_number);
    /// An integer from 1.
    std::size_t count(const std::string& what, std::size_t high);
    std::vector<double> ascending(const std::string& what, std::size_t number_of, double low,
                                  double high);
    /// Whether another number follows.
    bool has_number();

  private:
    void skip_blanks();
    [[nodiscard]] bool is_blank(char c) const;

    const std::string& file_;
    std::string_view rest_;
    int line_ = 1;
    bool decimal_commas_ = false;
};

/// Finds out by the number of values what commas mean in the numbers that follow TILT, and tells
/// the reader, which stands there. True for decimal commas. Fails where the file has such commas
/// and they cannot be read safely. tilt_included: the numbers begin with a table of tilt factors.
bool resolve_commas(IesReader& reader, bool tilt_included);

}  // namespace raybundle
