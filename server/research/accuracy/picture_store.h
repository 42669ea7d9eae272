// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

namespace raybundle {

/// Pictures that wait for their reference, in an unnamed temporary file: dozens of large ones would
/// fill the memory. All have the same number of pixels.
class PictureStore {
  public:
    /// Throws std::runtime_error where there is no room for temporary files.
    explicit PictureStore(std::size_t pixels);

    /// Keeps a picture in single precision; returns its number. Throws std::runtime_error.
    std::size_t add(std::span<const glm::dvec3> picture);
    /// Throws std::runtime_error.
    [[nodiscard]] std::vector<glm::dvec3> picture(std::size_t number) const;
    [[nodiscard]] std::size_t size() const { return count_; }

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void seek(std::size_t number) const;

    std::size_t pixels_;
    std::size_t count_ = 0;
    std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace raybundle
