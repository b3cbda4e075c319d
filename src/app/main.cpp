// SPDX-License-Identifier: BSD-3-Clause
// trime_mpi: starts and ends MPI, and turns errors into messages and exit codes. The only try of the program.
#include "app/large_arrays.hpp"
#include "app/program.hpp"
#include "app/short_waits.hpp"
#include "app/signal_requests.hpp"
#include "app/user_places.hpp"
#include "comm/agree.hpp"
#include "core/processors.hpp"
#include "core/quoted.hpp"
#include "trime/core/log.hpp"
#include "trime/io/mesh_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

namespace {

using trime::ExitCode;

trime::io::RunFiles* run_files = nullptr;       ///< of main, set before the first handler: a handler has no arguments
trime::app::SignalRequests* requests = nullptr; ///< set before the first handler, too
volatile std::sig_atomic_t tells = 0;           ///< 1 on the rank whose handler says a word: rank 0, until its last one

/// Leaves no temporary file, then ends as the signal would have ended the program. Only calls that a handler may make.
void end_by_signal(int number) {
  const bool stands = run_files->final_mesh_written();
  run_files->remove_temporary();
  [[maybe_unused]] const bool erased = // else there is nothing to do about it
      tells == 0 || !trime::live_line_stands() ||
      write(STDOUT_FILENO, trime::live_line_eraser, sizeof trime::live_line_eraser - 1) > 0;
  constexpr char without[] = "trime_mpi: interrupted; the final mesh was not written\n";
  constexpr char with[] =
      "trime_mpi: interrupted; the final mesh is written, but the report or other files are missing\n";
  if (tells != 0 && write(STDERR_FILENO, stands ? with : without, (stands ? sizeof with : sizeof without) - 1) < 0)
    tells = 0; // nobody listens, and there is nothing to do about it
  std::signal(number, SIG_DFL);
  std::raise(number);
}

/// Where checkpoints are written, the run stops at the next one; a second signal ends it at once.
void end_in_order(int number) {
  if (requests->stops_in_order() && !requests->asks_to_stop())
    requests->ask_to_end();
  else
    end_by_signal(number);
}

/// Ends this process with the exit code of a checkpoint that was written before. The launcher ends the others.
[[noreturn]] void leave_at_checkpoint() {
  run_files->remove_temporary();
  constexpr char text[] = "trime_mpi: stopped; the last checkpoint is from before the clean-up\n";
  if (tells != 0 && write(STDERR_FILENO, text, sizeof text - 1) < 0)
    tells = 0;
  _exit(static_cast<int>(ExitCode::checkpointed));
}

/// From the clean-up on no checkpoint is written; while files are written, the run continues to its end.
void stop_at_checkpoint(int) {
  if (!requests->writes_no_more()) {
    requests->ask_to_stop();
    return;
  }
  if (requests->last_stands())
    leave_at_checkpoint();
  constexpr char text[] = "trime_mpi: it is too late for a checkpoint; the run continues to its end\n";
  if (tells != 0 && write(STDERR_FILENO, text, sizeof text - 1) < 0)
    tells = 0;
}

void write_checkpoint(int) {
  requests->ask_to_write();
}

/// Before MPI starts, which takes a while: without handlers these signals would end the program.
void listen_to_requests() {
  std::signal(SIGUSR1, stop_at_checkpoint);
  std::signal(SIGUSR2, write_checkpoint);
  std::signal(SIGALRM, stop_at_checkpoint);
}

/// Handles the signals that end a program, except those that its starter has set to be ignored (nohup). A file that
/// grows beyond its limit does not end the program: the write fails with an error.
void handle_signals(bool tell) {
  tells = tell ? 1 : 0;
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGABRT, SIGXCPU})
    if (std::signal(number, number == SIGINT || number == SIGTERM ? end_in_order : end_by_signal) == SIG_IGN)
      std::signal(number, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

/// Every line of the message as one line of error.
void print_error(const std::string& message) {
  constexpr std::size_t longest = 5000; // bytes: more than a path may have
  std::string text;
  for (std::size_t at = 0; at <= message.size();) {
    const std::size_t end = std::min(message.find('\n', at), message.size());
    text += "trime_mpi: error: " + trime::without_middle(message.substr(at, end - at), longest) + "\n";
    at = end + 1;
  }
  std::fflush(stdout);
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

/// A run that has stopped in order.
void print_stop(const std::string& message) {
  std::fflush(stdout);
  std::fputs(("trime_mpi: " + message + "\n").c_str(), stderr);
}

/// Ends the whole job for an error that this rank has alone: others may wait for it without end.
[[noreturn]] void leave_alone(const std::string& message, ExitCode code) {
  print_error(message);
  run_files->remove_temporary();
  trime::comm::abort_job(static_cast<int>(code));
}

/// Runs the program. Errors should be the same on all ranks; then rank 0 prints them. Any other error ends the job.
/// @param leaving on which ranks meet that have an error
ExitCode run(int argc, char** argv, const trime::comm::Communicator& comm, const trime::comm::Communicator& leaving) {
  constexpr double patience = 10; // [s] ranks that throw the same error may be that far apart
  trime::app::UserPlaces places;
  try {
    return trime::app::run_program(argc, argv, comm, {run_files, *requests, places});
  } catch (const trime::Error& error) {
    if (!trime::comm::all_arrive(leaving, patience))
      leave_alone(fmt::format("{} (rank {} alone)", places.explain(error.message()), comm.rank()), error.code());
    if (comm.is_root())
      error.code() == ExitCode::checkpointed ? print_stop(error.what()) : print_error(places.explain(error.message()));
    return error.code();
  } catch (const std::bad_alloc&) {
    leave_alone(trime::out_of_memory_text(), ExitCode::out_of_memory);
  } catch (const std::exception& error) {
    leave_alone(std::string("internal error: ") + error.what() + "; please report this with the config",
                ExitCode::internal_error);
  }
}

} // namespace

int main(int argc, char** argv) {
  trime::app::shorten_waits(argv);
  trime::app::prepare_large_arrays();
  trime::io::RunFiles files;
  run_files = &files;
  trime::app::SignalRequests signals;
  requests = &signals;
  listen_to_requests();
  const trime::comm::Environment environment(argc, argv);
  const trime::comm::Communicator comm = trime::comm::Communicator::world();
  handle_signals(comm.is_root());
  const trime::comm::Communicator leaving = trime::comm::Communicator::world();
  const ExitCode code = run(argc, argv, comm, leaving);
  if (code != ExitCode::done && comm.max(std::int64_t{trime::io::hdf5_cannot_end()}) > 0)
    trime::comm::abort_job(static_cast<int>(code));
  tells = 0; // all has been said; mpirun may end ranks that are slow to leave by a signal
  return static_cast<int>(code);
}
