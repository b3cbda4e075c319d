// SPDX-License-Identifier: BSD-3-Clause
#include "comm/running_mpi.hpp"

#include "core/thread_loop.hpp"
#include "trime/comm/from_mpi.hpp"
#include "trime/core/error.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>

namespace trime::comm {
namespace {

bool is_first_of_world() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank == 0;
}

/// While it lives, MPI returns the errors that belong to no valid communicator; by default it ends the job.
class ReturnedErrors {
public:
  ReturnedErrors() {
    MPI_Comm_get_errhandler(MPI_COMM_WORLD, &of_world_);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  }
  ~ReturnedErrors() {
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, of_world_);
    MPI_Errhandler_free(&of_world_);
  }
  ReturnedErrors(const ReturnedErrors&) = delete;
  ReturnedErrors& operator=(const ReturnedErrors&) = delete;

private:
  MPI_Errhandler of_world_ = MPI_ERRHANDLER_NULL;
};

/// MPI_Init starts MPI for one thread. Calls from the main thread alone work with every MPI that we know.
void warn_of_one_thread() {
  int provided = MPI_THREAD_SINGLE;
  MPI_Query_thread(&provided);
  if (provided < needed_thread_level && thread_count() > 1 && is_first_of_world())
    std::fprintf(stderr,
                 "trime: warning: MPI was started for one thread, and OpenMP has %d; start it by "
                 "MPI_Init_thread with MPI_THREAD_FUNNELED, or set OMP_NUM_THREADS=1\n",
                 thread_count());
}

/// Returns whether Open MPI surely uses the setting of avoid_wrong_writer(): at the first call of this function, the
/// user had chosen a file writer, or MPI was not running yet and so had opened no file.
bool writer_is_chosen_in_time() {
  static const bool in_time = !mpi_is_running() || std::getenv("OMPI_MCA_fcoll") != nullptr;
  return in_time;
}

#ifdef OPEN_MPI
/// Returns the setting by which Open MPI chooses the file writer; "?" if it is not known. Takes 0.2 s, since Open MPI
/// then loads all its components.
std::string chosen_writers() {
  std::string value = "?";
  int provided = 0, index = 0, length = 0;
  if (MPI_T_init_thread(MPI_THREAD_SINGLE, &provided) != MPI_SUCCESS)
    return value;
  MPI_T_cvar_handle handle = nullptr;
  if (MPI_T_cvar_get_index("fcoll", &index) == MPI_SUCCESS &&
      MPI_T_cvar_handle_alloc(index, nullptr, &handle, &length) == MPI_SUCCESS) {
    std::string text(static_cast<std::size_t>(length) + 1, '\0');
    if (MPI_T_cvar_read(handle, text.data()) == MPI_SUCCESS)
      value = text.c_str();
    MPI_T_cvar_handle_free(&handle);
  }
  MPI_T_finalize();
  return value;
}
#endif

} // namespace

bool mpi_is_running() {
  int initialized = 0, finalized = 0;
  MPI_Initialized(&initialized);
  MPI_Finalized(&finalized);
  return initialized != 0 && finalized == 0;
}

void avoid_wrong_writer() {
  writer_is_chosen_in_time();
  setenv("OMPI_MCA_fcoll", "^vulcan", 0); // stays if the user has chosen a writer
}

void join_running_mpi() {
  avoid_wrong_writer();
  [[maybe_unused]] static const bool is_done = [] {
    warn_of_one_thread();
    return true;
  }();
}

void warn_of_wrong_writer([[maybe_unused]] bool speaks) {
#if defined(OPEN_MPI) && OMPI_MAJOR_VERSION == 4
  [[maybe_unused]] static const bool is_done = [&] {
    if (!writer_is_chosen_in_time() && chosen_writers().empty() && speaks)
      std::fputs("trime: warning: the program opened a file by MPI before it used this library, so Open MPI may write "
                 "mesh files by its component 'vulcan', which is known to write wrong data. Every file is read back "
                 "and compared; setting OMPI_MCA_fcoll=^vulcan avoids the risk\n",
                 stderr);
    return true;
  }();
#endif
}

void check_usable(MPI_Comm comm) {
  if (!mpi_is_running())
    throw ConfigError(
        "MPI is not running: make a trime::Environment or call MPI_Init_thread before, and call MPI_Finalize "
        "only afterwards");
  if (comm == MPI_COMM_NULL)
    throw ConfigError("the communicator is MPI_COMM_NULL: expected one that this rank belongs to; ranks that "
                      "MPI_Comm_split left out must not call this function");
  const ReturnedErrors returned;
  int is_inter = 0;
  // Open MPI's handles are addresses: one that was freed is in its table no more, though the memory may look valid.
  if (MPI_Comm_f2c(MPI_Comm_c2f(comm)) != comm || MPI_Comm_test_inter(comm, &is_inter) != MPI_SUCCESS)
    throw ConfigError("the communicator is not valid: it was freed before it was used here");
  if (is_inter != 0)
    throw ConfigError("the communicator joins two groups of ranks (an intercommunicator): expected one of a single "
                      "group, see MPI_Intercomm_merge");
}

} // namespace trime::comm
