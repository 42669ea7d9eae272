// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "transport/transfer.h"

namespace raybundle {

/// Outcome of one comparison with a closed form.
struct OracleResult {
    double expected = 0.0;
    double measured = 0.0;
    double bound = 0.0;  ///< largest |measured - expected| that passes, in the unit of both
    bool passed = false;
};

/// A case whose answer is known exactly; `raybundle selftest` runs them all on the user's machine.
struct Oracle {
    std::string name;
    std::function<OracleResult()> run;  ///< needs a current GL context
};

std::vector<Oracle> all_oracles();

/// Shares of the strategies that an oracle is run with; the defaults are those of the solver.
struct OracleSettings {
    StrategyProbabilities probabilities;
    std::uint64_t iterations = 1024;
    std::uint64_t seed = 1;
    BundleResolution resolution{64, 120};
    /// Fault injection: the transfer's densities are multiplied by this. 1.02 must be caught.
    float density_error = 1.0F;
    /// So many triangles that follow each other share a patch, where their material is the same.
    std::uint32_t joined = 1;
    /// As SolverSettings::constant_radiance; a furnace without it is solved by transport alone.
    bool constant_radiance = false;
};

/// Area mean of the radiance in a rotated L-shaped room that emits everywhere, relative to
/// Le/(1 - albedo) (Siegel, Howell: isothermal enclosure).
double furnace_mean(float albedo, const OracleSettings& settings);
/// The same for the worst patch: largest relative deviation.
double furnace_worst(float albedo, const OracleSettings& settings);
/// Indirect illuminance, lx, in a 4 m cube lit by 10 000 lm: Phi albedo / (S (1 - albedo)) in the
/// mean.
double enclosure_indirect(float albedo, const OracleSettings& settings);
/// Form factors between the emitting face z = 0 of the unit cube and its others.
struct CubeFormFactors {
    double opposite = 0.0;
    double adjacent = 0.0;  ///< mean of four
};
CubeFormFactors cube_form_factors(const OracleSettings& settings);
/// Form factor between facing unit squares at a distance.
double squares_form_factor(float distance, const OracleSettings& settings);
/// Mean illuminance, lx, of a small square at distance h under a disc of radius a and flux Phi,
/// facing it.
double disc_illuminance(float radius, float height, float flux, const OracleSettings& settings);
/// The same in closed form (point to parallel disc off its axis, Howell's catalogue B-17), averaged
/// over the square.
double exact_disc_illuminance(double radius, double height, double flux);
/// Largest irradiance in the dark one of two rooms that share a wall of the given thickness, lx.
double dark_room_irradiance(float wall_thickness, const OracleSettings& settings);
/// Largest irradiance in a room of albedo 0.8 without any emitter.
double black_room_irradiance(const OracleSettings& settings);
/// Number of patches whose bits differ between two solutions of the same seed.
std::uint64_t differing_bits(const OracleSettings& settings);

}  // namespace raybundle
