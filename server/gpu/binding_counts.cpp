// SPDX-License-Identifier: Apache-2.0
#include "gpu/binding_counts.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "embedded_file.h"
#include "gpu/egl_context.h"

namespace raybundle {

namespace {

using Numbers = std::map<std::string_view, unsigned>;

/// What follows as one word.
std::string_view word_at(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_')) {
        ++end;
    }
    return text.substr(at, end - at);
}

/// The numbers of "#define BINDING_..." and "#define UNIT_...".
void find_numbers(std::string_view text, Numbers& numbers) {
    constexpr std::string_view define = "#define ";
    for (std::size_t at = text.find(define); at < text.size(); at = text.find(define, at)) {
        at += define.size();
        const std::string_view name = word_at(text, at);
        const std::string_view value = word_at(text, std::min(at + name.size() + 1, text.size()));
        if (name.starts_with("BINDING_") || name.starts_with("UNIT_")) {
            std::from_chars(value.data(), value.data() + value.size(), numbers[name]);
        }
    }
}

/// Names of the bindings of uniform blocks: "layout(std140, binding = BINDING_...)".
void find_uniforms(std::string_view text, std::set<std::string_view>& names) {
    constexpr std::string_view block = "std140, binding = ";
    for (std::size_t at = text.find(block); at < text.size(); at = text.find(block, at)) {
        at += block.size();
        names.insert(word_at(text, at));
    }
}

unsigned value_of(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return static_cast<unsigned>(std::max(value, 0));
}

void require(unsigned needed, unsigned driver, const std::string& what, const std::string& limit) {
    if (needed > driver) {
        throw GpuError("Raybundle needs " + std::to_string(needed) + " " + what +
                       ", and the driver has " + std::to_string(driver) + " (" + limit +
                       "). Use another driver or device: --list-gpus, --gpu");
    }
}

}  // namespace

BindingCounts bindings_needed() {
    Numbers numbers;
    std::set<std::string_view> uniforms;
    for (const EmbeddedFile& file : shader_files()) {
        find_numbers(file.contents, numbers);
        find_uniforms(file.contents, uniforms);
    }
    BindingCounts counts;
    for (const auto& [name, number] : numbers) {
        unsigned& count = name.starts_with("UNIT_") ? counts.textures : counts.storage;
        count = std::max(count, number + 1);
    }
    for (const std::string_view name : uniforms) {
        counts.uniforms = std::max(counts.uniforms, numbers.at(name) + 1);
    }
    return counts;
}

BindingCounts bindings_of_driver() {
    return {value_of(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS),
            value_of(GL_MAX_UNIFORM_BUFFER_BINDINGS),
            value_of(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS)};
}

void check_bindings(const BindingCounts& needed, const BindingCounts& driver) {
    require(needed.storage, driver.storage, "bindings of storage buffers",
            "GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS");
    require(needed.uniforms, driver.uniforms, "bindings of uniform buffers",
            "GL_MAX_UNIFORM_BUFFER_BINDINGS");
    require(needed.textures, driver.textures, "texture units",
            "GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS");
}

}  // namespace raybundle
