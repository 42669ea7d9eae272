// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include "scene/animation_script.h"

namespace raybundle {

std::string numbered_file(const std::string& pattern, unsigned number) {
    const std::size_t percent = pattern.find('%');
    std::size_t at = percent == std::string::npos ? percent : percent + 1;
    unsigned width = 1;
    if (at != std::string::npos && at + 1 < pattern.size() && pattern[at] == '0' &&
        pattern[at + 1] >= '1' && pattern[at + 1] <= '9') {
        width = static_cast<unsigned>(pattern[at + 1] - '0');
        at += 2;
    }
    if (at == std::string::npos || at >= pattern.size() || pattern[at] != 'd' ||
        pattern.find('%', at) != std::string::npos) {
        throw ScriptError("'" + pattern +
                          "' needs one %d for the number of the frame, as in "
                          "frame_%04d.png");
    }
    return fmt::format("{}{:0{}}{}", pattern.substr(0, percent), number, width,
                       pattern.substr(at + 1));
}

}  // namespace raybundle
