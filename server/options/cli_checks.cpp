// SPDX-License-Identifier: Apache-2.0
#include "options/cli_checks.h"

#include <charconv>
#include <cmath>

namespace raybundle {

CLI::Validator number_that(bool (*fits)(double), const std::string& wanted) {
    return CLI::Validator(
        [fits, wanted](const std::string& text) {
            double value = 0.0;
            const char* const end = text.data() + text.size();
            const auto [last, error] = std::from_chars(text.data(), end, value);
            const bool number = last == end && error == std::errc() && std::isfinite(value);
            return number && fits(value) ? std::string() : "'" + text + "' is not " + wanted;
        },
        wanted);
}

CLI::Validator positive() {
    return number_that([](double value) { return static_cast<float>(value) > 0.0F; },
                       "a number above 0");
}

/// People may give it in percent.
CLI::Validator relative_error() {
    return number_that([](double value) { return value > 0.0 && value < 1.0; },
                       "a number above 0 and below 1 (0.05 is 5 %)");
}

}  // namespace raybundle
