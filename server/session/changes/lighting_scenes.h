// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "raybundle.pb.h"
#include "scene/scene.h"
#include "session/changes/change_log.h"

namespace raybundle {

/// How all lights are set, under names that people give. Each is in the journal before it is here.
/// Knows neither GL nor the network.
class LightingScenes {
  public:
    static constexpr std::size_t max_scenes = 64;

    /// Takes up what the journal holds.
    explicit LightingScenes(ChangeLog& log);

    /// Takes up those of the scene's file, as far as the journal holds none of the name. They are
    /// not in the journal before somebody saves them there.
    void take_up(const Scene& scene);
    /// All of them, for a file.
    [[nodiscard]] std::vector<SavedLightingScene> saved() const;

    /// Keeps the lights as they are, in place of what has that name. False where there are too many
    /// or it cannot be stored; the reason is in refusal().
    /// key: of the request for it; empty: none.
    bool save(const std::string& name, const std::string& by_name, const Scene& scene,
              const std::string& key = {});
    /// Takes up one that another server of the project has stored or, where `body` is empty, taken
    /// away. What is to be told to viewers; unset where that is nothing.
    v1::ServerMessage follow(std::uint32_t number, const std::string& body);
    /// False where there is none (NOT_FOUND) or that cannot be stored.
    bool remove(const std::string& name);
    [[nodiscard]] const v1::Error& refusal() const { return refusal_; }

    [[nodiscard]] bool contains(const std::string& name) const { return scenes_.contains(name); }
    /// What brings the lights of the scene to what was saved; nothing for a name that is not known.
    [[nodiscard]] std::optional<std::vector<v1::SceneChanged>> changes_to(const std::string& name,
                                                                          const Scene& scene) const;

    void describe(v1::Scene* message) const;

  private:
    bool refuse(v1::Error::Code code, const std::string& reason);

    ChangeLog& log_;
    std::map<std::string, v1::JournalLightingScene> scenes_;  // by name
    std::uint32_t next_number_ = 1;
    v1::Error refusal_;
};

}  // namespace raybundle
