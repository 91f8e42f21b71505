#include "packed_mesh.hpp"

#include <cstring>
#include <type_traits>

#include "perimorph/base/errors.hpp"

namespace perimorph::mesh {

namespace {

/// Number of words that so many items fill.
template <class T>
std::size_t n_words(std::size_t n_items) {
  return (n_items * sizeof(T) + sizeof(PackedWord) - 1) / sizeof(PackedWord);
}

/// Writes whatever is visited to the end of a message.
class Packer {
 public:
  template <class T>
  std::enable_if_t<std::is_arithmetic_v<T>> operator()(const T& value) {
    items(&value, 1);
  }
  template <class List>
  std::enable_if_t<!std::is_arithmetic_v<List>> operator()(const List& list) {
    (*this)(list.size());
    items(list.data(), list.size());
  }
  void operator()(const std::vector<std::string>& texts) {
    (*this)(texts.size());
    for (const auto& text : texts) (*this)(text);
  }
  template <class T>
  void operator()(const std::map<std::string, T>& sets) {
    (*this)(sets.size());
    for (const auto& [name, set] : sets) {
      (*this)(name);
      (*this)(set);
    }
  }

  std::vector<PackedWord> words;

 private:
  template <class T>
  void items(const T* first, std::size_t n) {
    const std::size_t begin = words.size();
    words.resize(begin + n_words<T>(n));
    if (n > 0) std::memcpy(words.data() + begin, static_cast<const void*>(first), n * sizeof(T));
  }
};

/// Reads whatever is visited from a message, in the order in which it was written.
class Unpacker {
 public:
  explicit Unpacker(const std::vector<PackedWord>& words) : words_(words) {}
  std::size_t n_left() const { return words_.size() - position_; }

  template <class T>
  std::enable_if_t<std::is_arithmetic_v<T>> operator()(T& value) {
    items(&value, 1);
  }
  template <class List>
  std::enable_if_t<!std::is_arithmetic_v<List>> operator()(List& list) {
    list.resize(size());
    items(list.data(), list.size());
  }
  void operator()(std::vector<std::string>& texts) {
    texts.resize(size());
    for (auto& text : texts) (*this)(text);
  }
  template <class T>
  void operator()(std::map<std::string, T>& sets) {
    for (std::size_t n = size(); n > 0; --n) {
      std::string name;
      (*this)(name);
      (*this)(sets[name]);
    }
  }

 private:
  std::size_t size() {
    std::size_t n = 0;
    items(&n, 1);
    return n;
  }

  template <class T>
  void items(T* first, std::size_t n) {
    const std::size_t end = position_ + n_words<T>(n);
    PERIMORPH_ASSERT(end <= words_.size(), "word {} of a message of {}", end, words_.size());
    if (n > 0) std::memcpy(static_cast<void*>(first), words_.data() + position_, n * sizeof(T));
    position_ = end;
  }

  const std::vector<PackedWord>& words_;
  std::size_t position_ = 0;
};

/// Everything that a mesh holds, in the order of a message.
template <class AnyMesh, class Visitor>
void visit(AnyMesh& mesh, Visitor& visitor) {
  visitor(mesh.coordinates);
  visitor(mesh.node_ids);
  visitor(mesh.node_owners);
  visitor(mesh.types);
  visitor(mesh.blocks);
  visitor(mesh.element_ids);
  visitor(mesh.element_owners);
  visitor(mesh.first_corner);
  visitor(mesh.corners);
  visitor(mesh.block_names);
  visitor(mesh.node_sets);
  visitor(mesh.side_sets);
  visitor(mesh.boundary);
  visitor(mesh.hanging_nodes);
  visitor(mesh.rank);
  visitor(mesh.n_owned_nodes);
  visitor(mesh.n_owned_elements);
  visitor(mesh.n_global_nodes);
  visitor(mesh.n_global_elements);
}

}  // namespace

template <int dim>
std::vector<PackedWord> pack(const Mesh<dim>& mesh) {
  Packer packer;
  visit(mesh, packer);
  return std::move(packer.words);
}

template <int dim>
Mesh<dim> unpack(const std::vector<PackedWord>& words) {
  Mesh<dim> mesh;
  Unpacker unpacker(words);
  visit(mesh, unpacker);
  PERIMORPH_ASSERT(unpacker.n_left() == 0, "{} words of {} are left", unpacker.n_left(), words.size());
  return mesh;
}

template std::vector<PackedWord> pack(const Mesh<2>&);
template std::vector<PackedWord> pack(const Mesh<3>&);
template Mesh<2> unpack<2>(const std::vector<PackedWord>&);
template Mesh<3> unpack<3>(const std::vector<PackedWord>&);

}  // namespace perimorph::mesh
