#include "perimorph/mesh/fingerprint.hpp"

namespace perimorph::mesh {

namespace {

/// FNV-1a, 64 bits: xor a byte, multiply by a prime.
class Hash {
 public:
  void add(const void* data, std::size_t n_bytes) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < n_bytes; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3ULL;
  }
  template <class T>
  void add(const T& number) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    add(&number, sizeof number);
  }
  void add(const std::string& text) { add(text.c_str(), text.size() + 1); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

template <int dim>
std::uint64_t hash_of(const Mesh<dim>& mesh, int element) {
  Hash hash;
  hash.add(mesh.element_ids[element]);
  hash.add(mesh.types[element]);
  hash.add(mesh.blocks[element]);
  for (int c = 0; c < mesh.n_corners(element); ++c) {
    const int node = mesh.corners_of(element)[c];
    hash.add(mesh.node_ids[node]);
    hash.add(mesh.coordinates[node].data(), dim * sizeof(double));
  }
  return hash.value();
}

std::uint64_t hash_of(const std::string& name, GlobalId element, int corner_or_side) {
  Hash hash;
  hash.add(name);
  hash.add(element);
  hash.add(corner_or_side);
  return hash.value();
}

/// Of a rank's own elements: a sum, so that it does not matter which they are.
template <int dim>
std::uint64_t own_sum(const Mesh<dim>& part) {
  std::uint64_t sum = 0;
  for (int e = 0; e < part.n_owned_elements; ++e) sum += hash_of(part, e);
  for (const auto& [name, nodes] : part.node_sets) {
    std::vector<char> are_in(part.n_nodes(), 0);
    for (const int node : nodes) are_in[node] = 1;
    for (int e = 0; e < part.n_owned_elements; ++e) {
      for (int c = 0; c < part.n_corners(e); ++c) {
        if (are_in[part.corners_of(e)[c]] != 0) sum += hash_of(name, part.element_ids[e], c);
      }
    }
  }
  for (const auto& [name, sides] : part.side_sets) {
    for (const Side& side : sides) {
      if (side.element < part.n_owned_elements) sum += hash_of(name, part.element_ids[side.element], side.side);
    }
  }
  return sum;
}

}  // namespace

template <int dim>
GlobalId fingerprint(const base::Comm& comm, const Mesh<dim>& part) {
  const std::uint64_t sum = part.rank == comm.getRank() ? own_sum(part) : 0;
  Hash names;
  for (const auto& name : part.block_names) names.add(name);
  std::uint64_t all = names.value();
  for (const auto of_rank : base::gather_on_all<std::uint64_t>(comm, {sum})) all += of_rank;
  return static_cast<GlobalId>(all);
}

template GlobalId fingerprint<2>(const base::Comm&, const Mesh<2>&);
template GlobalId fingerprint<3>(const base::Comm&, const Mesh<3>&);

}  // namespace perimorph::mesh
