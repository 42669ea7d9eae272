// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/picture_refusal.h"

namespace raybundle {

Refusal refusal_of(const GpuError& error) {
    if (dynamic_cast<const GlError*>(&error) != nullptr) {
        return {v1::Error::INTERNAL, std::string("no picture: ") + error.what(), std::nullopt};
    }
    return {v1::Error::RESOURCE_EXHAUSTED, "the server has no memory for a picture of this size",
            std::nullopt};
}

}  // namespace raybundle
