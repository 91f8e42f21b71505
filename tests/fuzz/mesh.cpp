// Any bytes are a mesh or the user's mistake: no crash, no other exception, no huge allocation.

#include <algorithm>

#include "input_file.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/mesh_files/read_mesh.hpp"

namespace {

template <int dim>
void read(const std::string& file) {
  try {
    const auto mesh = perimorph::mesh_files::read_mesh<dim>(file);
    if (mesh.n_elements() == 0 || mesh.boundary.empty()) std::abort();
  } catch (const perimorph::base::UserError& error) {
    // The message names the file, and nothing in it can play with a terminal.
    const std::string message = error.what();
    const bool printable = std::none_of(message.begin(), message.end(),
                                        [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f; });
    if (message.rfind(file, 0) != 0 || !printable) std::abort();
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): by this name it is called
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const perimorph::fuzz::InputFile input(FUZZED_ENDING);
  const std::string& file = input.with(data, size);
  read<2>(file);
  read<3>(file);
  return 0;
}
