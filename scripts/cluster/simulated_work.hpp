// SPDX-License-Identifier: BSD-3-Clause
// Measures the computations of the ranks of a simulated cluster, in simulated seconds. The ranks of SimGrid run
// alternately on one core, and each step of them all ends with the slowest. So a disturbance of that core delays all
// simulated ranks, far more than it would on P real cores. Therefore a run is repeated, and each stretch of work
// between two calls of MPI takes the least of its times: the calls of a rank are the same in each run.
#pragma once

namespace trime::comm {

/// Lives while a rank is in MPI, and stops the clock of its work. May be nested.
class InMpi {
public:
  InMpi();
  ~InMpi();
  InMpi(const InMpi&) = delete;
  InMpi& operator=(const InMpi&) = delete;
};

/// Begins and ends the measurement of the work of this rank. The environment variable TRIME_SIMULATED_WORK names a
/// directory, which keeps the least times of each rank from run to run; without it, the times of this run are used.
void begin_simulated_work();
void end_simulated_work();

} // namespace trime::comm
