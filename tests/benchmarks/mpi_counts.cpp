// A profiler of MPI for tools/studies/scaling-study --count and predict-scaling: a library to be loaded before MPI's
// (LD_PRELOAD), which counts what a solve sends in each of its parts (base::ProfilerMark), and writes a table to the
// file that PERIMORPH_MPI_COUNTS names when MPI ends.

#include <mpi.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace {

// Those of base::ProfilerMark; this library must not need the program's.
constexpr int iterations = 100;
constexpr int most_parts = 32;

/// Of one rank in one part, without the parts within it.
struct Counts {
  double visits = 0., messages = 0., bytes = 0., reductions = 0., others = 0., read = 0., rows = 0., holders = 0.,
         seconds = 0., processor_seconds = 0.;
};
constexpr int n_counts = sizeof(Counts) / sizeof(double);
/// Rows are the unknowns of the last visit; a rank with any of them is a holder.
constexpr std::array<const char*, n_counts> names = {
    "visits",     "messages", "bytes",   "reductions", "other_collectives",
    "bytes_read", "rows",     "holders", "seconds",    "processor_seconds"};

std::array<Counts, most_parts> parts;
std::vector<int> open_parts;  // the innermost last; only what lies in iterations counts
double since = 0., processor_since = 0.;

Counts* innermost() { return open_parts.empty() ? nullptr : &parts[open_parts.back()]; }

void note_message(int count, MPI_Datatype type) {
  Counts* const part = innermost();
  if (part == nullptr) return;
  int size = 0;
  PMPI_Type_size(type, &size);
  part->messages += 1.;
  part->bytes += static_cast<double>(count) * size;
}

void note(double Counts::*count) {
  if (Counts* const part = innermost()) part->*count += 1.;
}

void pass_time() {
  const double now = PMPI_Wtime();
  const double processor_now = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  if (Counts* const part = innermost()) {
    part->seconds += now - since;
    part->processor_seconds += processor_now - processor_since;
  }
  since = now;
  processor_since = processor_now;
}

void begin(int part, double bytes_read, double rows) {
  if (part >= most_parts || (part > 0 && open_parts.empty())) return;
  pass_time();
  open_parts.push_back(part);
  parts[part].visits += 1.;
  parts[part].read += bytes_read;
  parts[part].rows = rows;
  parts[part].holders = rows > 0. ? 1. : 0.;
}

void end(int part) {
  if (open_parts.empty() || open_parts.back() != part) return;
  pass_time();
  open_parts.pop_back();
}

/// part,then each count's largest value and its sum over the ranks
void write_table(const char* file) {
  int rank = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  std::FILE* const out = rank == 0 ? std::fopen(file, "w") : nullptr;
  if (out != nullptr) {
    std::fputs("part", out);
    for (const char* name : names) std::fprintf(out, ",%s_max,%s_sum", name, name);
    std::fputs("\n", out);
  }
  for (int part = 0; part < most_parts; ++part) {
    std::array<double, n_counts> largest{}, sum{};
    PMPI_Reduce(&parts[part], largest.data(), n_counts, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
    PMPI_Reduce(&parts[part], sum.data(), n_counts, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
    if (out == nullptr || sum[0] == 0.) continue;
    std::fprintf(out, "%d", part);
    for (int i = 0; i < n_counts; ++i) std::fprintf(out, ",%.17g,%.17g", largest[i], sum[i]);
    std::fputs("\n", out);
  }
  if (out != nullptr) std::fclose(out);
}

}  // namespace

extern "C" {

int MPI_Pcontrol(const int level, ...) {
  if (level <= -iterations) end(-level - iterations);
  if (level < iterations) return MPI_SUCCESS;
  std::va_list arguments;
  va_start(arguments, level);
  const double bytes_read = va_arg(arguments, double);
  const double rows = va_arg(arguments, double);
  va_end(arguments);
  begin(level - iterations, bytes_read, rows);
  return MPI_SUCCESS;
}

int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  note_message(count, type);
  return PMPI_Send(data, count, type, to, tag, comm);
}
int MPI_Rsend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  note_message(count, type);
  return PMPI_Rsend(data, count, type, to, tag, comm);
}
int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  note_message(count, type);
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}
int MPI_Irsend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  note_message(count, type);
  return PMPI_Irsend(data, count, type, to, tag, comm, request);
}
int MPI_Allreduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  note(&Counts::reductions);
  return PMPI_Allreduce(data, result, count, type, op, comm);
}
int MPI_Barrier(MPI_Comm comm) {
  note(&Counts::others);
  return PMPI_Barrier(comm);
}
int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  note(&Counts::others);
  return PMPI_Bcast(data, count, type, root, comm);
}
int MPI_Allgather(const void* data, int count, MPI_Datatype type, void* result, int each, MPI_Datatype to,
                  MPI_Comm comm) {
  note(&Counts::others);
  return PMPI_Allgather(data, count, type, result, each, to, comm);
}
int MPI_Reduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm) {
  note(&Counts::others);
  return PMPI_Reduce(data, result, count, type, op, root, comm);
}

int MPI_Finalize() {
  if (const char* const file = std::getenv("PERIMORPH_MPI_COUNTS")) write_table(file);
  return PMPI_Finalize();
}

}  // extern "C"
