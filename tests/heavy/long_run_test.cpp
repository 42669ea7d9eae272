// SPDX-License-Identifier: Apache-2.0
// 10^6 iterations through the update shader: sums of a constant in fp32 would stop growing.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gpu/layouts.h"
#include "gpu/shader_program.h"

namespace raybundle {
namespace {

constexpr std::uint32_t patches = 64;
constexpr std::uint32_t iterations = 1'000'000;

/// Accumulators that hold one value in every channel, in the format of accumulator.glsl.
Buffer accumulators(double value) {
    const auto fixed = static_cast<std::uint64_t>(std::llround(value * std::ldexp(1.0, 36)));
    std::vector<std::uint32_t> words;
    for (std::uint32_t i = 0; i < 3 * patches; ++i) {
        words.push_back(static_cast<std::uint32_t>(fixed & 0xffffffffU));
        words.push_back(static_cast<std::uint32_t>(fixed >> 32U));
    }
    return Buffer::from<std::uint32_t>("constant sums", words);
}

/// Mean after bringing the update two samples in turn, `iterations` in all.
double mean_of_stream(double even, double odd) {
    const ShaderProgram update({"solution_update.comp"});
    const Buffer streams[] = {accumulators(even), accumulators(odd)};
    const Buffer sums("sums", streams[0].bytes());
    const Buffer irradiance("irradiance", patches * sizeof(glm::vec4));
    const Buffer source("source", patches * sizeof(glm::vec4));
    const Buffer counters("counters", sizeof(layout::Counters));
    const Buffer balance("balance", sizeof(layout::Balance));
    const Buffer flux("flux", 2 * sizeof(layout::FluxSums));
    const Buffer bundle("bundle", sizeof(layout::BundleParameters));
    for (const Buffer* buffer : {&irradiance, &source, &counters, &balance, &flux, &bundle}) {
        buffer->clear();
    }
    sums.bind_storage(BINDING_ACCUMULATOR);
    irradiance.bind_storage(BINDING_IRRADIANCE);
    source.bind_storage(BINDING_SOURCE);
    counters.bind_storage(BINDING_COUNTERS);
    balance.bind_storage(BINDING_BALANCE);
    flux.bind_storage(BINDING_FLUX);
    bundle.bind_uniform(BINDING_BUNDLE);
    update.set("patch_count", patches);
    update.set("block_count", 1U);
    update.set("scalar", 0);
    update.set("weight", 1.0F);
    update.set("step", 1e-3F);
    update.set("shooter_density", 0.0F);
    for (std::uint32_t i = 0; i < iterations; ++i) {
        glCopyNamedBufferSubData(streams[i % 2].get(), sums.get(), 0, 0,
                                 static_cast<GLsizeiptr>(sums.bytes()));
        update.dispatch(patches);
        storage_barrier();
        if (i % 4096 == 0) {
            glFinish();
        }
    }
    std::vector<glm::vec4> means(patches);
    irradiance.read<glm::vec4>(means);
    EXPECT_EQ(means[0].w, static_cast<float>(iterations));
    return static_cast<double>(means[patches - 1].y);
}

TEST(LongRun, MeanOfAConstantStreamIsExact) {
    constexpr double value = 1234.567;
    EXPECT_NEAR(mean_of_stream(value, value) / value, 1.0, 1e-5);
    float naive = 0.0F;
    for (std::uint32_t i = 0; i < iterations; ++i) {
        naive += static_cast<float>(value);
    }
    EXPECT_GT(std::abs(static_cast<double>(naive) / (value * iterations) - 1.0), 1e-5)
        << "a naive sum would do";
}

/// A stream that is not constant: what rounding adds to each step does not add up.
TEST(LongRun, MeanOfAnAlternatingStreamStaysInTheMiddle) {
    EXPECT_NEAR(mean_of_stream(0.0, 2000.0) / 1000.0, 1.0, 1e-3);
}

}  // namespace
}  // namespace raybundle
