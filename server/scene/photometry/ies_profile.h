// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/photometry/colour_rendering.h"

namespace raybundle {

/// Luminous intensity of a luminaire over direction, read from an IES file (ANSI/IES LM-63, 1986 to
/// 2019) or from EULUMDAT. Local axes: it is aimed along -z, where both photometric angles are 0
/// (as glTF's EXT_lights_ies has it); the horizontal plane of type C is x, y, and its plane C0
/// holds +x.
class IesProfile {
  public:
    enum class Type { c = 1, b = 2, a = 3 };  ///< coordinates, with LM-63's numbers

    /// The luminous part, around the photometric centre, m; along x and y of the local axes. 0: not
    /// stated.
    struct Opening {
        double length = 0.0;  ///< along x, in the plane C0
        double width = 0.0;   ///< along y; of round ones length and width are two diameters
        bool round = false;
        /// Of what shines on the sides that face +x, +y, -x and -y.
        std::array<double, 4> heights{};

        /// Area that is seen from a unit direction of the local axes, m²: of a box or a cylinder.
        [[nodiscard]] double projected_area(const glm::dvec3& direction) const;
    };

    /// What the file holds. Angles in degrees, ascending.
    struct Data {
        Type type = Type::c;
        std::vector<double> vertical;    ///< at least 1
        std::vector<double> horizontal;  ///< at least 1
        /// cd, with all of the file's factors; [horizontal * vertical.size() + vertical]
        std::vector<double> candela;
        double input_watts = 0.0;  ///< electrical, of the whole luminaire
        double lamp_lumens = 0.0;  ///< of all lamps, bare; <= 0: not known (absolute photometry)
        std::vector<std::string> notes{};  ///< what a user should know about how it was read
        Opening opening{};
        std::optional<ColourRendering> colour_rendering{};  ///< nothing: not stated
    };

    explicit IesProfile(Data data);

    /// Towards a unit direction in the local axes, cd; bilinear in the angles, 0 beyond those of
    /// the file.
    [[nodiscard]] double candela(const glm::dvec3& direction) const;
    /// Of all directions, lm.
    [[nodiscard]] double flux() const { return flux_; }
    /// How many times as steep over direction, root mean square, as that of a Lambert surface; at
    /// least 1. Where a table ends does not count.
    [[nodiscard]] double steepness() const { return steepness_; }
    [[nodiscard]] const Data& data() const { return data_; }
    void add_note(std::string note) { data_.notes.push_back(std::move(note)); }

  private:
    [[nodiscard]] double at(double vertical, double horizontal) const;
    [[nodiscard]] double folded(double horizontal) const;
    void integrate();

    Data data_;
    double flux_ = 0.0;
    double steepness_ = 1.0;
};

/// Parses the bytes of an IES file; `file` is its name for errors. Throws SceneError with the line
/// and the reason.
IesProfile parse_ies(const std::string& file, std::string_view bytes);

/// The same of a EULUMDAT file (Stockmar 1990), whose angles are those of type C.
IesProfile parse_eulumdat(const std::string& file, std::string_view bytes);

/// The same of either, by what is in it.
IesProfile parse_photometry(const std::string& file, std::string_view bytes);

/// Reads a file of either kind. Throws SceneError.
IesProfile read_photometry(const std::string& path);

}  // namespace raybundle
