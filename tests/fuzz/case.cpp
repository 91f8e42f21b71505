// Any bytes are a case or the user's mistake: no crash, no other exception, no huge allocation.

#include "perimorph/fracture/case.hpp"

#include <algorithm>

#include "input_file.hpp"
#include "perimorph/base/errors.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const perimorph::fuzz::InputFile input(".xml");
  const std::string& file = input.with(data, size);
  try {
    const auto result = perimorph::fracture::read_case(file);
    if (!(result.youngs_modulus > 0.) || result.increments < 1) std::abort();
  } catch (const perimorph::base::UserError& error) {
    const std::string message = error.what();
    const bool printable = std::none_of(message.begin(), message.end(),
                                        [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f; });
    if (message.find(file) == std::string::npos || !printable) std::abort();
  }
  return 0;
}
