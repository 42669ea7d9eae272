// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "raybundle.pb.h"
#include "session/changes/change_log.h"

namespace raybundle {

/// Remembers the targets that viewers have set, by their names, also after the server has been
/// killed. A target is in the journal before it is here. Viewers without a name are not remembered.
/// Knows neither GL nor the network.
class TargetStore {
  public:
    static constexpr std::size_t max_targets = 64;  ///< what was set longest ago is forgotten first

    /// Takes up what the journal holds.
    explicit TargetStore(ChangeLog& log);

    /// Remembers a target; one without a goal is forgotten. False: it could not be stored, and
    /// nothing has changed.
    [[nodiscard]] bool keep(const std::string& name, const v1::SetTarget& target);

    /// Takes up one that another server of the project has stored or, where `body` is empty,
    /// forgotten.
    void follow(std::uint32_t number, const std::string& body);

    /// The target of that name; null where there is none.
    [[nodiscard]] const v1::SetTarget* of(const std::string& name) const;

  private:
    bool drop(const std::string& name);

    ChangeLog& log_;
    std::map<std::string, v1::JournalTarget> targets_;  ///< numbers grow with time
    std::uint32_t next_number_ = 1;
};

}  // namespace raybundle
