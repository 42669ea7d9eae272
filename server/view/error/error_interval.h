// SPDX-License-Identifier: Apache-2.0
// From the scatter of a picture's samples to its error: the share of it that their mean keeps, the
// interval, and what more samples bring. tests/README.md, "Error bars".
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

/// From so many samples on the error of their mean falls like n^-exponent beside that of
/// independent ones.
struct SequenceGain {
    double exponent;
    double from_samples;
};
SequenceGain gain_of(SampleOrder order);

/// Variance of the mean of so many samples over what it would be were they independent. Every
/// iteration is a sample of its own: where 8 batches have 7 degrees of freedom times those of the
/// picture (about 5), so that their variance is known to +-25 % whatever the number of samples, n
/// samples have n - 1 times as many. Measured on the Cornell box at 64, 128 and 384 samples,
/// standard deviation of the estimated relRMSE between runs: 8 batches 14, 10 and 11 %, this 7, 4
/// and 2 %.
double variance_of_mean(std::uint64_t samples, SampleOrder order);

/// True error over what the scatter of the samples says, in the mean: as long as few samples matter
/// they have not shown their largest yet. independent_noise: relative noise of their mean were they
/// independent, 1/sqrt of the number of samples that matter. Of 18 scenes with 16 to 192 samples
/// ln(true over stated error) was 0.5 +- 0.45 in the mean where it is 1 (standard deviation between
/// scenes), 0.2 +- 0.35 at 0.45, 0.1 +- 0.22 at 0.25, 0.05 +- 0.13 at 0.1.
double few_samples(double independent_noise);

/// How far the mean of the samples is behind, relative, at least, while their light still rises or
/// falls: they do not scatter about what they have not reached. ahead: by how much the iterate, a
/// mean of recent samples, is brighter than the mean of all, over the picture; noise: of the
/// latter. The iterate averages fewer samples and gains nothing by their sequence, so that by
/// chance it is ahead by noise sqrt(n s / (2 variance_of_mean)), s being its step
/// (Solver::iterate_step(): n^-0.8, n^-0.66 with a sky), were the noise the same all over the
/// picture. So much counts for nothing.
double lag_of_mean(double ahead, double noise, std::uint64_t samples, SampleOrder order, bool sky);

/// What a picture tells beside the scatter of its samples, all relative to the shown light.
struct TwoMeans {
    double ahead = 0.0;        ///< see lag_of_mean()
    double noise = 0.0;        ///< of the mean of its samples, were they independent
    double apart = 0.0;        ///< what is shown of the difference between light that was kept over
                               ///< the last change and what has come in since
    double noise_apart = 0.0;  ///< of that, what the latter's scatter explains
    bool rises = false;        ///< the latter is brighter
    double kept_share = 0.0;   ///< of what is shown
    double changed = 0.0;      ///< by how much pixels have become another since the change
    double shown_noise = 0.0;  ///< of what is shown
    double earlier = 0.0;      ///< mean light when there were samples / more samples; 0: not known
    double more = 2.0;         ///< times as many samples there are now
};

/// What may be wrong with a picture and does not scatter, relative to the shown light.
struct SuspectedError {
    double missing = 0.0;    ///< light that is still to come, or whose sign is not known
    double left_over = 0.0;  ///< light from before a change that is still there, below 1
};

/// Both, as far as they are more than chance: by the upper end of what the noise may be.
///  - The level of the light since a change is the iterate's, whose noise all its samples have in
///    common (see lag_of_mean()), so that their scatter does not show it.
///  - Light that has risen or fallen since there were fewer samples goes on: what a change or the
///    start has left behind fades like 1/n or faster, since weights of samples grow, so that what
///    is left is at most the step divided by (more - 1).
///  - Where that is not known yet, a share of 1/(2n) of the light that has gone is taken to be
///  left:
///    so much was when the only window of a room closed (0.5/n +- 0.2/n from 16 to 192 samples).
SuspectedError suspected(const TwoMeans& means, std::uint64_t samples, SampleOrder order, bool sky);

