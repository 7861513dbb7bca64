// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "detector/cluster.h"
#include "detector/event_batch.h"
#include "detector/nuclide.h"
#include "detector/sensor.h"

namespace comptonaut {

/// Both readings of two clusters that one photon left.
struct PairHypotheses {
  ConeHypothesis a;  ///< scattered in the first cluster, absorbed in the second
  ConeHypothesis b;  ///< the other way
};

/// Depth of the first cluster over the second: z_1 - z_2 = v_drift (t_1 - t_2), um, along +z of D. Electrons drift to
/// the pixels on the low-z face, so the later cluster lay farther from them.
[[nodiscard]] double depth_difference_um(const SensorConfig& sensor, const Cluster& first, const Cluster& second);

/// Cones and probabilities of both hypotheses for a photon of the channel's line. Probabilities follow from Klein and
/// Nishina's cross section at the electron's energy and the chance that the scattered photon came just so far and was
/// absorbed there; which of the two clusters was read out first tells nothing. The cone's angle is that of the two
/// energies fitted to the line, or (constrain_to_line false) of their own sum.
/// nullopt unless the summed energy lies in the channel's window and at least one hypothesis is physical: the electron
/// at most at the Compton edge, the photon at least at its backscattered energy, each widened by pair_sigmas.
[[nodiscard]] std::optional<PairHypotheses> pair_hypotheses(const SensorConfig& sensor, const NuclideChannel& channel,
                                                            bool constrain_to_line, const Cluster& first,
                                                            const Cluster& second);

/// Attenuation of CdTe (5.85 g/cm^3) by the photoelectric effect, 1/m: a cubic in log(E) through NIST's XCOM, within
/// 1 % from 50 to 1500 keV; below 50 keV its value there.
[[nodiscard]] double cdte_photoelectric_per_m(double energy_keV);
/// The same by Compton scattering: Klein and Nishina's cross section of all electrons as free ones, within 6 % of XCOM
/// above 150 keV.
[[nodiscard]] double cdte_compton_per_m(double energy_keV);

}  // namespace comptonaut
