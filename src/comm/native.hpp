// SPDX-License-Identifier: BSD-3-Clause
// Gives the module io access to the MPI communicator inside of a Communicator, because HDF5 needs it.
#pragma once

#include "trime/comm/communicator.hpp"

#include <mpi.h>

namespace trime::comm {

struct Communicator::Native {
  /// Returns a duplicate of `comm`.
  /// @pre MPI is running, and `comm` is one of its communicators
  static Communicator duplicate_of(MPI_Comm comm);

  MPI_Comm comm = MPI_COMM_NULL;
  int rank = 0;
  mutable Counters counters{}; // counters of this rank
};

inline MPI_Comm native_handle(const Communicator& communicator) {
  return communicator.native().comm;
}

} // namespace trime::comm
