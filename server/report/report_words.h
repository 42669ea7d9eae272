// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "report/report_data.h"

namespace raybundle {

constexpr double lux_per_foot_candle = 10.763910416709722;  // square feet in a square metre

/// Words of a report, in its language.
class ReportWords {
  public:
    explicit ReportWords(const ReportOptions& options) : options_(options) {}

    /// One of two texts.
    [[nodiscard]] const char* of(const char* english, const char* german) const {
        return options_.german ? german : english;
    }
    [[nodiscard]] const ReportOptions& options() const { return options_; }
    [[nodiscard]] std::string quantity(v1::Measure::Quantity quantity) const;
    /// lx, fc, % or nothing.
    [[nodiscard]] std::string unit(v1::Measure::Quantity quantity) const;
    /// A value of a quantity, in that unit without its name.
    [[nodiscard]] std::string number(double value, v1::Measure::Quantity quantity) const;
    [[nodiscard]] std::string verdict(v1::Verdict verdict) const;
    /// Ra of a luminaire, v1::Light or v1::Measured::Luminaire: "83", "80 to 89"; "" where it is
    /// not known.
    template <class Lamp>
    [[nodiscard]] std::string colour_rendering(const Lamp& lamp) const {
        return lamp.has_colour_rendering()
                   ? range(lamp.colour_rendering(), lamp.has_colour_rendering_most()
                                                        ? lamp.colour_rendering_most()
                                                        : lamp.colour_rendering())
                   : "";
    }
    /// Unix time, ms, as 2026-06-21 15:00 UTC.
    [[nodiscard]] static std::string time(double unix_ms);

  private:
    [[nodiscard]] std::string range(float least, float most) const;

    ReportOptions options_;
};

/// Whether the quantity is an illuminance.
bool is_illuminance(v1::Measure::Quantity quantity);

}  // namespace raybundle
