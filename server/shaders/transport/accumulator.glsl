// SPDX-License-Identifier: Apache-2.0
// Order-independent sums per patch: signed 64-bit fixed point in two 32-bit limbs with carry, since
// not every driver has 64-bit atomics. Unit 2^-36, so that the low limb alone holds typical values
// and the carry into the high limb is rare. Integer addition commutes: the same bits in any order.

layout(std430, binding = BINDING_ACCUMULATOR) buffer AccumulatorBuffer { uint accumulator[]; };
layout(std430, binding = BINDING_COUNTERS) buffer CounterBuffer { Counters counters; };

const float accumulator_limit = 134217728.0;  // 2^27

/// Adds a value to channel c (0..2) of a patch. Non-finite and absurd values are dropped and counted.
void accumulate(uint patch_id, uint channel, float value) {
    float magnitude = abs(value);
    if (!(magnitude < accumulator_limit)) {
        atomicAdd(counters.non_finite, 1u);
        return;
    }
    float sixteenths = magnitude * 16.0;
    float whole = floor(sixteenths);
    uint high = uint(whole);
    uint low = uint((sixteenths - whole) * 4294967296.0);
    if (value < 0.0) {  // two's complement
        low = ~low + 1u;
        high = ~high + (low == 0u ? 1u : 0u);
    }
    uint slot = 6u * patch_id + 2u * channel;
    if (low != 0u) {
        uint before = atomicAdd(accumulator[slot], low);
        high += before + low < before ? 1u : 0u;
    }
    if (high != 0u) {
        atomicAdd(accumulator[slot + 1u], high);
    }
}

/// Reads channel c of a patch and clears it.
float take_accumulated(uint patch_id, uint channel) {
    uint slot = 6u * patch_id + 2u * channel;
    uint low = accumulator[slot];
    uint high = accumulator[slot + 1u];
    accumulator[slot] = 0u;
    accumulator[slot + 1u] = 0u;
    return float(int(high)) * 0.0625 + float(low) * 1.4551915228366852e-11;
}
