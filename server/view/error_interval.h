// SPDX-License-Identifier: Apache-2.0
// From what a picture's batches say to its error: how much of their variance the mean of all has,
// the interval, and what more samples bring. README: "Error bars".
#pragma once

#include <cstdint>

namespace raybundle {

/// Estimated relRMSE of a picture with its 95 % interval.
struct ErrorInterval {
    double error = 1.0;
    double low = 0.0;
    double high = 1.0;
};

/// How even the samples are (transport/iteration_schedule.h): in the order of their low-discrepancy
/// sequence, or shuffled within blocks, as for glossy scenes.
enum class SampleOrder { low_discrepancy, shuffled };

/// Variance of the mean of all batches over the mean square deviation of single ones from it, with
/// so many samples in all. Batches are dealt out of one sequence, sample by sample at random, so
/// that they scatter nearly like independent ones (1/7), while their mean gains by the sequence.
double variance_of_mean(std::uint64_t samples, SampleOrder order);

/// What pixels do not resolve, relative: squared differences, over the picture's squared light,
/// that smoothing makes at edges and that other pixels have from their four neighbours.
double discretisation_error(double at_edges, double elsewhere);

/// noise: relative, as the batches say; discretisation: what no number of samples takes away,
/// relative.
ErrorInterval error_interval(double noise, double discretisation);

/// Whether some number of samples brings error_interval().high below a target.
bool reachable(double discretisation, double target);

/// Factor of the number of samples after which error_interval().high is at a target, >= 1; infinite
/// where it never is.
double samples_factor(double noise, double discretisation, double target, SampleOrder order);

}  // namespace raybundle
