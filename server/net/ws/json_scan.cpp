// SPDX-License-Identifier: Apache-2.0
#include "net/ws/json_scan.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace raybundle {
namespace {

/// Event handler for nlohmann's parser; returning false ends the parse.
class Scanner : public nlohmann::json_sax<nlohmann::json> {
  public:
    Scanner(JsonScan& scan, int max_depth) : scan_(scan), max_depth_(max_depth) {}

    bool null() override { return value(); }
    bool boolean(bool /*value*/) override { return value(); }
    bool string(string_t& /*value*/) override { return value(); }
    bool binary(binary_t& /*value*/) override { return value(); }
    bool number_integer(number_integer_t /*value*/) override { return value(); }

    bool number_unsigned(number_unsigned_t number) override {
        if (depth_ == 1 && key_is_id_ && number <= std::numeric_limits<std::uint32_t>::max()) {
            scan_.id = static_cast<std::uint32_t>(number);
        }
        return value();
    }

    bool number_float(number_float_t number, const string_t& /*text*/) override {
        return std::isfinite(number) ? value() : fail("a number is not finite");
    }

    bool start_object(std::size_t /*elements*/) override { return open(); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool start_array(std::size_t /*elements*/) override {
        return depth_ == 0 ? fail("the message is not a JSON object") : open();
    }

    bool key(string_t& key) override {
        if (depth_ == 1) {
            key_is_id_ = key == "id";
            scan_.keys.push_back(std::move(key));
        }
        return true;
    }

    bool parse_error(std::size_t position, const std::string& /*token*/,
                     const nlohmann::detail::exception& error) override {
        const bool overflow = dynamic_cast<const nlohmann::json::out_of_range*>(&error) != nullptr;
        return fail((overflow ? "a number is not finite, at byte " : "not valid JSON at byte ") +
                    std::to_string(position));
    }

  private:
    bool value() { return depth_ == 0 ? fail("the message is not a JSON object") : true; }

    bool open() {
        if (++depth_ > max_depth_) {
            return fail("JSON is nested more than " + std::to_string(max_depth_) + " deep");
        }
        return true;
    }

    bool close() {
        --depth_;
        return true;
    }

    bool fail(std::string error) {
        if (scan_.error.empty()) {
            scan_.error = std::move(error);
        }
        return false;
    }

    JsonScan& scan_;
    int max_depth_;
    int depth_ = 0;
    bool key_is_id_ = false;
};

}  // namespace

JsonScan scan_json(std::string_view text, int max_depth) {
    JsonScan scan;
    Scanner scanner(scan, max_depth);
    const bool complete = nlohmann::json::sax_parse(text.begin(), text.end(), &scanner);
    if (!complete && scan.error.empty()) {
        scan.error = "not valid JSON";
    }
    return scan;
}

}  // namespace raybundle
