// SPDX-License-Identifier: Apache-2.0
#include "session/memory_room.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "scheduling/cost_model.h"

namespace raybundle {

namespace {

/// The number in a file of one; nothing where there is none, as in "max".
std::optional<double> number_in(const char* file) {
    std::ifstream stream(file);
    double value = 0.0;
    return stream >> value ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<double> memory_available_in(std::istream& meminfo) {
    std::string name;
    double kilobytes = 0.0;
    while (meminfo >> name >> kilobytes) {
        if (name == "MemAvailable:") {
            return kilobytes * 1024.0;
        }
        std::getline(meminfo, name);
    }
    return std::nullopt;
}

std::optional<double> available_memory() {
    std::ifstream meminfo("/proc/meminfo");
    std::optional<double> available = memory_available_in(meminfo);
    const std::optional<double> limit = number_in("/sys/fs/cgroup/memory.max");
    const std::optional<double> used = number_in("/sys/fs/cgroup/memory.current");
    if (limit && used) {
        const double left = std::max(*limit - *used, 0.0);
        available = std::min(available.value_or(left), left);
    }
    return available;
}

std::optional<glm::uvec2> size_within_memory(glm::uvec2 wanted, double bytes_per_pixel,
                                             double available) {
    const double pixels = static_cast<double>(wanted.x) * static_cast<double>(wanted.y);
    const double room = available / std::max(bytes_per_pixel, 1.0);
    if (pixels <= room) {
        return wanted;
    }
    if (room < CostModel::min_pixels) {
        return std::nullopt;
    }
    const double scale = std::sqrt(room / pixels);
    const auto scaled = [scale](unsigned length) {
        return std::max(1U, static_cast<unsigned>(std::floor(scale * length)));
    };
    return glm::uvec2(scaled(wanted.x), scaled(wanted.y));
}

}  // namespace raybundle
