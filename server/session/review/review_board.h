// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "raybundle.pb.h"
#include "scene/mesh/surface_place.h"
#include "session/changes/change_log.h"

namespace raybundle {

/// A pin and what its light is compared with.
struct Pin {
    v1::PinChanged message;
    std::optional<SurfacePlace> place;  ///< side_of() finds it where the journal lacks it
    std::uint32_t patch = 0;            ///< side of the mesh, as it was when it had
    std::size_t triangles = 0;          ///< so many triangles; 0: as the journal has it
    /// Mean irradiance of the patch when the pin was set, lx; follows the solution as it refines
    /// until the scene changes.
    float patch_illuminance = 0.0F;
    std::uint64_t next_look = 0;  ///< iterations from which on it is worth measuring better
};

/// What the viewers of a session leave for each other: pins and viewpoints. Each is in the journal
/// before it is here. Knows neither GL nor the network.
class ReviewBoard {
  public:
    static constexpr std::size_t max_pins = 256;
    static constexpr std::size_t max_viewpoints = 64;
    static constexpr int max_replies = 100;  ///< of a pin

    /// Takes up what the journal holds.
    explicit ReviewBoard(ChangeLog& log);

    /// Numbers a pin and stores it. Nothing where the board is full or it cannot be stored; the
    /// reason is in refusal().
    /// key: of the request for it; empty: none.
    const Pin* add_pin(Pin pin, const std::string& key = {});
    const v1::ViewpointChanged* add_viewpoint(v1::ViewpointChanged viewpoint,
                                              const std::string& key = {});
    /// What a request for a note is answered by that has been kept before; one that is gone since
    /// is removed there.
    [[nodiscard]] v1::ServerMessage answer_of(const KeyedNote& kept) const;

    /// Takes a note away; false where there is none (NOT_FOUND) or that cannot be stored.
    bool remove_pin(std::uint32_t number);
    bool remove_viewpoint(std::uint32_t number);
    /// Replaces what a pin says by what `change` makes of it. Nothing where there is no such pin
    /// (NOT_FOUND), `change` refuses with a text, or it cannot be stored.
    const Pin* change_pin(std::uint32_t number, const std::string& what,
                          const std::function<std::string(v1::PinChanged&)>& change,
                          const std::string& key = {});
    [[nodiscard]] const v1::Error& refusal() const { return refusal_; }

    /// Takes up a pin or viewpoint that another server of the project has stored or, where `body`
    /// is empty, taken away. What is to be told to viewers; unset where that is nothing.
    v1::ServerMessage follow(NoteKind kind, std::uint32_t number, const std::string& body);

    /// Stores what is known of the light at a pin, so that it is known after a restart. A failure
    /// is logged: the next value tries again.
    void keep(const Pin& pin);

    /// The next pin whose light is to be looked at again, in turn; null where there is none.
    Pin* next_pin();

    /// What a newcomer is told.
    void fill_welcome(v1::Welcome* welcome) const;

    [[nodiscard]] const std::map<std::uint32_t, Pin>& pins() const { return pins_; }

  private:
    bool refuse(v1::Error::Code code, const std::string& reason);
    bool refuse_unsaved(const std::string& reason);
    void add_stored_pin(const std::string& body);

    ChangeLog& log_;
    std::map<std::uint32_t, Pin> pins_;
    std::map<std::uint32_t, v1::ViewpointChanged> viewpoints_;
    std::uint32_t next_pin_number_ = 1;
    std::uint32_t next_viewpoint_number_ = 1;
    std::uint32_t last_checked_ = 0;
    v1::Error refusal_;
};

/// Compares the light at a pin with what it was. `illuminance`: of its patch now, lx. True where
/// `change` in its message is new or differs by more than 2 % of what was said last.
bool update_change(Pin& pin, float illuminance, std::uint32_t epoch);

}  // namespace raybundle
