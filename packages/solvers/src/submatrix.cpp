#include "submatrix.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "perimorph/base/errors.hpp"

namespace perimorph::solvers {

using Map = Tpetra::Map<>;

Submatrix::Submatrix(const Teuchos::RCP<const Matrix>& whole, const std::vector<int>& rows,
                     const Teuchos::RCP<const Map>& unknowns)
    : whole_(whole), place_of_(whole->getNodeNumRows(), -1), first_{0} {
  PERIMORPH_ASSERT(unknowns->getNodeNumElements() == rows.size(), "{} rows, {} unknowns", rows.size(),
                   unknowns->getNodeNumElements());
  for (std::size_t i = 0; i < rows.size(); ++i) place_of_[rows[i]] = static_cast<int>(i);
  std::vector<base::GlobalId> numbers;
  const auto column_of = number_columns(rows, unknowns, numbers);
  const auto local = whole->getLocalMatrixHost();
  std::vector<int> columns;
  std::vector<std::pair<int, std::size_t>> entries;  // of a row: column, and where it is
  for (const int row : rows) {
    entries.clear();
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
      if (const int column = column_of[local.graph.entries(k)]; column >= 0) entries.emplace_back(column, k);
    }
    std::sort(entries.begin(), entries.end());
    for (const auto& [column, k] : entries) {
      columns.push_back(column);
      source_.push_back(k);
    }
    first_.push_back(source_.size());
  }
  using Local = Matrix::local_matrix_device_type;
  typename Local::row_map_type::non_const_type row_starts("row starts", first_.size());
  typename Local::index_type indices("columns", columns.size());
  std::copy(first_.begin(), first_.end(), row_starts.data());
  std::copy(columns.begin(), columns.end(), indices.data());
  const auto column_map =
      Teuchos::rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                           Teuchos::ArrayView<const base::GlobalId>(numbers.data(), static_cast<int>(numbers.size())),
                           0, unknowns->getComm()));
  matrix_ = Teuchos::rcp(
      new Matrix(unknowns, column_map, row_starts, indices, typename Local::values_type("values", source_.size())));
  matrix_->expertStaticFillComplete(unknowns, unknowns);
  for (std::size_t row = 0; row < rows.size(); ++row) refresh(static_cast<int>(row));
}

/// By column of the whole matrix; -1: not in this one.
/// @param columns their global numbers, own ones first
std::vector<int> Submatrix::number_columns(const std::vector<int>& rows, const Teuchos::RCP<const Map>& unknowns,
                                           std::vector<base::GlobalId>& columns) const {
  Tpetra::Vector<base::GlobalId> owned(whole_->getDomainMap()), all(whole_->getColMap());
  owned.putScalar(-1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    columns.push_back(unknowns->getGlobalElement(static_cast<int>(i)));
    owned.replaceLocalValue(rows[i], columns.back());
  }
  if (const auto importer = whole_->getGraph()->getImporter(); !importer.is_null()) {
    all.doImport(owned, *importer, Tpetra::INSERT);
  } else {
    all.update(1, owned, 0);
  }
  const auto numbers = all.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<int> column_of(numbers.extent(0), -1);
  for (std::size_t c = 0; c < column_of.size(); ++c) {
    if (numbers(c, 0) < 0) continue;
    column_of[c] = unknowns->getLocalElement(numbers(c, 0));
    if (column_of[c] >= 0) continue;
    column_of[c] = static_cast<int>(columns.size());
    columns.push_back(numbers(c, 0));
  }
  return column_of;
}

void Submatrix::refresh(int row) {
  const auto from = whole_->getLocalMatrixHost().values;
  const auto to = matrix_->getLocalMatrixHost().values;
  for (std::size_t k = first_[row]; k < first_[row + 1]; ++k) to(k) = from(source_[k]);
}

}  // namespace perimorph::solvers
