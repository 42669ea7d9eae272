// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "view/viewer_image.h"

namespace raybundle {

/// The pictures that gather light in the running group of iterations, or in the running special
/// phase: they must stay the same meanwhile. A picture that is destroyed is removed first.
class ReceiverList {
  public:
    void clear() {
        list_.clear();
        pixels_ = 0.0;
    }
    void add(ViewerImage& picture) {
        list_.push_back(&picture);
        pixels_ += static_cast<double>(picture.size().x) * picture.size().y;
    }
    /// Does nothing for a picture that is not there, or null.
    void remove(const ViewerImage* picture) { std::erase(list_, picture); }

    [[nodiscard]] std::span<BundleReceiver* const> list() const { return list_; }
    /// Of all that have been added since clear().
    [[nodiscard]] double pixels() const { return pixels_; }

  private:
    std::vector<BundleReceiver*> list_;
    double pixels_ = 0.0;
};

}  // namespace raybundle
