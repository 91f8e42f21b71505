#include "far_fields.hpp"

#include <Eigen/Eigenvalues>
#include <Tpetra_Operator.hpp>
#include <algorithm>
#include <cmath>

#include "perimorph/base/errors.hpp"

namespace perimorph::solvers {

namespace {

constexpr int most_fields = 12;

}  // namespace

FarFields::FarFields(const base::Comm& comm, const Teuchos::RCP<Operator>& linear_operator)
    : comm_(&comm),
      operator_(linear_operator),
      fields_(Teuchos::rcp(new MultiVector(linear_operator->getDomainMap(), most_fields))),
      products_(Teuchos::rcp(new MultiVector(linear_operator->getDomainMap(), most_fields))) {}

FarFields FarFields::moved_to(const Teuchos::RCP<Operator>& linear_operator, const std::vector<int>& old_nodes,
                              int dim) const {
  FarFields moved(*comm_, linear_operator);
  moved.size_ = size_;
  moved.next_ = next_;
  PERIMORPH_ASSERT(old_nodes.size() * dim == moved.fields_->getLocalLength(), "{} nodes for {} unknowns",
                   old_nodes.size(), moved.fields_->getLocalLength());
  const auto from = u();
  auto to = moved.u();
  for (std::size_t node = 0; node < old_nodes.size(); ++node) {
    to.middleRows(static_cast<Eigen::Index>(node) * dim, dim) =
        from.middleRows(static_cast<Eigen::Index>(old_nodes[node]) * dim, dim);
  }
  return moved;
}

Eigen::Map<FarFields::Dense> FarFields::columns(MultiVector& vectors) const {
  return {vectors.getLocalViewHost(Tpetra::Access::ReadWrite).data(),
          static_cast<Eigen::Index>(vectors.getLocalLength()), size_};
}

std::vector<Teuchos::RCP<const FarFields::Vector>> FarFields::all() const {
  std::vector<Teuchos::RCP<const Vector>> all;
  for (int j = 0; j < size_; ++j) all.push_back(fields_->getVector(j));
  return all;
}

int FarFields::add(const Vector& field) {
  const int place = next_;
  next_ = (next_ + 1) % most_fields;
  size_ = std::min(size_ + 1, most_fields);
  this->field(place)->assign(field);
  return place;
}

void FarFields::multiply(int j) const {
  operator_->apply(*field(j), *product(j));
  scale(j);
}

void FarFields::multiply() const {
  for (int j = 0; j < size_; ++j) multiply(j);
}

void FarFields::scale(int j) const {
  const double energy = field(j)->dot(*product(j));
  const double factor = energy > 0. ? 1. / std::sqrt(energy) : 0.;
  field(j)->scale(factor);
  product(j)->scale(factor);
}

void FarFields::renew_energies() {
  energies_ = sum(u().transpose() * ku());
  invert();
}

void FarFields::take(const std::vector<operators::Window::Forces>& changes) {
  PERIMORPH_ASSERT(static_cast<int>(changes.size()) == size_, "{} changes of {} fields", changes.size(), size_);
  if (changes.empty()) return;
  const auto& dofs = changes.front().dofs;
  const auto n = static_cast<Eigen::Index>(dofs.size());
  Dense change(n, size_), here(n, size_);
  const auto u = this->u();
  auto ku = this->ku();
  for (int j = 0; j < size_; ++j) change.col(j) = Eigen::Map<const Eigen::VectorXd>(changes[j].values.data(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    here.row(i) = u.row(dofs[i]);
    ku.row(dofs[i]) += change.row(i);
  }
  if (energies_.rows() != size_) return renew_energies();
  energies_ += sum(here.transpose() * change);
  invert();
}

void FarFields::invert() {
  constexpr double smallest = 1e-8;  // eigenvalue, the fields being of unit energy
  const Dense symmetric = 0.5 * (energies_ + energies_.transpose());
  const Eigen::SelfAdjointEigenSolver<Dense> eigen(symmetric);
  const Eigen::VectorXd inverted =
      eigen.eigenvalues().unaryExpr([=](double value) { return value > smallest ? 1. / value : 0.; });
  inverse_ = eigen.eigenvectors() * inverted.asDiagonal() * eigen.eigenvectors().transpose();
}

FarFields::Dense FarFields::sum(const Dense& local) const {
  std::vector<double> values(local.data(), local.data() + local.size());
  base::sum(*comm_, values);
  return Eigen::Map<const Dense>(values.data(), local.rows(), local.cols());
}

}  // namespace perimorph::solvers
