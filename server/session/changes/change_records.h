// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "journal/change_sum.h"

namespace raybundle {

/// Who has changed what, when and from what, for people. The steps of a drag are one record, which
/// begins where the drag did.
class ChangeRecords {
  public:
    static constexpr std::size_t max_records = 1000;

    /// A change with all fields of SceneChanged, the newest one.
    void add(v1::SceneChanged change);

    /// The newest change with where the drag began that it ends, for who has not heard its steps.
    void tell_beginning(v1::SceneChanged& newest) const;

    /// Oldest first.
    void fill(v1::ChangeHistory* message) const;

  private:
    std::deque<v1::SceneChanged> records_;
};

/// The change with what its subject was like before it, as state_of() gives it.
void set_before(const v1::SceneChanged& before, v1::SceneChanged& change);

}  // namespace raybundle
