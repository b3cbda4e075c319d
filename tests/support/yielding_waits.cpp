// SPDX-License-Identifier: BSD-3-Clause
// Waits that yield, for the tests of an MPI that never does: Debian's MPICH polls for a message without end, so where
// there are more ranks than cores each message waits until the scheduler takes the core away, some 10 ms later.
// By MPI's profiling interface (MPI 3.1, section 14.2) the calls that block, those of HDF5 too, become their
// non-blocking forms and tests with a yield between two of them. Only the parallel tests link this
// (TRIME_YIELDING_WAITS).
#include <mpi.h>

#include <array>
#include <sched.h>

namespace {

/// Ends with the request; bounded only by what MPI's own wait is bounded by.
int finish(MPI_Request* request, MPI_Status* status) {
  for (int done = 0;;) {
    if (const int error = PMPI_Test(request, &done, status); error != MPI_SUCCESS || done)
      return error;
    sched_yield();
  }
}

/// The same for a call that has begun, if it has.
int finish(int begun, MPI_Request* request) {
  return begun != MPI_SUCCESS ? begun : finish(request, MPI_STATUS_IGNORE);
}

} // namespace

extern "C" {

int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses) {
  for (int done = 0;;) {
    if (const int error = PMPI_Testall(count, requests, &done, statuses); error != MPI_SUCCESS || done)
      return error;
    sched_yield();
  }
}

int MPI_Sendrecv(const void* send, int send_count, MPI_Datatype send_type, int to, int send_tag, void* receive,
                 int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status* status) {
  std::array<MPI_Request, 2> requests{MPI_REQUEST_NULL, MPI_REQUEST_NULL};
  if (const int error = PMPI_Irecv(receive, count, type, from, tag, comm, requests.data()); error != MPI_SUCCESS)
    return error;
  if (const int error = PMPI_Isend(send, send_count, send_type, to, send_tag, comm, &requests[1]); error != MPI_SUCCESS)
    return error;
  if (const int error = finish(&requests[1], MPI_STATUS_IGNORE); error != MPI_SUCCESS)
    return error;
  return finish(requests.data(), status);
}

int MPI_Mprobe(int from, int tag, MPI_Comm comm, MPI_Message* message, MPI_Status* status) {
  for (int found = 0;;) {
    const int error = PMPI_Improbe(from, tag, comm, &found, message, status);
    if (error != MPI_SUCCESS || found)
      return error;
    sched_yield();
  }
}

int MPI_Barrier(MPI_Comm comm) {
  MPI_Request request = MPI_REQUEST_NULL;
  return finish(PMPI_Ibarrier(comm, &request), &request);
}

int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  MPI_Request request = MPI_REQUEST_NULL;
  return finish(PMPI_Ibcast(data, count, type, root, comm, &request), &request);
}

int MPI_Allreduce(const void* send, void* receive, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  MPI_Request request = MPI_REQUEST_NULL;
  return finish(PMPI_Iallreduce(send, receive, count, type, op, comm, &request), &request);
}

int MPI_Exscan(const void* send, void* receive, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  MPI_Request request = MPI_REQUEST_NULL;
  return finish(PMPI_Iexscan(send, receive, count, type, op, comm, &request), &request);
}

int MPI_Allgather(const void* send, int send_count, MPI_Datatype send_type, void* receive, int count, MPI_Datatype type,
                  MPI_Comm comm) {
  MPI_Request request = MPI_REQUEST_NULL;
  return finish(PMPI_Iallgather(send, send_count, send_type, receive, count, type, comm, &request), &request);
}

int MPI_Allgatherv(const void* send, int send_count, MPI_Datatype send_type, void* receive, const int* counts,
                   const int* places, MPI_Datatype type, MPI_Comm comm) {
  MPI_Request request = MPI_REQUEST_NULL;
  return finish(PMPI_Iallgatherv(send, send_count, send_type, receive, counts, places, type, comm, &request), &request);
}

int MPI_Gather(const void* send, int send_count, MPI_Datatype send_type, void* receive, int count, MPI_Datatype type,
               int root, MPI_Comm comm) {
  MPI_Request request = MPI_REQUEST_NULL;
  return finish(PMPI_Igather(send, send_count, send_type, receive, count, type, root, comm, &request), &request);
}

} // extern "C"
