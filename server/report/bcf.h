// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raybundle.pb.h"

namespace raybundle {

/// Pins as topics of the BIM Collaboration Format, version 3.0 (buildingSMART): a ZIP archive with
/// bcf.version, extensions.xml and, for each topic, a folder of its markup and viewpoint. BCF has
/// metres with Z up: (x, y, z) of here is (x, -z, y) of there.
///
/// GUIDs of pins and replies that have none are made of `project` and their numbers, so that the
/// same pin is the same topic whenever it is exported.
std::string write_bcf(const std::vector<v1::PinChanged>& pins, const std::string& project);

/// Topics of a BCF archive (2.0 to 3.0) as pins: texts, comments as replies, state, viewpoint, the
/// place where its camera looks. Their numbers are those that the labels of write_bcf() give, or 0.
/// Nothing and a reason where it is none.
std::optional<std::vector<v1::PinChanged>> read_bcf(std::string_view bytes, std::string& reason);

/// GUID of a pin in BCF, as write_bcf() gives it.
std::string bcf_guid(const v1::PinChanged& pin, const std::string& project);
/// Of one of its replies. guid: the pin's.
std::string bcf_reply_guid(const std::string& guid, const v1::PinChanged& pin, int reply);

}  // namespace raybundle
