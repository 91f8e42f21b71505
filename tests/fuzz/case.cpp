// Any bytes are a case or the user's mistake: no crash, no other exception, no huge allocation.

#include "perimorph/cases/case.hpp"

#include <Kokkos_Core.hpp>
#include <algorithm>

#include "input_file.hpp"
#include "perimorph/base/errors.hpp"

namespace {

/// The file with the bytes, and beside it "plate.msh", a square with the groups left, right and top, and "pull.csv".
class CaseFile : public perimorph::fuzz::InputFile {
 public:
  CaseFile() : InputFile(".xml") {
    std::ofstream(folder() / "plate.msh")
        << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
           "$PhysicalNames\n4\n1 1 \"left\"\n1 2 \"right\"\n1 3 \"top\"\n2 4 \"body\"\n$EndPhysicalNames\n"
           "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
           "$Elements\n4\n1 1 2 1 1 1 4\n2 1 2 2 2 2 3\n3 1 2 3 3 3 4\n4 3 2 4 4 1 2 3 4\n$EndElements\n";
    std::ofstream(folder() / "pull.csv") << "time, value\n0, 0\n1, 2\n3, 1\n";
  }
};

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): by this name it is called
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Kokkos::ScopeGuard kokkos;
  static const CaseFile input;
  const std::string& file = input.with(data, size);
  try {
    const auto result = perimorph::cases::read_case(file);
    if (!(result.material.youngs_modulus > 0.) || result.loading.increments < 1) std::abort();
  } catch (const perimorph::base::UserError& error) {
    const std::string message = error.what();
    const bool printable = std::none_of(message.begin(), message.end(),
                                        [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f; });
    if (message.find(file) == std::string::npos || !printable) std::abort();
  }
  return 0;
}
