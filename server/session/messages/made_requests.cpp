// SPDX-License-Identifier: Apache-2.0
#include "session/messages/made_requests.h"

#include <utility>

namespace raybundle {

template <typename Made>
void MadeRequests::Known<Made>::add(const std::string& key, Made value) {
    if (made.insert_or_assign(key, std::move(value)).second) {
        keys.push_back(key);
    }
    while (keys.size() > max_keys) {
        made.erase(keys.front());
        keys.pop_front();
    }
}

template <typename Made>
const Made* MadeRequests::Known<Made>::find(const std::string& key) const {
    const auto found = made.find(key);
    return found == made.end() ? nullptr : &found->second;
}

void MadeRequests::note(const std::vector<RequestKey>& keys, const v1::SceneChanged& change) {
    for (const RequestKey& key : keys) {
        changes_.add(key.text, {key.parts == 0 ? change : v1::SceneChanged(), key});
    }
}

void MadeRequests::note(const KeyedNote& note) {
    if (!note.key.empty()) {
        notes_.add(note.key, note);
    }
}

const MadeRequest* MadeRequests::change(const std::string& key) const {
    return changes_.find(key);
}

const KeyedNote* MadeRequests::kept(const std::string& key) const {
    return notes_.find(key);
}

}  // namespace raybundle
