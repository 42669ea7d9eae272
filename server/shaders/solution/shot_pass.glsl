// SPDX-License-Identifier: Apache-2.0
// Sums over punctual lights from which the light of single ones can be taken back: what rounding leaves of a sum is kept beside
// it, so that all its parts can go and nothing of them stays (D. Knuth, The Art of Computer Programming 2, 4.2.2).
uniform uint shot_pass;    // SHOT_*
uniform uint first_light;  // of those that this dispatch looks at
uniform uint end_light;
uniform bool begins;  // the first dispatch of its pass

bool whole_shot() { return shot_pass == SHOT_ALL || shot_pass == SHOT_RENEW; }

/// Adds to a sum, or takes back.
void add_light(inout vec3 sum, inout vec3 rest, vec3 light) {
    precise vec3 part = shot_pass == SHOT_TAKE_BACK ? -light : light;
    precise vec3 next = sum + part;
    precise vec3 taken = next - sum;
    precise vec3 lost = (sum - (next - taken)) + (part - taken);
    precise vec3 small = rest + lost;
    precise vec3 result = next + small;
    precise vec3 left = small - (result - next);
    sum = result;
    rest = left;
}

/// Of light that is never negative: what rounding may leave where nothing is left.
void end_sum(inout vec3 sum, inout vec3 rest) {
    bvec3 none = lessThan(sum, vec3(0.0));
    sum = mix(sum, vec3(0.0), none);
    rest = mix(rest, vec3(0.0), none);
}
