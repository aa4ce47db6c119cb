// The union of bit maps, where the time of a slice goes. Widest registers of the processor, chosen
// when first used.
#pragma once

#include <cstddef>
#include <cstdint>

namespace handey::cspace {

/// Maps are read, and results written, in blocks of this many bytes: both need room up to the next
/// multiple.
constexpr std::size_t kMapBlock = 64;

/// Ors `bytes` (rounded up to blocks) of each of the maps into `result`.
void unite(const std::uint8_t* const* maps, std::size_t count, std::size_t bytes,
           std::uint8_t* result);

}  // namespace handey::cspace
