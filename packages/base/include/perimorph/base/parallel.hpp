#pragma once

#include <Teuchos_Comm.hpp>
#include <functional>
#include <string>
#include <vector>

#include "perimorph/base/algebra.hpp"

namespace perimorph::base {

using Comm = Teuchos::Comm<int>;

/// Runs local work that may throw; if it threw on any rank, every rank throws that error (of the lowest such rank).
/// Collective.
/// @param local_work must not communicate
/// @throws UserError, ComputationError (MemoryError where there is none left) or Bug, the same on all ranks.
void on_all_ranks(const Comm& comm, const std::function<void()>& local_work);

/// Sum and largest value over all ranks. Collective.
double sum(const Comm& comm, double value);
GlobalId sum(const Comm& comm, GlobalId value);
double max(const Comm& comm, double value);
GlobalId max(const Comm& comm, GlobalId value);

/// Element-wise sums over all ranks, in place. Collective.
/// @param values this rank's, as many on every rank; on return the sums
void sum(const Comm& comm, std::vector<double>& values);

/// The first of n items in a rank's share, if all ranks have about as many, in order; n itself after the last rank.
/// Local.
inline GlobalId first_of_share(const Comm& comm, GlobalId n, int rank) { return n * rank / comm.getSize(); }

/// Concatenates every rank's values in the order of ranks: on rank 0 only (empty elsewhere), or on all. Collective.
template <class T>
std::vector<T> gather_on_root(const Comm& comm, const std::vector<T>& values);
template <class T>
std::vector<T> gather_on_all(const Comm& comm, const std::vector<T>& values);

/// Sends outgoing[r] to rank r and returns what each rank r sent here. T is trivially copyable. Collective.
/// @param outgoing (n_ranks), each of any length
/// @return (n_ranks)
template <class T>
std::vector<std::vector<T>> exchange(const Comm& comm, const std::vector<std::vector<T>>& outgoing);

/// The text of rank 0 on every rank. Collective.
/// @param text what the other ranks give is ignored
std::string broadcast(const Comm& comm, std::string text);

}  // namespace perimorph::base

#include "perimorph/base/parallel_templates.hpp"
