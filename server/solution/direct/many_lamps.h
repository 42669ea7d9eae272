// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/readback.h"
#include "gpu/shader_program.h"
#include "solution/direct/lamp_order.h"
#include "solution/direct/placed_lights.h"
#include "solution/geometry/gpu_scene.h"
#include "trace/lamp_rays.h"

namespace raybundle {

/// The first shot of more punctual lights than there is room for shadow maps of: rays (Embree) say
/// which lamps reach which points, a row of LAMP_SLOTS lamps at a time, what may bring most first
/// (LampOrder). Patches have the first row at once, and of the other lamps an unbiased estimate by
/// LAMP_CHANCES drawn ones; advance() goes on until every lamp has been looked at. Deterministic.
class ManyLamps {
  public:
    explicit ManyLamps(const GpuScene& scene);

    /// Anew for the present lights and places, see FirstShot::update(). lights: the lamps as they
    /// were, becomes what they are; both bound as FirstShot::bind() does, as is the solution.
    void update(Buffer& lights, const IesProfiles& profiles, bool radiance_follows);
    /// A slice of the work that is left, of so many points at most. False where none is. Its
    /// points come from the GPU while something else goes on: they were asked for the last time.
    bool advance(std::size_t points);
    /// Puts what advance() has found into effect, between groups of iterations. True where it has.
    bool publish_found();
    [[nodiscard]] bool complete() const { return complete_; }
    /// Draws lamps that glossy patches take for proposals, for each cell.
    void draw_proposals(std::uint32_t seed);
    void bind() const;

    // For pixels: what of their light is known by the patches.

    /// Levels of the patches: after level l, lamps_of_level(l) of each cell have been looked at.
    [[nodiscard]] unsigned levels() const { return levels_; }
    [[nodiscard]] unsigned levels_known() const { return levels_known_; }
    [[nodiscard]] std::size_t lamps_of_level(unsigned level) const;
    /// Rows of slots that look at the lamps of [first, end) in each cell's order that reach a patch
    /// of it (dark: that reach none; only once complete()). Returns how many rows.
    std::vector<std::vector<std::uint32_t>> rows(std::size_t first, std::size_t end,
                                                 bool dark) const;
    /// The same row for all cells.
    [[nodiscard]] std::vector<std::uint32_t> row_of(std::span<const std::uint32_t> lamps) const;
    /// Binds a row for shaders/lamps/lamps.glsl, and what else it needs but the points.
    void bind_row(std::span<const std::uint32_t> row);
    /// Masks of points for a row, which are bound for shaders.
    void reach(std::span<const LampPoint> points, std::span<const std::uint32_t> row,
               bool before = false);
    /// The same for bound points that a shader has just written; waits for them.
    void reach(std::size_t points, std::span<const std::uint32_t> row, bool before = false);
    /// Points that there is room for.
    [[nodiscard]] std::size_t most_points() const { return most_points_; }
    void bind_levels() const { levels_buffer_.bind_storage(BINDING_LAMP_LEVELS); }
    void bind_points() const;
    /// Lamps that differ since the last update(), and the buffer that has them as they were; more
    /// than a few are not told apart.
    [[nodiscard]] const std::vector<std::uint32_t>& changed() const { return changed_; }
    [[nodiscard]] const Buffer& lights_before() const { return lights_before_; }
    /// Something else than the changed lamps has changed, too.
    [[nodiscard]] bool all_changed() const { return all_changed_; }
    /// Grows with every update().
    [[nodiscard]] std::uint64_t version() const { return version_; }
    [[nodiscard]] std::size_t bytes() const;

  private:
    static constexpr unsigned patch_points = 4;  // points of a patch
    /// Lamps of each cell that are looked at from all points of a patch, and anew after a move.
    static constexpr std::size_t near_lamps = std::size_t{4} * LAMP_SLOTS;

    struct Pass {
        unsigned parts = patch_points;
        float sign = 1.0F;
        bool before = false;
        bool chances = false;
        bool note = false;  // what reaches no patch of a cell
        bool but_moved = false;
        std::span<const Bounds> boxes;
    };
    void order_patches();
    void restart();
    void add_changes(Buffer& lights, std::span<const layout::PunctualData> now);
    void follow_moved();
    void add_moves(std::span<const Bounds> boxes);
    std::vector<bool> enclose_points(std::vector<Bounds>& cells);
    [[nodiscard]] std::vector<std::uint8_t> cells_behind(std::span<const std::uint32_t> row,
                                                         std::span<const Bounds> cells,
                                                         std::span<const Bounds> boxes) const;
    void run_some(std::span<const std::uint32_t> row, const Pass& pass,
                  std::vector<std::uint32_t> patches);
    [[nodiscard]] std::vector<std::uint32_t> rank_row(std::size_t rank) const;
    void run(std::span<const std::uint32_t> row, const Pass& pass, std::size_t first,
             std::size_t end);
    void run_all(std::span<const std::uint32_t> row, const Pass& pass);
    void write_points(std::size_t first, std::size_t end, unsigned parts);
    std::size_t make_points(std::size_t first, std::size_t end, unsigned parts);
    void add_points(std::span<const std::uint32_t> row, const Pass& pass, std::size_t first,
                    std::size_t end);
    void request_slice(std::size_t points);
    void draw_chances(std::size_t patches, const Pass& pass, std::size_t first);
    void note_dark(std::span<const std::uint32_t> row, std::size_t points);
    void publish_reflection(bool radiance_follows);
    void publish(bool adds, bool radiance_follows);
    void finish_row();
    void ask(std::span<const LampPoint> points, std::span<const std::uint32_t> rows,
             const Pass& pass, std::span<std::uint32_t> lit) const;
    [[nodiscard]] unsigned parts_of(std::size_t rank) const;

    const GpuScene& scene_;
    std::size_t lamps_;
    std::size_t most_points_;
    LampOrder order_;
    std::vector<std::uint32_t> patch_order_;  // by cell
    std::vector<layout::PunctualData> known_;
    std::vector<glm::vec4> places_;  // LampQuestion::lamps
    std::vector<glm::vec4> places_before_;
    std::vector<std::uint8_t> reaches_;  // by cell and rank: some patch
    std::vector<std::uint32_t> changed_;
    bool all_changed_ = true;
    float unit_ = 0.0F;  // of radiance, at the last update()
    std::uint64_t version_ = 0;
    std::size_t rank_ = 0;        // lamps of each cell that have been looked at
    std::size_t next_patch_ = 0;  // of the running row
    std::size_t quality_ = 0;     // lamps that what is in effect is worth
    std::uint32_t step_ = 0;
    bool complete_ = false, found_ = false;
    unsigned levels_, levels_known_ = 0;
    /// Patches of the order whose points have been asked for, of the running row.
    struct Slice {
        Buffer points;
        std::optional<Readback> back;
        std::size_t end = 0;
        std::vector<std::uint32_t> row;
        std::size_t rank = 0;  // of the row
    } slice_;
    std::vector<LampPoint> points_;
    std::vector<std::uint32_t> lit_;
    std::vector<glm::uvec2> drawn_;  // of the proposals
    Buffer cells_, order_buffer_, sums_, levels_buffer_, slots_, points_buffer_, masks_, chances_,
        proposals_, lights_before_;
    ShaderProgram make_points_, add_, publish_;
};

}  // namespace raybundle
