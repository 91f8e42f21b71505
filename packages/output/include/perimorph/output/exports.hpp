#pragma once

#include <memory>
#include <set>
#include <string>

#include "perimorph/bonds/crack.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/io/history.hpp"
#include "perimorph/output/probes.hpp"

namespace perimorph::output {

/// What a run writes beside history.csv and the fields, if the case asks for it: probes.csv, crack.csv and
/// crack_path.csv, bonds-\<increment>.vtp. Rank 0 writes; the order of rows and bonds does not depend on the ranks.
template <int dim>
class Exports {
 public:
  /// Goes on with the tables of an earlier run after that increment, if it is not 0. Collective.
  /// @throws UserError if they cannot be written, or the earlier ones are not there.
  Exports(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh, const cases::Case& input,
          const std::string& folder, int increment);

  /// Records an increment. Collective. @throws ComputationError if a file cannot be written.
  void accept(int increment, const fracture::Body<dim>& body);

 private:
  Teuchos::RCP<const base::Comm> comm_;
  std::string folder_;
  Probes<dim> probes_;
  double horizon_;
  std::vector<int> bond_increments_;
  std::unique_ptr<io::History> probe_table_, crack_table_, path_table_;  ///< on rank 0, if asked for
  bool records_crack_;
  std::set<std::pair<base::GlobalId, base::GlobalId>> known_sides_;  ///< in the path table, by elements; on rank 0

  void open_tables(int increment);
  void record_probes(int increment, const fracture::Body<dim>& body);
  void record_crack(int increment, const fracture::Body<dim>& body);
  void write_bonds(int increment, const fracture::Body<dim>& body) const;
};

}  // namespace perimorph::output
