// SPDX-License-Identifier: Apache-2.0
// The light of a scene as viewers follow it: who draws by himself gets what has changed. No GL, no
// network, no clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace raybundle {

/// Values that are sent together: of vertices near one another.
struct LightBlock {
    std::size_t first = 0, count = 0;
    glm::vec3 centre{0.0F};  ///< of a ball that has their vertices, m
    float radius = 0.0F;     ///< m
};

/// Cuts values, one for each position, into blocks of so many in a row.
std::vector<LightBlock> cut_into_blocks(std::span<const glm::vec3> positions, std::size_t count);

/// The light as it was published last. Each block has a version, the number of the publication
/// that changed it last, and one encoding of it, which serves all viewers: a block is sent as it
/// is, never as a change of what a viewer had, so that of a viewer no more is known than the
/// versions that he has, and who is late skips what lies between.
class LightStream {
  public:
    explicit LightStream(std::vector<LightBlock> blocks);

    /// The present light, as rgb9e5(). Blocks that look otherwise than they were published get a
    /// new version. Returns how many. Throws std::invalid_argument where there are not as many
    /// values as in all blocks.
    std::size_t publish(std::span<const std::uint32_t> values);

    [[nodiscard]] std::span<const LightBlock> blocks() const { return blocks_; }
    /// How often something has been published that looks otherwise.
    [[nodiscard]] std::uint32_t publication() const { return publication_; }
    /// 0: not yet published.
    [[nodiscard]] std::uint32_t version(std::size_t block) const { return states_[block].version; }
    /// How much the block changed then: its largest step over what it was or is, 0 to 1.
    [[nodiscard]] float change(std::size_t block) const { return states_[block].change; }
    /// Of the present version, as encode_light_block().
    [[nodiscard]] const std::string& code(std::size_t block);
    /// All that the last publication changed, as LightMessage has it: one for all who had what was
    /// before.
    [[nodiscard]] std::shared_ptr<const std::string> last_changes();
    /// Blocks that have been encoded so far.
    [[nodiscard]] std::uint64_t encodings() const { return encodings_; }

  private:
    struct State {
        std::uint32_t version = 0;
        float change = 1.0F;
        std::uint32_t encoded = 0;  ///< version of `code`
        std::string code;
    };

    [[nodiscard]] float visible_change(const LightBlock& block,
                                       std::span<const std::uint32_t> values, float faint) const;

    std::vector<LightBlock> blocks_;
    std::vector<State> states_;
    std::vector<std::uint32_t> published_;
    std::uint32_t publication_ = 0;
    std::shared_ptr<const std::string> last_changes_;
    std::uint64_t encodings_ = 0;
};

/// Where a viewer is.
struct LightView {
    glm::vec3 eye{0.0F};
    glm::vec3 forward{0.0F, 0.0F, -1.0F};  ///< unit
    float half_angle = 0.8F;               ///< from it to the corners of the picture, radians
};

/// Blocks for one viewer: their number, and for each its index and the length of its code, all 32
/// bits, little-endian, then the code.
struct LightMessage {
    std::uint32_t number = 0;  ///< to be acknowledged
    std::shared_ptr<const std::string> bytes;
};

/// What one viewer has: who comes late has nothing, and gets all.
class LightFollower {
  public:
    /// What is to be sent now: new versions of blocks, those in the picture first, and of these
    /// what covers most of it and has changed most. Nothing where he has all, or has yet to
    /// acknowledge `window` bytes. Without any in flight a message has one block at least;
    /// otherwise what is in flight never exceeds the window.
    std::optional<LightMessage> next(LightStream& stream, const LightView& view,
                                     std::size_t window);
    /// He has this message and all before it. Unknown numbers are ignored.
    void acknowledge(std::uint32_t number);
    [[nodiscard]] std::size_t in_flight() const { return in_flight_; }  ///< bytes

  private:
    struct Sent {
        std::uint32_t number;
        std::size_t bytes;
    };

    LightMessage send(std::shared_ptr<const std::string> bytes);
    [[nodiscard]] std::shared_ptr<const std::string> most_wanted(LightStream& stream,
                                                                 const LightView& view,
                                                                 std::size_t window);

    std::optional<std::uint32_t> complete_ = 0;  // he has all of this publication
    std::vector<std::uint32_t> versions_;        // otherwise: of blocks
    std::deque<Sent> sent_;
    std::size_t in_flight_ = 0;
    std::uint32_t last_number_ = 0;
};

}  // namespace raybundle
