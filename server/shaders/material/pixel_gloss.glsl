// SPDX-License-Identifier: Apache-2.0
// Glossy part of a viewer's pixels (ch. 7.3: the view-dependent radiance, here per pixel). What a pixel shows
// is  a(w_eye) E / pi + S,  S = sum over the incident light of  I (f_r(w_in, w_eye) - a(w_eye)/pi),
// so that S is 0 under light that comes from everywhere alike, whatever the material. Accumulated like the
// irradiance (pixel_sum.glsl): rgb = weighted sum, w = weight that came along when last resolved.
#include "brdf.glsl"
#include "pixel_albedo.glsl"
#include "facets.glsl"

/// The BRDF at a pixel whose directional albedo towards the eye is known; at_out: brdf_at() of that angle.
Brdf pixel_brdf(uint record, vec3 albedo, float cos_out, out vec4 at_out) {
    Brdf plain = make_brdf(record, vec3(0.0));
    at_out = brdf_at(plain, cos_out);
    int at = 3 * int(record);
    vec4 lobe = texelFetch(reflectance_texels, at + 1);
    float f0_share = lobe.y < 0.0 ? 0.0 : texelFetch(reflectance_texels, at).w;
    float lambert_share = lobe.z;
    vec3 uncoloured = plain.f0 * at_out.x + plain.f90 * at_out.y;
    float per_colour = lambert_share * at_out.z + f0_share * at_out.x;
    return make_brdf(record, max(albedo - uncoloured, 0.0) / max(per_colour, 1e-4));
}
