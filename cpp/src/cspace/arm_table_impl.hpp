// An arm table from within.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "arm_links.hpp"
#include "handey/cspace/arm_table.hpp"
#include "ring_maps.hpp"
#include "wrist_columns.hpp"

namespace handey {

namespace cspace {

/// Of a content; 128 bits, so that two contents never share one by chance.
using ContentKey = std::array<std::uint64_t, 2>;

/// Of all of the robot that a table depends on: geometry, kinematics, limits.
ContentKey content_key(const Robot& robot);

/// The maps of a group of outlines in one lateral slab.
struct GroupMaps {
  Slab slab;
  RingMaps maps;
};

}  // namespace cspace

struct ArmTable::Impl {
  int level = 0;
  Lattice lattice;
  cspace::ArmLinks links;
  cspace::PolarGrid grid;
  cspace::ContentKey robot{}, key{};  ///< of the robot; of robot and options
  std::vector<cspace::GroupMaps> upper, lower, turning;
  cspace::WristColumns wrist;
  std::size_t row_bytes() const {
    return static_cast<std::size_t>(lattice.cells(level, 2) + 7) / 8;
  }
  std::vector<std::uint8_t> bytes;  ///< of all maps
};

namespace cspace {

/// Of the robot and the options, as the table has them.
ContentKey table_key(const ArmTable::Impl& table);

/// @param size of the table [bytes]
/// @return false if there is no file, or one that does not fit: then `bytes` is unchanged
bool read_table(const std::string& directory, const ContentKey& key, std::size_t size,
                std::vector<std::uint8_t>& bytes);
/// Written aside and renamed; a directory that cannot be written is no error.
void write_table(const std::string& directory, const ContentKey& key,
                 const std::vector<std::uint8_t>& bytes);

}  // namespace cspace
}  // namespace handey
