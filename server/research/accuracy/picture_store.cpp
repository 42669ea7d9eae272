// SPDX-License-Identifier: Apache-2.0
#include "research/accuracy/picture_store.h"

#include <sys/types.h>

#include <stdexcept>

namespace raybundle {

PictureStore::PictureStore(std::size_t pixels) : pixels_(pixels), file_(std::tmpfile()) {
    if (!file_) {
        throw std::runtime_error("no temporary file for pictures can be made");
    }
}

void PictureStore::seek(std::size_t number) const {
    if (fseeko(file_.get(), static_cast<off_t>(number * pixels_ * sizeof(glm::vec3)), SEEK_SET) !=
        0) {
        throw std::runtime_error("the temporary file of pictures cannot be used");
    }
}

std::size_t PictureStore::add(std::span<const glm::dvec3> picture) {
    if (picture.size() != pixels_) {
        throw std::invalid_argument("pictures of different sizes");
    }
    const std::vector<glm::vec3> packed(picture.begin(), picture.end());
    seek(count_);
    if (std::fwrite(packed.data(), sizeof(glm::vec3), pixels_, file_.get()) != pixels_ ||
        std::fflush(file_.get()) != 0) {
        throw std::runtime_error("the temporary file of pictures cannot be written");
    }
    return count_++;
}

std::vector<glm::dvec3> PictureStore::picture(std::size_t number) const {
    if (number >= count_) {
        throw std::out_of_range("no such picture");
    }
    std::vector<glm::vec3> packed(pixels_);
    seek(number);
    if (std::fread(packed.data(), sizeof(glm::vec3), pixels_, file_.get()) != pixels_) {
        throw std::runtime_error("the temporary file of pictures cannot be read");
    }
    return {packed.begin(), packed.end()};
}

}  // namespace raybundle
