// A layer of the waist angle is the union of the maps of all that stands, each in its cross section
// at that angle. What does not depend on the waist is done once: the body of joint 1 against what
// is beyond the elbow, the upper arm against the hand, the hand against the forearm and itself.
//
// Meshes that are not convex are given by patches of their surface, which say nothing of what is
// inside. That is enough: in a free cell no link crosses a surface, so all the links lie on one
// side of it as long as each reaches the next; on which side is asked once, of the exact engine, at
// one configuration in a free cell: the body of joint 1 keeps a point on the waist's axis, so the
// answer is the same for all cells.
#include "handey/cspace/slice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "folded_arm.hpp"
#include "handey/errors.hpp"
#include "handey/stop.hpp"
#include "map_union.hpp"
#include "slice_layer.hpp"

namespace handey {

using cspace::ArmLinks;
using cspace::LayerMaps;
using cspace::LayerWork;
using cspace::SliceScene;
using cspace::Standing;
using cspace::Target;
using Eigen::Vector2d;

namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;

void require_valid(const Robot& robot, const ArmTable* table, const WristRange& wrist,
                   double opening, const SliceOptions& options) {
  if (table == nullptr) throw InvalidInput("E_REF", "table", "is null");
  if (table->impl().robot != cspace::content_key(robot)) {
    throw InvalidInput("E_REF", "table", "was made for another robot");
  }
  const Eigen::Index count = static_cast<Eigen::Index>(robot.joints.size()) - 3;
  if (wrist.lower.size() != count || wrist.upper.size() != count) {
    throw InvalidInput("E_DOF", "wrist",
                       "found " + std::to_string(wrist.lower.size()) + " and " +
                           std::to_string(wrist.upper.size()) + " values, expected " +
                           std::to_string(count));
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    if (std::isfinite(wrist.lower(i)) && std::isfinite(wrist.upper(i)) &&
        wrist.lower(i) <= wrist.upper(i)) {
      continue;
    }
    throw InvalidInput("E_RANGE", "wrist." + std::to_string(i),
                       "found " + std::to_string(wrist.lower(i)) + " to " +
                           std::to_string(wrist.upper(i)) + ", expected lower <= upper [rad]");
  }
  const Gripper& gripper = robot.gripper;
  if (!(opening >= gripper.min_opening - 1e-9 && opening <= gripper.max_opening + 1e-9)) {
    throw InvalidInput("E_RANGE", "opening",
                       "found " + std::to_string(opening) + ", expected " +
                           std::to_string(gripper.min_opening) + " to " +
                           std::to_string(gripper.max_opening) + " [m]");
  }
  if (!(options.clearance >= 0.0 && options.clearance <= 1.0)) {
    throw InvalidInput("E_RANGE", "clearance",
                       "found " + std::to_string(options.clearance) + ", expected 0 to 1 [m]");
  }
}

/// What an obstacle blocks at all waist angles between two.
struct TorusMaps {
  double lower = 0.0, upper = 0.0;
  LayerMaps maps;

  bool meets(double from, double to) const {
    // By the first turn of it that does not end before the cell begins.
    return lower + kTurn * std::ceil((from - upper) / kTurn) <= to;
  }
};

}  // namespace

struct Slice::Impl {
  CollisionChecker& checker;
  std::shared_ptr<const ArmTable> owner;
  const ArmTable::Impl& table;
  SliceOptions options;
  Configuration middle;  ///< of the wrist range; the first three joints are any
  SliceScene scene;
  LayerWork work;
  std::string reason;
  int words = 0;
  std::vector<std::vector<std::uint64_t>> layers;
  int built = 0;
  bool inside_asked = false;
  std::vector<std::uint8_t> whatever_waist;  ///< rows of theta3 blocked at every waist angle
  std::vector<std::uint8_t> upper_bytes, lower_bytes;
  std::vector<std::uint64_t> wrist_columns;  ///< cells of theta2 by cell of theta3
  std::optional<std::vector<TorusMaps>> tori;
  LayerMaps maps;

  Impl(CollisionChecker& checker_in, std::shared_ptr<const ArmTable> table_in,
       const WristRange& wrist, double opening, const SliceOptions& options_in)
      : checker(checker_in),
        owner(std::move(table_in)),
        table(owner->impl()),
        options(options_in),
        scene(cspace::make_slice_scene(checker, table, wrist.lower, wrist.upper, opening,
                                       options.clearance)),
        work(table, scene, options.clearance) {}

  int rows() const { return table.grid.row_count; }
  int columns() const { return table.lattice.cells(table.level, 2); }
  std::size_t row_bytes() const { return table.row_bytes(); }
  std::size_t lower_size() const { return static_cast<std::size_t>(rows()) * row_bytes(); }

