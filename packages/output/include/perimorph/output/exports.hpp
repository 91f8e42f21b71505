#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "perimorph/bonds/crack.hpp"
#include "perimorph/cases/case.hpp"
#include "perimorph/io/history.hpp"
#include "perimorph/output/probes.hpp"
#include "perimorph/output/results_state.hpp"

namespace perimorph::output {

/// What a run writes beside history.csv and the fields, if the case asks for it: probes.csv, crack.csv and
/// crack_path.csv, bonds-\<increment>.vtp. Rank 0 writes; the order of rows and bonds does not depend on the ranks.
template <int dim>
class Exports {
 public:
  /// Goes on with the files of an earlier run after that increment, if there is one. Collective.
  /// @throws UserError if they cannot be written, or the earlier ones are not there.
  Exports(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh, const cases::Case& input,
          const std::string& folder, int increment, const std::optional<ResultsState>& earlier);

  /// Records an increment. Collective.
  /// @throws ComputationError if a file cannot be written, or somebody has removed or changed it.
  void accept(int increment, const fracture::Body<dim>& body);

  /// Adds its files to those of a state. Local (rank 0).
  void note_files(ResultsState& state) const;

  /// Waits until the disk has all that was written. Local (rank 0). @throws ComputationError if it fails.
  void bring_to_disk();

 private:
  Teuchos::RCP<const base::Comm> comm_;
  std::string folder_;
  Probes<dim> probes_;
  double horizon_;
  std::vector<int> bond_increments_;
  std::unique_ptr<io::History> probe_table_, crack_table_, path_table_;  ///< on rank 0, if asked for
  std::vector<io::FileExtent> bond_files_;                               ///< on rank 0
  std::size_t n_bond_files_on_disk_ = 0;  ///< of them, that a power cut does not harm any more
  bool records_crack_;
  std::set<std::pair<base::GlobalId, base::GlobalId>> known_sides_;  ///< in the path table, by elements; on rank 0

  void open_tables(const std::optional<ResultsState>& earlier);
  std::vector<const io::History*> tables() const;
  void record_probes(int increment, const fracture::Body<dim>& body);
  void record_crack(int increment, const fracture::Body<dim>& body);
  void write_bonds(int increment, const fracture::Body<dim>& body);
};

}  // namespace perimorph::output
