// SPDX-License-Identifier: Apache-2.0
// Values of options that are more than a number.
#include <charconv>
#include <cmath>
#include <map>

#include "options/cli_options.h"

namespace raybundle {

namespace {

float parse_float(const std::string& option, const std::string& text) {
    float value = 0.0F;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        throw UsageError(option + ": '" + text + "' is not a number");
    }
    return value;
}

}  // namespace

glm::uvec2 parse_size(const std::string& text) {
    const std::size_t cross = text.find('x');
    unsigned width = 0;
    unsigned height = 0;
    const char* end = text.data() + text.size();
    const bool ok =
        cross != std::string::npos &&
        std::from_chars(text.data(), text.data() + cross, width).ptr == text.data() + cross &&
        std::from_chars(text.data() + cross + 1, end, height).ptr == end;
    if (!ok || width < 1 || height < 1 || width > 16384 || height > 16384) {
        throw UsageError("--size: '" + text + "' is not WIDTHxHEIGHT with 1..16384 pixels each");
    }
    return {width, height};
}

glm::vec3 parse_vector(const std::string& option, const std::string& text) {
    const std::size_t first = text.find(',');
    const std::size_t second = first == std::string::npos ? first : text.find(',', first + 1);
    if (second == std::string::npos) {
        throw UsageError(option + ": '" + text + "' is not x,y,z");
    }
    return {parse_float(option, text.substr(0, first)),
            parse_float(option, text.substr(first + 1, second - first - 1)),
            parse_float(option, text.substr(second + 1))};
}

std::pair<std::string, std::uint16_t> parse_address(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    unsigned port = 0;
    const char* end = text.data() + text.size();
    if (colon == std::string::npos || colon == 0 || colon + 1 == text.size() ||
        std::from_chars(text.data() + colon + 1, end, port).ptr != end || port > 65535) {
        throw UsageError("--listen: '" + text + "' is not HOST:PORT, e.g. 127.0.0.1:8080");
    }
    std::string host = text.substr(0, colon);
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
        host = host.substr(1, host.size() - 2);
    }
    return {host, static_cast<std::uint16_t>(port)};
}

float metres_per_unit(const std::string& unit) {
    static const std::map<std::string, float> units = {
        {"m", 1.0F}, {"cm", 0.01F}, {"mm", 0.001F}, {"in", 0.0254F}, {"ft", 0.3048F}};
    const auto found = units.find(unit);
    if (found == units.end()) {
        throw UsageError("--unit: '" + unit + "' is none of m, cm, mm, in, ft");
    }
    return found->second;
}

}  // namespace raybundle
