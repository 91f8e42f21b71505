#pragma once

#include <string>
#include <vector>

#include "perimorph/base/algebra.hpp"

// Where the values of data sets stand in a file of HDF5. The library makes and reads the structure of the file; values
// are written and read past it, by each rank its own: it has trouble with disks that fill up, and with ranks of which
// only some fail.

namespace perimorph::io {

/// One data set whose values stand together in a file.
struct DataSet {
  enum class Kind : base::GlobalId { numbers, integers, text };

  std::string name;
  Kind kind = Kind::numbers;
  bool is_in_rows = false;    ///< has two dimensions in the file; otherwise one
  base::GlobalId n_rows = 0;  ///< or values
  base::GlobalId width = 1;   ///< values in a row
  base::GlobalId offset = 0;  ///< of its first value in the file, [bytes]

  base::GlobalId row_bytes() const { return width * (kind == Kind::text ? 1 : 8); }
  base::GlobalId bytes() const { return n_rows * row_bytes(); }
};

/// A stretch of a file.
struct Stretch {
  base::GlobalId offset;  ///< [bytes]
  std::string content;
};

/// A file of HDF5 without the values of its data sets.
struct Structure {
  std::vector<DataSet> sets;       ///< with their offsets
  base::GlobalId size = 0;         ///< of the whole file, [bytes]
  std::vector<Stretch> stretches;  ///< all that is not values
};

/// The structure that these data sets need: the same whenever they are the same. Takes no memory for values. Local.
Structure lay_out(std::vector<DataSet> sets);

/// The data sets of a file. Local. @throws Bug if it is not one of HDF5, or not such as lay_out() makes.
std::vector<DataSet> data_sets_of(const std::string& name);

}  // namespace perimorph::io
