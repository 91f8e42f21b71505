#pragma once

#include <map>
#include <string>
#include <vector>

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::io {

/// The body in its current topology, as one Exodus file describes it. Lives on rank 0.
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
  std::vector<Block> blocks;                                 ///< none of them empty
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

/// How far a series is: files, and steps in the last one.
struct SeriesExtent {
  int files = 0, steps = 0;
};

/// A series of Exodus files: a new file at every change of topology, "case.e", "case.e-s0002", "case.e-s0003", ...
/// ParaView opens it as one. Every step is flushed, so that a file is readable whatever happens later. Local (rank 0).
template <int dim>
class ExodusSeries {
 public:
  struct Names {
    std::vector<std::string> globals, nodal, element;
  };

  /// @param file name of the first file, ".../case.e"
  /// @param information lines for the files' info records (the resolved case)
  ExodusSeries(std::string file, std::string title, Names names, std::vector<std::string> information);
  ~ExodusSeries();
  ExodusSeries(const ExodusSeries&) = delete;
  ExodusSeries& operator=(const ExodusSeries&) = delete;

  SeriesExtent extent() const { return {n_files_, n_steps_}; }

  /// Goes on with a series that an earlier run has left: what lies beyond the extent is removed, and start() begins the
  /// file after it.
  /// @throws UserError naming the file, if steps beyond the extent cannot be removed.
  void resume(const SeriesExtent& extent);

  /// Closes the current file, if any, and starts the next one with this model.
  /// @throws ComputationError naming the file, if it cannot be written.
  void start(const ExodusModel<dim>& model);

  /// Appends a step to the current file and flushes it.
  /// @throws ComputationError naming the file, if it cannot be written.
  void write(const ExodusStep& step);

 private:
  std::string file_, title_;
  Names names_;
  std::vector<std::string> information_;
  int exodus_id_ = -1;
  int n_files_ = 0, n_steps_ = 0;
  std::vector<int> block_sizes_, block_ids_;
  std::string current_file() const;
  void close();
  void check(int status, const char* what) const;
};

}  // namespace perimorph::io
