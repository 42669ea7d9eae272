// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "json_viewer.h"
#include "raw_client.h"

namespace raybundle {

/// A client that draws by itself, as far as the server knows: it takes in light and acknowledges
/// it, and its frames.
class LightViewer {
  public:
    explicit LightViewer(std::uint16_t port);

    /// Says hello; the welcome, or the error.
    Json join(bool light = true);
    void send(const Json& message) { client_.send_text(message.dump()); }
    /// The answer to a request.
    Json request(Json body);

    /// Reads messages until `enough`. False: the connection is over, or it takes
    /// too long.
    bool read_until(const std::function<bool()>& enough);

    /// The light as far as it has come, as stored, and what was told of it.
    std::vector<std::uint32_t> values;
    Json scene;  ///< lightScene; null: not yet
    Json sky;    ///< lightSky
    std::vector<Json> materials;
    std::uint32_t epoch = 0;              ///< of the newest light
    std::uint32_t last = 0;               ///< number of the newest message of light
    std::size_t messages = 0, bytes = 0;  ///< of light
    std::size_t frames = 0;
    bool acknowledges = true;
    [[nodiscard]] bool complete() const { return !scene.is_null() && blocks_ >= block_count_; }
    /// Mean of the values' luminance.
    [[nodiscard]] double mean() const;

  private:
    void take_text(const Json& message);
    void take_binary(const std::string& payload);

    RawClient client_;
    std::uint32_t last_id_ = 0;
    Json answer_;
    std::vector<bool> seen_;
    std::size_t blocks_ = 0, block_count_ = 0;
};

}  // namespace raybundle
