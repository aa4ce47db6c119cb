// Four blocks at a time stay in registers while all maps go by. Where the compiler has no vector
// types or the processor is another, the plain loop does the same.
#include "map_union.hpp"

#include <cstring>

namespace handey::cspace {
namespace {

#if defined(__GNUC__)
typedef std::uint64_t Block __attribute__((vector_size(kMapBlock)));
#define HANDEY_INLINE inline __attribute__((always_inline))
#else
struct Block {
  std::uint64_t words[kMapBlock / 8];
  Block& operator|=(const Block& other) {
    for (std::size_t i = 0; i < kMapBlock / 8; ++i) words[i] |= other.words[i];
    return *this;
  }
};
#define HANDEY_INLINE inline
#endif

template <std::size_t blocks>
HANDEY_INLINE void unite_blocks(const std::uint8_t* const* maps, std::size_t count,
                                std::size_t offset, std::uint8_t* result) {
  Block sum[blocks];
  std::memcpy(sum, result + offset, sizeof(sum));
  for (std::size_t m = 0; m < count; ++m) {
    Block map[blocks];
    std::memcpy(map, maps[m] + offset, sizeof(map));
    for (std::size_t b = 0; b < blocks; ++b) sum[b] |= map[b];
  }
  std::memcpy(result + offset, sum, sizeof(sum));
}

HANDEY_INLINE void unite_all(const std::uint8_t* const* maps, std::size_t count, std::size_t bytes,
                             std::uint8_t* result) {
  const std::size_t all = (bytes + kMapBlock - 1) / kMapBlock;
  std::size_t done = 0;
  for (; done + 4 <= all; done += 4) unite_blocks<4>(maps, count, done * kMapBlock, result);
  switch (all - done) {
    case 3:
      return unite_blocks<3>(maps, count, done * kMapBlock, result);
    case 2:
      return unite_blocks<2>(maps, count, done * kMapBlock, result);
    case 1:
      return unite_blocks<1>(maps, count, done * kMapBlock, result);
    default:
      return;
  }
}

using Unite = void (*)(const std::uint8_t* const*, std::size_t, std::size_t, std::uint8_t*);

void unite_plain(const std::uint8_t* const* maps, std::size_t count, std::size_t bytes,
                 std::uint8_t* result) {
  unite_all(maps, count, bytes, result);
}

#if defined(__GNUC__) && defined(__x86_64__)
__attribute__((target("avx2"))) void unite_avx2(const std::uint8_t* const* maps, std::size_t count,
                                                std::size_t bytes, std::uint8_t* result) {
  unite_all(maps, count, bytes, result);
}
__attribute__((target("avx512f"))) void unite_avx512(const std::uint8_t* const* maps,
                                                     std::size_t count, std::size_t bytes,
                                                     std::uint8_t* result) {
  unite_all(maps, count, bytes, result);
}

Unite choose() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f")) return &unite_avx512;
  if (__builtin_cpu_supports("avx2")) return &unite_avx2;
  return &unite_plain;
}
#else
Unite choose() { return &unite_plain; }
#endif

}  // namespace

void unite(const std::uint8_t* const* maps, std::size_t count, std::size_t bytes,
           std::uint8_t* result) {
  static const Unite chosen = choose();
  chosen(maps, count, bytes, result);
}

}  // namespace handey::cspace
