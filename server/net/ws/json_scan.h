// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raybundle {

/// What a first pass over a JSON message finds out, whatever its schema.
struct JsonScan {
    std::string error;                ///< empty: strict JSON (RFC 8259), an object, within limits
    std::optional<std::uint32_t> id;  ///< top-level "id", where it is a 32-bit unsigned number
    std::vector<std::string> keys;    ///< top-level keys, in order
};

/// Reads `text` once without recursion and without building a tree. Protobuf's own parser is
/// lenient (single quotes, bare keys) and reports no id, so every text message passes here first.
JsonScan scan_json(std::string_view text, int max_depth);

}  // namespace raybundle
