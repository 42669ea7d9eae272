// SPDX-License-Identifier: Apache-2.0
#include "options/method_options.h"

#include <array>
#include <charconv>
#include <cmath>

#include "options/option_table.h"
#include "options/usage_message.h"

namespace raybundle {
namespace {

float parse_share(const std::string& option, const std::string& text) {
    float value = -1.0F;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() ||
        !(value >= 0.0F && value <= 1.0F)) {
        throw UsageError(option + ": '" + text + "' is not a number of 0 to 1");
    }
    return value;
}

bool has_shares(const RenderOptions& render) {
    return !render.shares.empty() || !render.first_shares.empty();
}

}  // namespace

void add_method_options(CLI::App& app, RenderOptions& render) {
    app.add_option("--shares", render.shares,
                   "P1,P2,P3: shares of layered, plane and perspective bundles, for --method "
                   "combined (default: as the light asks for, and as measured)");
    app.add_option("--first-shares", render.first_shares,
                   "The same in the beginning, towards --shares while samples gain weight")
        ->needs("--shares");
    app.add_option("--planes-per-direction", render.planes_per_direction,
                   "Plane bundles in a row that share a direction")
        ->capture_default_str()
        ->check(CLI::Range(1, 64));
    app.add_option("--roulette", render.roulette,
                   "Survival of paths, for --method path and path-reuse: throughput, albedo, or "
                   "optimum, by the variance of the light (default: throughput)");
}

std::optional<StrategyProbabilities> parse_shares(const std::string& option,
                                                  const std::string& text) {
    if (text.empty()) {
        return {};
    }
    std::array<float, 3> shares{};
    std::size_t begin = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const std::size_t end = i + 1 < shares.size() ? text.find(',', begin) : text.size();
        if (end == std::string::npos) {
            throw UsageError(option + ": '" + text + "' is not P1,P2,P3");
        }
        shares[i] = parse_share(option, text.substr(begin, end - begin));
        begin = end + 1;
    }
    const float sum = shares[0] + shares[1] + shares[2];
    constexpr float rounding = 0.001F;
    if (std::abs(sum - 1.0F) > rounding) {
        throw UsageError(option + ": the sum of '" + text + "' is not 1");
    }
    return StrategyProbabilities{shares[0] / sum, shares[1] / sum, shares[2] / sum};
}

void check_method_options(const RenderOptions& render, const RenderMethod& method) {
    const auto* kind = std::get_if<ReferenceKind>(&method);
    const bool paths =
        kind != nullptr && (*kind == ReferenceKind::path || *kind == ReferenceKind::path_reuse);
    if (has_shares(render) && render.method != "combined") {
        throw UsageError("--shares: only for --method combined, not " + render.method);
    }
    if (has_shares(render) && !render.script.empty()) {
        throw UsageError("--shares: only for single pictures, not --script");
    }
    if (!render.roulette.empty() && !paths) {
        throw UsageError("--roulette: only for --method path and path-reuse, not " + render.method);
    }
    if (!render.roulette.empty() && render.roulette != "throughput" &&
        render.roulette != "albedo" && render.roulette != "optimum") {
        throw UsageError("--roulette: '" + render.roulette +
                         "' is none of throughput, albedo, optimum");
    }
}

}  // namespace raybundle
