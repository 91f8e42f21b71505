#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::io {

/// The body in its current topology, or one rank's part of it, as one Exodus file describes it.
template <int dim>
struct ExodusModel {
  struct Block {
    std::string name;  ///< for example "<block>_FE", "<block>_MORPH", "<block>_DGFE"
    mesh::ElementType type;
    std::vector<int> connectivity;            ///< 0-based nodes of this model, n_corners(type) an element
    std::vector<base::GlobalId> element_ids;  ///< global ids of the reference mesh, 0-based
    int id = 0;  ///< the same for a name in all files of a series, or ParaView reads it twice; 0: its place, from 1
  };
  std::vector<base::Point<dim>> coordinates;                 ///< of the current topology's nodes, [length]
  std::vector<base::GlobalId> node_ids;                      ///< of the body's nodes, 0-based; {} if all are here
  std::vector<Block> blocks;                                 ///< only those of a part may be empty
  std::map<std::string, std::vector<int>> node_sets;         ///< 0-based nodes of this model
  std::map<std::string, std::vector<mesh::Side>> side_sets;  ///< element: position in the concatenated blocks, 0-based
};

/// Values of one step, in the order of the model's nodes and of its concatenated blocks' elements.
struct ExodusStep {
  double time = 0.;
  std::vector<double> globals;               ///< one per global name
  std::vector<std::vector<double>> nodal;    ///< [variable][node]
  std::vector<std::vector<double>> element;  ///< [variable][element]
};

/// Whose part of the body a series of spread files holds: "case.e.<ranks>.<rank>".
struct SpreadPart {
  int rank, n_ranks;
};

/// How far a series is: files, and steps in the last one.
struct SeriesExtent {
  int files = 0, steps = 0;
};

/// A series of Exodus files: a new file at every change of topology, "case.e", "case.e-s0002", "case.e-s0003", ... or
/// in its place one spread file of each rank, "case.e.4.0" to "case.e.4.3". ParaView opens all as one. Every step is
/// flushed, so that a file is readable whatever happens later. Local: on rank 0, or each rank its part.
template <int dim>
class ExodusSeries {
 public:
  struct Names {
    std::vector<std::string> globals, nodal, element;
  };

  /// @param file name of the first file, ".../case.e"
  /// @param information lines for the files' info records (the resolved case)
  /// @param part this rank's part of spread files, or none: the body is whole
  ExodusSeries(std::string file, std::string title, Names names, std::vector<std::string> information,
               std::optional<SpreadPart> part = {});
  ~ExodusSeries();
  ExodusSeries(const ExodusSeries&) = delete;
  ExodusSeries& operator=(const ExodusSeries&) = delete;

  SeriesExtent extent() const { return {n_files_, n_steps_}; }

  /// The name of one of its files, from 1; of spread files that rank's.
  std::string file(int number, int rank) const;

  /// Of the file that is being written, or of this rank's part, [bytes].
  /// @throws ComputationError if it is gone.
  base::GlobalId current_size() const;

  /// Goes on with a series that an earlier run has left: start() begins the file after this extent.
  void resume(const SeriesExtent& extent);

  /// What lies beyond the extent so far, also in spread files of any number of ranks, is removed; before anything has
  /// been written, all that an older series has left. On rank 0, before any rank goes on.
  /// @throws UserError naming the file, if steps beyond the extent cannot be removed.
  void remove_the_rest() const;

  /// Waits until the disk has all that was written. @throws ComputationError naming the file, if it fails.
  void bring_to_disk();

  /// Closes the current file, if any, and starts the next one with this model.
  /// @throws ComputationError naming the file, if it cannot be written.
  void start(const ExodusModel<dim>& model);

  /// Appends a step to the current file and flushes it.
  /// @throws ComputationError naming the file, if it cannot be written.
  void write(const ExodusStep& step);

 private:
  std::string file_, title_;
  std::optional<SpreadPart> part_;
  Names names_;
  std::vector<std::string> information_;
  int exodus_id_ = -1;
  int n_files_ = 0, n_steps_ = 0;
  int n_on_disk_ = 0;  ///< files to which nothing is added, and that a power cut does not harm any more
  std::vector<int> block_sizes_, block_ids_;
  std::string own_file(int number) const;
  void close();
  void check(int status, const char* what) const;
};

}  // namespace perimorph::io
