// SPDX-License-Identifier: BSD-3-Clause
// Measures the computations of the ranks of a simulated cluster, in simulated seconds. The simulated ranks run
// alternately on one real core, and each step ends when the slowest rank ends. So a short disturbance of this core
// delays all simulated ranks, far more than it would on a real cluster. Therefore a run is repeated, and each piece of
// work between two MPI calls counts with the smallest of its measured times. This is possible because a rank makes the
// same calls in each run.
#pragma once

namespace trime::comm {

/// Exists while a rank is in an MPI call, and stops the clock of the rank's work. May be nested.
class InMpi {
public:
  InMpi();
  ~InMpi();
  InMpi(const InMpi&) = delete;
  InMpi& operator=(const InMpi&) = delete;
};

/// Begin and end the measurement of the work of this rank. If the environment variable TRIME_SIMULATED_WORK names a
/// directory, the smallest times of each rank are kept there from run to run; otherwise the times of this run are used.
void begin_simulated_work();
void end_simulated_work();

} // namespace trime::comm
