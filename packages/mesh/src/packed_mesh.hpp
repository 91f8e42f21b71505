#pragma once

#include <cstdint>
#include <vector>

#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh {

/// Messages are counted in ints: words of eight bytes allow messages of 16 GB.
using PackedWord = std::uint64_t;

/// A mesh as one message to another rank of the same machine type.
template <int dim>
std::vector<PackedWord> pack(const Mesh<dim>& mesh);

/// The mesh that pack() made a message of.
/// @throws Bug if the message is shorter or longer than its own counts say
template <int dim>
Mesh<dim> unpack(const std::vector<PackedWord>& words);

}  // namespace perimorph::mesh
