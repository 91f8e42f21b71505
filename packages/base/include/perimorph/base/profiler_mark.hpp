#pragma once

#include <mpi.h>

namespace perimorph::base {

/// A part of a linear solve that a profiler of MPI can tell apart. Its number is given to MPI_Pcontrol when it begins
/// and the negative one when it ends, with two more arguments when it begins: what it reads of matrices and the like
/// [bytes], and how many unknowns it is about on this rank. Parts may lie within parts. Where no profiler listens it
/// costs a call of an empty function.
class ProfilerMark {
 public:
  /// Numbers that MPI and profilers leave free. Level l of multigrid is finest_level + l.
  static constexpr int iterations = 100, tangent = 101, finest_level = 102;

  ProfilerMark(int part, double bytes, double rows) : part_(part) { MPI_Pcontrol(part, bytes, rows); }
  ~ProfilerMark() { MPI_Pcontrol(-part_); }
  ProfilerMark(const ProfilerMark&) = delete;
  ProfilerMark& operator=(const ProfilerMark&) = delete;

 private:
  int part_;
};

}  // namespace perimorph::base
