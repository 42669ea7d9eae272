// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace raybundle {

/// Writes the Prometheus text format, version 0.0.4: each family once, its samples below it.
class MetricsText {
  public:
    /// A family with one sample.
    void gauge(std::string_view name, std::string_view help, double value);
    void counter(std::string_view name, std::string_view help, double value);

    /// A family whose samples follow. `type` is gauge, counter or summary.
    void family(std::string_view name, std::string_view type, std::string_view help);
    /// Of the last family. `labels` as in `strategy="perspective"`; values must need no escaping.
    void sample(std::string_view name, std::string_view labels, double value);

    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string text_;
};

}  // namespace raybundle
