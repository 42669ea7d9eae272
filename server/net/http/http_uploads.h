// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "net/http/upload_check.h"
#include "net/network_state.h"

struct lws;

namespace raybundle {

/// The uploads of all connections: their bytes go to the upload, its result comes back as an
/// answer. Network thread only, except that results arrive from other threads.
class HttpUploads {
  public:
    /// `wake` makes the network thread look at finished(); any thread calls it.
    HttpUploads(NetworkState& state, std::function<void()> wake)
        : state_(state), wake_(std::move(wake)) {}

    /// The refusal, or nothing where the body is to follow.
    std::optional<HttpResponse> begin(lws* connection, const UploadRequest& request);

    /// Part of the body; those of connections without an upload are dropped. Where it cannot be
    /// stored, the answer that says so.
    std::optional<HttpResponse> write(lws* connection, std::string_view bytes);

    /// The time for the body is over: the answer that says so, or nothing where it is complete.
    std::optional<HttpResponse> expire(lws* connection);

    /// The body is complete.
    void complete(lws* connection);

    /// Answers that have come since the last call.
    std::vector<std::pair<lws*, HttpResponse>> finished();

    /// The connection is gone; what is unfinished is dropped.
    void forget(lws* connection) { running_.erase(connection); }

  private:
    struct Answer {
        std::mutex mutex;
        std::optional<UploadResult> result;
    };
    struct Running {
        std::unique_ptr<Upload> upload;
        std::uint64_t missing = 0;  ///< bytes of the body that have not come
        std::shared_ptr<Answer> answer = std::make_shared<Answer>();
    };

    NetworkState& state_;
    std::function<void()> wake_;
    std::map<lws*, Running> running_;
};

}  // namespace raybundle
