// SPDX-License-Identifier: BSD-3-Clause
#include "comm/agree.hpp"

#include "comm/mpi_call.hpp"
#include "core/processors.hpp"

#include <chrono>
#include <new>
#include <thread>

namespace trime::comm {
namespace {

/// The class that belongs to an exit code, so that callers can catch what the documentation names.
[[noreturn]] void throw_error(ExitCode code, const std::string& message) {
  switch (code) {
  case ExitCode::usage:
    throw ConfigError(message);
  case ExitCode::geometry:
    throw GeometryError(message);
  case ExitCode::file:
    throw FileError(message);
  case ExitCode::internal_error:
    throw InternalError(message);
  default:
    throw Error(code, message);
  }
}

} // namespace

void agree(const Communicator& comm, const std::optional<Error>& error) {
  const std::int64_t failing = comm.min(std::int64_t{error ? comm.rank() : comm.size()});
  if (failing == comm.size())
    return;
  const int root = static_cast<int>(failing);
  std::string text;
  if (error)
    text.append(1, static_cast<char>(error->code())).append(error->message().formatted());
  text = comm.broadcast(std::move(text), root);
  const std::string suffix = root > 0 ? fmt::format(" (rank {})", root) : "";
  throw_error(static_cast<ExitCode>(text[0]), text.substr(1) + suffix);
}

std::optional<Error> error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& e) {
    return e;
  } catch (const std::bad_alloc&) {
    return Error(ExitCode::out_of_memory, out_of_memory_text());
  } catch (const std::exception& e) {
    return InternalError(e.what());
  } catch (...) { // a user's shape or size may throw anything; a rank that left with it would leave the others waiting
    return InternalError("an exception that is not a std::exception");
  }
  return std::nullopt;
}

void run_agreed(const Communicator& comm, const std::function<void()>& work) {
  agree(comm, error_of(work));
}

bool all_arrive(const Communicator& comm, double seconds) {
  using Clock = std::chrono::steady_clock;
  if (comm.size() == 1)
    return true;
  const InMpi in_mpi;
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Ibarrier(native_handle(comm), &request));
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  int arrived = 0;
  check(MPI_Test(&request, &arrived, MPI_STATUS_IGNORE));
  while (arrived == 0 && Clock::now() < end) {
    if (!is_simulated())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    check(MPI_Test(&request, &arrived, MPI_STATUS_IGNORE));
  }
  return arrived != 0;
}

} // namespace trime::comm