/// Variance of the mean of so many samples over that of the iterate, were they independent: 2/(n
/// s).
double variance_of_patches(std::uint64_t samples, bool sky);

/// What pixels do not resolve, relative: squared differences, over the picture's squared light,
/// that smoothing makes at edges and that other pixels have from their four neighbours.
double discretisation_error(double at_edges, double elsewhere);

/// What is left of that where each pixel is the mean of grid x grid at staggered places: what six
/// scenes had left was 0.6 to 1.9 of this (with the root of grid 0.4 to 1.1, with grid itself 0.9
/// to 3.1).
double unresolved_share(unsigned grid);

/// Half the width of the interval of ln(error) that luck alone gives, where nothing else is known.
/// The noise of a picture is a sum over few modes (10 to 20 in five scenes), see SampleBatches.
/// Shuffled, the gain is uncertain, too.
double usual_luck(SampleOrder order);

/// noise: relative, as samples say, `samples` in all; discretisation: what no number of samples
/// takes away, relative. With N and D for both and T^2 = N^2 + D^2, d(ln T) = (N^2 d(ln N) +
/// D^2 d(ln D)) / T^2. Both parts err independently, their logarithms nearly normally, so that the
/// interval ends at T exp(+-h), h^2 = (N^2 h_N)^2 + (D^2 h_D)^2 over T^4. luck: see
/// SampleBatches::luck().
ErrorInterval error_interval(double noise, double discretisation, std::uint64_t samples,
                             SampleOrder order, double luck);
/// The same with the usual luck.
ErrorInterval error_interval(double noise, double discretisation, std::uint64_t samples,
                             SampleOrder order);

/// The same so many samples after a change: how well light is known that was kept over it follows
/// from the weights that the change has left, and the common noise of what has come in since does
/// not show. Logarithms of true over stated errors of 20 pictures, 16 to 64 samples after six kinds
/// of changes, had a standard deviation of 0.4, of which half its variance is that of new solves.
/// Weights give up more than is wrong, so that new samples soon count: below, the interval is
/// wider.
ErrorInterval after_change(const ErrorInterval& interval, std::uint64_t samples);

/// The same where up to such a share of the shown light has no right to be there, rather half of
/// it: the true picture is darker by it, and the error larger relative to that.
ErrorInterval with_left_over(const ErrorInterval& interval, double share);

/// What a measurement of the squared error makes of an interval that a picture's own samples say:
/// both together, by Bayes' rule over the logarithm of the error. The samples know of noise alone,
/// so that once in ten times they are taken to be far off; what was measured is as it is, with
/// the tails of its own uncertainty. So where both agree the interval is narrower than either, and
/// where they do not it is what was measured. The error is the median.
ErrorInterval measured_interval(const ErrorInterval& said, double square, double standard_error);

/// Whether some number of samples brings error_interval().high below a target.
bool reachable(double discretisation, double target);

/// Factor of the number of samples after which error_interval().high is at a target, >= 1; infinite
/// where it never is.
double samples_factor(double noise, double discretisation, double target, std::uint64_t samples,
                      SampleOrder order);

/// A picture whose error was measured; all parts relative.
struct MeasuredPicture {
    ErrorInterval measured;
    double noise = 0.0;                ///< to be expected, as its samples say
    double discretisation = 0.0;       ///< part of the measured error, as it is
    double discretisation_then = 0.0;  ///< when pixels are drawn more finely
};

/// The same for a measured error. What it is larger or smaller than expected is the luck of the
/// samples so far, which have a share of 1/f in a picture of f times as many: of a squared error
/// N_m^2 where N^2 was to be expected (1 - 1/f) N^2 / f^2x + N_m^2 / f^(2x + 1) is left.
double samples_factor(const MeasuredPicture& picture, double target, SampleOrder order);

}  // namespace raybundle
