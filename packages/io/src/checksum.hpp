#pragma once

#include <zlib.h>

#include <cstdint>
#include <string_view>

#include "perimorph/base/algebra.hpp"

namespace perimorph::io {

/// CRC-32: sees every flipped bit, and every change within 32 bits.
using Checksum = std::uint32_t;

/// The checksum of some bytes that follow others, whose checksum is known.
inline Checksum checksum_of(std::string_view bytes, Checksum before = 0) {
  return static_cast<Checksum>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// The checksum of some bytes that follow others, from those of both.
inline Checksum joined(Checksum before, Checksum after, base::GlobalId size_after) {
  return static_cast<Checksum>(crc32_combine(before, after, size_after));
}

}  // namespace perimorph::io
