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
  void add(const std::vector<T>& values) {
    const std::size_t size = values.size();
    add(&size, sizeof size);
    add(values.data(), size * sizeof(T));
  }
  void add(const std::string& text) { add(text.c_str(), text.size() + 1); }
  GlobalId value() const { return static_cast<GlobalId>(value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace

template <int dim>
GlobalId fingerprint(const Mesh<dim>& whole) {
  PERIMORPH_ASSERT(whole.is_whole(), "{} of {} elements are here", whole.n_elements(), whole.n_global_elements);
  Hash hash;
  for (const auto& x : whole.coordinates) hash.add(x.data(), dim * sizeof(double));
  hash.add(whole.types);
  hash.add(whole.corners);
  hash.add(whole.blocks);
  for (const auto& name : whole.block_names) hash.add(name);
  for (const auto& [name, nodes] : whole.node_sets) {
    hash.add(name);
    hash.add(nodes);
  }
  for (const auto& [name, sides] : whole.side_sets) {
    hash.add(name);
    hash.add(sides);
  }
  return hash.value();
}

template GlobalId fingerprint<2>(const Mesh<2>&);
template GlobalId fingerprint<3>(const Mesh<3>&);

}  // namespace perimorph::mesh
