// SPDX-License-Identifier: Apache-2.0
// What the random representation of the radiance (ch. 7.2) needs to know of a BRDF besides f_r.
//
// Light that comes in from w_in with irradiance I (cosine included) is reflected as I f_r(w_in,
// w_out). Its mean over all outgoing directions, each weighted by its cosine, is
//
//   1/pi * integral of I f_r(w_in, w_out) cos_out dw_out = I a(w_in) / pi,
//
// so the directional albedo is taken at the *incoming* angle: the main part is
// L_d = sum of a(w_in) I / pi over what comes in, per channel, and pi A L_d is the reflected flux.
// What is left is the difference BRDF
//
//   df_r(w_in, w_out) = f_r(w_in, w_out) - a(w_in) / pi,
//
// whose integral with cos_out is 0 for every w_in (so it is not reciprocal), and
// L_d + sum of I df_r(w_in, w_out) is the whole reflected radiance. A sample's importance,
// s(I, w_in) = max_c |I_c| * S(w_in) with
//
//   S(w_in) = integral of max_c |df_r,c(w_in, w_out)| cos_out dw_out,
//
// is zero only where df_r is zero for every channel and direction: S is 0 for a Lambert surface.
// The representation is right for any positive importance; S makes its terms similar in size. So a
// surface whose base colour varies may use the S of one representative colour, but a, which is in
// its mean, has to be that of the colour at hand.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "scene/material/brdf.h"
#include "scene/material/reflectance_nodes.h"

namespace raybundle {

/// Reflectance at one angle; albedo = lambert * transmission + f0 * scale + f90 * bias, and what a
/// clear coat reflects. In the table itself transmission is without the coat's.
struct ReflectanceNode {
    float scale = 0.0F;
    float bias = 0.0F;
    float transmission = 1.0F;
    float importance = 0.0F;  ///< S
};

/// Directional albedo and importance of a BRDF over the cosine of the incoming angle, interpolated
/// linearly between reflectance_nodes: both within 0.5 % of their integrals, below a coat that is
/// smoother than the lobe only from a cosine of 0.02 on.
class ReflectanceTable {
  public:
    /// Integrates S at every node: some milliseconds for a glossy BRDF.
    explicit ReflectanceTable(const Brdf& brdf);
    /// Takes the importance, node by node, from the table of a similar BRDF instead.
    ReflectanceTable(const Brdf& brdf, const ReflectanceTable& similar);

    /// a(cosine), per channel.
    [[nodiscard]] glm::vec3 albedo(float cosine) const { return albedo(brdf_, cosine); }
    /// The same for a BRDF that has the lobe of this table and other colours.
    [[nodiscard]] glm::vec3 albedo(const Brdf& recoloured, float cosine) const;
    /// S(cosine) of the BRDF that the table was made for.
    [[nodiscard]] float importance(float cosine) const { return at(cosine).importance; }
    /// Means over the hemisphere, 2 * integral of ... cos dcos: what is reflected of light that
    /// comes from everywhere alike, and how much of it a Lambert surface would send elsewhere.
    [[nodiscard]] glm::vec3 mean_albedo(const Brdf& recoloured) const;
    [[nodiscard]] float mean_importance() const { return mean_.importance; }

    [[nodiscard]] const Brdf& brdf() const { return brdf_; }
    [[nodiscard]] std::span<const ReflectanceNode> nodes() const { return nodes_; }

  private:
    void tabulate_albedo();
    [[nodiscard]] ReflectanceNode at(float cosine) const;
    [[nodiscard]] float integrate_importance(int index) const;
    ReflectanceNode integrate_mean();

    Brdf brdf_;
    ReflectanceNode mean_;
    float mean_coat_ = 0.0F;  // reflected by the clear coat
    std::array<ReflectanceNode, reflectance_nodes> nodes_;
};

}  // namespace raybundle
