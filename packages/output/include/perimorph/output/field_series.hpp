#pragma once

#include <memory>

#include "perimorph/fracture/body.hpp"
#include "perimorph/io/disk.hpp"
#include "perimorph/io/exodus.hpp"

namespace perimorph::output {

/// What a side set of the mesh is called in the series: one may have the name of the surface of cracks, such as in a
/// mesh that is a result. Local.
std::string name_in_results(const std::string& side_set);

/// What a series of Exodus files is called and says about itself.
struct SeriesOptions {
  std::string file;  ///< the first one, ".../case.e"
  std::string title;
  std::vector<std::string> globals;      ///< names of global variables
  std::vector<std::string> information;  ///< lines for the info records
  bool is_spread = false;                ///< each rank writes its part, or rank 0 all
  bool has_eigenstrain = false;          ///< of a body whose temperature changes
};

/// The fields of a run: displacement, alpha, damage, class, energy, stress and eigenstrain; a new file whenever the
/// topology or the broken surface has changed.
template <int dim>
class FieldSeries {
 public:
  /// Goes on after an earlier series, of which those files are left; what is left of others is removed. Collective.
  /// @throws UserError if it cannot be continued.
  FieldSeries(const Teuchos::RCP<const base::Comm>& comm, SeriesOptions options, const io::SeriesExtent& earlier,
              std::vector<io::FileExtent> earlier_files);

  /// How far it has come; on ranks that write. Local.
  io::SeriesExtent extent() const { return series_ ? series_->extent() : io::SeriesExtent{}; }

  /// All files and how far each has come; on rank 0. Local.
  const std::vector<io::FileExtent>& files() const { return files_; }

  /// Waits until the disk has all that was written. Collective. @throws ComputationError if it fails.
  void bring_to_disk();

  /// Appends a step. Collective. @throws ComputationError if it cannot be written.
  /// @param globals values of the global variables
  void write(int increment, const fracture::Body<dim>& body, std::vector<double> globals);

 private:
  Teuchos::RCP<const base::Comm> comm_;
  bool is_spread_, has_eigenstrain_;
  std::vector<io::FileExtent> files_;                               ///< on rank 0
  std::size_t n_closed_files_;                                      ///< of them
  std::unique_ptr<io::ExodusSeries<dim>> series_;                   ///< on ranks that write
  base::GlobalId topology_written_ = 0, broken_sides_written_ = 0;  ///< 0: no file has been started
  std::vector<int> nodes_, element_place_;                          ///< of the file's layout

  void start_file(const fracture::Body<dim>& body, const std::vector<mesh::Side>& broken_surface);
  void note_sizes();
  std::vector<double> on_nodes(const fracture::Body<dim>& body, int component) const;
  std::vector<double> on_elements(const std::vector<double>& own) const;
};

}  // namespace perimorph::output
