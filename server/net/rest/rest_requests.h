// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <list>
#include <memory>
#include <string>
#include <string_view>

#include "net/http/http_response.h"
#include "net/rest/rest_call.h"

namespace raybundle {

/// Requests that were answered with 202: they run on, under a path that nobody can guess, and their
/// answers are kept there. One that nobody has asked for in a quarter of an hour is dropped, and
/// with it what it has begun.
class RestRequests {
  public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::minutes lifetime{15};
    static constexpr std::size_t most_answers = 64;  ///< the oldest are dropped

    /// 202 with the path.
    HttpResponse keep(std::unique_ptr<RestCall> call, std::string peer,
                      Clock::time_point now = Clock::now());

    /// The answer of one, 202 while it has none, 404 where there is none of this name.
    HttpResponse look(std::string_view name, Clock::time_point now = Clock::now());

    /// 200, or 404.
    HttpResponse drop(std::string_view name);

    /// Hears what has been said to them, and drops those that nobody asks for.
    void listen(Clock::time_point now = Clock::now());

    /// Those without an answer, of one caller or of all.
    [[nodiscard]] std::size_t running(std::string_view peer) const;
    [[nodiscard]] std::size_t running() const;

  private:
    struct Entry {
        std::string name;
        std::string peer;
        std::unique_ptr<RestCall> call;
        Clock::time_point asked;
    };
    std::list<Entry>::iterator find(std::string_view name);

    std::list<Entry> entries_;  ///< the oldest first
};

}  // namespace raybundle
