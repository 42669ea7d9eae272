// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "net/http/upload.h"
#include "scene/scene_folder.h"

namespace raybundle {

/// JSON of GET /photometry: an array of {name, flux (lm), power (W), size (length, width, height of
/// the luminous opening, m), problems}, by names. Of a file that cannot be read problems alone.
std::string photometry_json(const SceneFolder& folder);

/// Checks a photometric file and puts it into the folder. One that is there stays as it is: another
/// one of its name is refused.
UploadResult store_photometry(const SceneFolder& folder, const std::string& name,
                              const std::string& bytes);

/// A photometric file on its way in. submit: has something done on another thread; false: not now.
std::unique_ptr<Upload> photometry_upload(std::shared_ptr<const SceneFolder> folder,
                                          std::string name,
                                          std::function<bool(std::function<void()>)> submit);

}  // namespace raybundle