  void ask_hand(const WristRange& wrist, double opening);
  void block_whatever_waist();
  void unite_lower(std::vector<std::uint8_t>& bytes);
  void make_tori();
  void build(int layer);
  void write(std::vector<std::uint64_t>& layer) const;
  void ask_inside(int waist);
};

void Slice::Impl::ask_hand(const WristRange& wrist, double opening) {
  middle = {Eigen::VectorXd::Zero(wrist.lower.size() + 3), opening};
  middle.q.tail(wrist.lower.size()) = 0.5 * (wrist.lower + wrist.upper);
  if (!scene.hand_keeps_clear) {
    reason =
        "the hand is not proved to keep clear of the forearm and of itself over the wrist's range";
  }
}

void Slice::Impl::block_whatever_waist() {
  const std::size_t block = cspace::kMapBlock;
  whatever_waist.assign(lower_size() + block, 0);
  upper_bytes.assign(static_cast<std::size_t>(rows()) + block, 0);
  WaistCell cell(table.links.plane, 0.0, 0.0);
  maps.clear(scene.balls.size());
  const Pose X_ER = table.links.plane.X_RE(0.0).inverse();
  for (const Standing& standing : scene.waist) work.add_at(standing, X_ER, 0.0, cell, maps);
  unite_lower(whatever_waist);
  for (const int column : cspace::folded_columns(table, scene, work)) {
    const std::uint8_t bit = static_cast<std::uint8_t>(1U << (column % 8));
    std::uint8_t* byte = whatever_waist.data() + column / 8;
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows()); ++row) {
      byte[row * row_bytes()] |= bit;
    }
  }
}

/// Adds what the collected maps of the lower link and spans of the wrist block.
void Slice::Impl::unite_lower(std::vector<std::uint8_t>& bytes) {
  cspace::unite(maps.lower.data(), maps.lower.size(), lower_size(), bytes.data());
  const std::size_t height = static_cast<std::size_t>(table.wrist.words());
  wrist_columns.assign(static_cast<std::size_t>(columns()) * height, 0);
  for (std::size_t ball = 0; ball < scene.balls.size(); ++ball) {
    for (const cspace::RingSpan& span : maps.hand[ball]) {
      scene.balls[ball].columns.mark(table.grid, span, wrist_columns);
    }
  }
  for (std::size_t column = 0; column < static_cast<std::size_t>(columns()); ++column) {
    const std::uint8_t bit = static_cast<std::uint8_t>(1U << (column % 8));
    std::uint8_t* byte = bytes.data() + column / 8;
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows()); ++row) {
      const std::uint64_t word = wrist_columns[column * height + row / 64];
      if ((word >> (row % 64)) & 1U) byte[row * row_bytes()] |= bit;
    }
  }
}

void Slice::Impl::make_tori() {
  std::vector<TorusMaps> all;
  for (const Standing& standing : scene.standing) {
    throw_if_stopped();
    for (const Target& target : work.targets_of(standing.concerns)) {
      for (const Torus& torus : torus_of(table.links.plane, standing.hull, target.slab)) {
        TorusMaps made{torus.lower, torus.upper, {}};
        made.maps.clear(scene.balls.size());
        work.add(target, torus.section, made.maps);
        all.push_back(std::move(made));
      }
    }
  }
  tori = std::move(all);
}

void Slice::Impl::build(int waist) {
  const double half = 0.5 * table.lattice.cell_width(table.level, 0);
  const double q1 = table.lattice.centre(table.level, 0, waist);
  std::vector<std::uint64_t>& layer = layers[static_cast<std::size_t>(waist)];
  layer.assign(static_cast<std::size_t>(rows() * words), ~std::uint64_t{0});
  ++built;
  if (!reason.empty()) return;
  maps.clear(scene.balls.size());
  if (options.mode == SliceMode::Cells) {
    WaistCell cell(table.links.plane, q1, half);
    const Pose X_ER = table.links.plane.X_RE(q1).inverse();
    for (const Standing& standing : scene.standing) work.add_at(standing, X_ER, half, cell, maps);
  } else {
    if (!tori) make_tori();
    for (const TorusMaps& torus : *tori) {
      if (!torus.meets(q1 - half, q1 + half)) continue;
      maps.all_blocked = maps.all_blocked || torus.maps.all_blocked;
      maps.upper.insert(maps.upper.end(), torus.maps.upper.begin(), torus.maps.upper.end());
      maps.lower.insert(maps.lower.end(), torus.maps.lower.begin(), torus.maps.lower.end());
      for (std::size_t ball = 0; ball < maps.hand.size(); ++ball) {
        const std::vector<cspace::RingSpan>& spans = torus.maps.hand[ball];
        maps.hand[ball].insert(maps.hand[ball].end(), spans.begin(), spans.end());
      }
    }
  }
  if (maps.all_blocked) return;
  lower_bytes = whatever_waist;
  std::fill(upper_bytes.begin(), upper_bytes.end(), std::uint8_t{0});
  cspace::unite(maps.upper.data(), maps.upper.size(), static_cast<std::size_t>(rows()),
                upper_bytes.data());
  unite_lower(lower_bytes);
  write(layer);
  if (!inside_asked) ask_inside(waist);
}

