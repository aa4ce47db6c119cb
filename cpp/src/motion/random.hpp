// Uniform random numbers that are the same with every standard library: the generator's output is
// fixed by the C++ standard, std::uniform_real_distribution's is not.
#pragma once

#include <cstdint>
#include <random>

namespace handey::motion {

/// In [0, 1).
inline double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1.0p-53;
}

}  // namespace handey::motion
