#include "perimorph/io/bond_file.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "perimorph/base/errors.hpp"

namespace perimorph::io {

namespace {

/// The data that VTK's XML files keep behind their tags: each array after its size in bytes.
class Appended {
 public:
  /// Takes an array and returns its tag.
  template <class T>
  std::string array(const char* name, const char* type, int n_components, const std::vector<T>& values) {
    std::string tag = fmt::format(
        "<DataArray Name=\"{}\" type=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", name,
        type, n_components, bytes_.size());
    const std::uint64_t size = values.size() * sizeof(T);
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes_.append(reinterpret_cast<const char*>(values.data()), size);
    return tag;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// VTK's points and vectors always have three components.
template <int dim>
std::vector<double> in_space(const std::vector<base::Point<dim>>& points) {
  std::vector<double> values;
  values.reserve(3 * points.size());
  for (const auto& x : points) {
    for (int c = 0; c < 3; ++c) values.push_back(c < dim ? x[c] : 0.);
  }
  return values;
}

}  // namespace

template <int dim>
void write_bonds(const std::string& file, const BondModel<dim>& model) {
  PERIMORPH_ASSERT(
      model.point_ids.size() == model.positions.size() && model.displacements.size() == model.positions.size(),
      "{} ids, {} positions, {} displacements", model.point_ids.size(), model.positions.size(),
      model.displacements.size());
  PERIMORPH_ASSERT(model.ends.size() == 2 * model.stretch.size() && model.broken.size() == model.stretch.size(),
                   "{} ends, {} stretches, {} states", model.ends.size(), model.stretch.size(), model.broken.size());
  std::vector<long long> line_ends;  // of each line, in the list of ends
  for (std::size_t b = 0; b < model.stretch.size(); ++b) line_ends.push_back(2 * (static_cast<long long>(b) + 1));
  Appended data;
  std::string head = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfLines=\"{}\">\n",
      model.positions.size(), model.stretch.size());
  head += "<PointData>\n" + data.array("id", "Int64", 1, model.point_ids) +
          data.array("displacement", "Float64", 3, in_space(model.displacements)) + "</PointData>\n";
  head += "<CellData>\n" + data.array("stretch", "Float64", 1, model.stretch) +
          data.array("broken", "Int8", 1, model.broken) + "</CellData>\n";
  head += "<Points>\n" + data.array("points", "Float64", 3, in_space(model.positions)) + "</Points>\n";
  head += "<Lines>\n" + data.array("connectivity", "Int64", 1, model.ends) +
          data.array("offsets", "Int64", 1, line_ends) + "</Lines>\n";
  head += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  errno = 0;
  std::ofstream stream(file, std::ios::binary);
  stream << head << data.bytes() << "\n</AppendedData>\n</VTKFile>\n" << std::flush;
  if (!stream) {
    throw base::ComputationError(fmt::format("{}: the bonds cannot be written: {}", file, std::strerror(errno)));
  }
}

template void write_bonds<2>(const std::string&, const BondModel<2>&);
template void write_bonds<3>(const std::string&, const BondModel<3>&);

}  // namespace perimorph::io
