// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "journal/project_log.h"

namespace raybundle {

/// What was made of a request with a key.
struct MadeRequest {
    v1::SceneChanged change;  ///< unset where the request stands for several
    RequestKey key;           ///< of its last change so far
};

/// The requests with a key that have been carried out, so that none is twice: the last ones, of
/// changes and of notes.
class MadeRequests {
  public:
    static constexpr std::size_t max_keys = 16384;  ///< of either

    /// change: as it is announced, and answers its requests also when they come again.
    void note(const std::vector<RequestKey>& keys, const v1::SceneChanged& change);
    /// A note without a key is none.
    void note(const KeyedNote& note);

    /// Null where it is not known.
    [[nodiscard]] const MadeRequest* change(const std::string& key) const;
    [[nodiscard]] const KeyedNote* kept(const std::string& key) const;

  private:
    template <typename Made>
    struct Known {
        std::map<std::string, Made> made;
        std::deque<std::string> keys;  ///< of `made`, oldest first

        void add(const std::string& key, Made value);
        [[nodiscard]] const Made* find(const std::string& key) const;
    };
    Known<MadeRequest> changes_;
    Known<KeyedNote> notes_;
};

}  // namespace raybundle