void Slice::Impl::write(std::vector<std::uint64_t>& layer) const {
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows()); ++row) {
    if (upper_bytes[row] != 0) continue;
    std::uint64_t* out = layer.data() + row * static_cast<std::size_t>(words);
    const std::uint8_t* in = lower_bytes.data() + row * row_bytes();
    for (std::size_t byte = 0; byte < row_bytes(); ++byte) {
      // Cells past the last one stay blocked.
      const int past = static_cast<int>(8 * (byte + 1)) - columns();
      const unsigned beyond = past > 0 ? (0xff00U >> past) & 0xffU : 0U;
      const std::uint64_t free = ~(in[byte] | beyond) & 0xffU;
      out[byte / 8] &= ~(free << (8 * (byte % 8)));
    }
  }
}

/// Once, at the first free cell: are the links outside of all that stands?
void Slice::Impl::ask_inside(int waist) {
  std::vector<std::uint64_t>& layer = layers[static_cast<std::size_t>(waist)];
  for (int row = 0; row < rows(); ++row) {
    for (int column = 0; column < columns(); ++column) {
      const std::uint64_t word = layer[static_cast<std::size_t>(row * words + column / 64)];
      if ((word >> (column % 64)) & 1U) continue;
      middle.q(0) = table.lattice.centre(table.level, 0, waist);
      middle.q(1) = table.lattice.centre(table.level, 1, row);
      middle.q(2) = table.lattice.centre(table.level, 2, column);
      const std::optional<Hit> hit = checker.find_hit(middle, 0.0);
      inside_asked = true;
      if (!hit) return;
      reason = "'" + hit->a + "' is inside '" + hit->b + "'";
      for (std::vector<std::uint64_t>& each : layers) {
        std::fill(each.begin(), each.end(), ~std::uint64_t{0});
      }
      return;
    }
  }
}

Slice::Slice(CollisionChecker& checker, std::shared_ptr<const ArmTable> table,
             const WristRange& wrist, double opening, const SliceOptions& options) {
  require_valid(*checker.cell().robot, table.get(), wrist, opening, options);
  impl_ = std::make_unique<Impl>(checker, std::move(table), wrist, opening, options);
  impl_->words = (impl_->columns() + 63) / 64;
  impl_->layers.resize(static_cast<std::size_t>(lattice().cells(level(), 0)));
  impl_->ask_hand(wrist, opening);
  impl_->block_whatever_waist();
}
Slice::~Slice() = default;
Slice::Slice(Slice&&) noexcept = default;

const Lattice& Slice::lattice() const { return impl_->table.lattice; }
int Slice::level() const { return impl_->table.level; }
const std::string& Slice::reason() const { return impl_->reason; }
int Slice::words_per_row() const { return impl_->words; }
int Slice::layers_built() const { return impl_->built; }

const std::vector<std::uint64_t>& Slice::blocked(int waist_cell) {
  if (waist_cell < 0 || waist_cell >= static_cast<int>(impl_->layers.size())) {
    throw InvalidInput("E_INDEX", "waist_cell",
                       "found " + std::to_string(waist_cell) + ", expected 0 to " +
                           std::to_string(impl_->layers.size() - 1));
  }
  std::vector<std::uint64_t>& layer = impl_->layers[static_cast<std::size_t>(waist_cell)];
  if (layer.empty()) {
    try {
      impl_->build(waist_cell);
    } catch (...) {  // stopped: the next to ask builds it again
      layer.clear();
      throw;
    }
  }
  return layer;
}

bool Slice::is_free(const CellIndex& cell) {
  const std::vector<std::uint64_t>& layer = blocked(cell[0]);
  const int word = cell[1] * impl_->words + cell[2] / 64;
  return ((layer[static_cast<std::size_t>(word)] >> (cell[2] % 64)) & 1U) == 0;
}

}  // namespace handey
