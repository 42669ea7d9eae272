// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "measure/requirement.h"
#include "raybundle.pb.h"
#include "session/changes/change_log.h"

namespace raybundle {

/// The requirements of a project, by name; some well-known rows where nobody has changed them. Each
/// change is in the journal before it is here.
class RequirementBoard {
  public:
    static constexpr std::size_t most_rows = 256;

    /// Takes up what the journal holds.
    explicit RequirementBoard(ChangeLog& log);

    /// All rows as a note of the log has them.
    void restore(const std::string& body);
    /// False where there are too many or it cannot be stored; the reason is in refusal().
    bool set(const v1::Requirement& row);
    /// False where there is none (NOT_FOUND) or that cannot be stored.
    bool remove(const std::string& name);
    [[nodiscard]] const v1::Error& refusal() const { return refusal_; }

    [[nodiscard]] bool has(const std::string& name) const { return rows_.contains(name); }
    /// What a row asks of this quantity; nothing of a row that does not exist.
    [[nodiscard]] Requirement required(const std::string& name, Quantity quantity) const;
    /// message: v1::Welcome, v1::RequirementsChanged or v1::JournalRequirements.
    template <class Message>
    void fill(Message* message) const {
        for (const auto& [name, row] : rows_) {
            *message->add_requirements() = row;
        }
    }

  private:
    bool keep(std::map<std::string, v1::Requirement> rows);
    bool refuse(v1::Error::Code code, const std::string& reason);

    ChangeLog& log_;
    std::map<std::string, v1::Requirement> rows_;
    v1::Error refusal_;
};

}  // namespace raybundle
