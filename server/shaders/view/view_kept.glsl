// What a pixel shows of light that was kept over the last change, and how well that is known. For view_statistics.comp and
// view_probe.comp, after view_radiance.glsl and view_scatter.glsl.
uniform float error_before;  // relative error of the picture before the change: unchanged light is no better known

struct KeptShare {
    float share;     // of the kept mean in what is shown
    float variance;  // of that mean, relative
    float mean;      // luminances of both means
    float recent;
    float before;    // and of the kept mean before it was brought to another level
};

/// A mean of weight w has the variance (s E)^2 / w, see corrected_weight.glsl, by what the change has left; and at least that
/// which it had.
KeptShare kept_share(uint patch_id, vec4 kept, vec4 own) {
    const float squared_deviation = 0.16;  // s^2 of corrected_weight.glsl
    vec4 believed = believed_sum(patch_id, kept, own);
    KeptShare k;
    k.share = believed.w / max(believed.w + own.w, 1e-30);
    k.variance = max(error_before * error_before, squared_deviation / max(believed.w, 1e-30));
    k.mean = luminance(believed.rgb) / max(believed.w, 1e-30);
    k.recent = own.w > 0.0 ? luminance(own.rgb) / own.w : 0.0;
    k.before = luminance(kept.rgb) / kept.w;
    return k;
}
