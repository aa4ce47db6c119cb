// Which cells are proved blocked.
#include "blocked_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "handey/errors.hpp"

namespace handey {

using cspace::AxisMotion;
using cspace::kNoPair;
using cspace::PlacedSolid;
using cspace::RelativeMotion;
using cspace::SolidPair;
using Eigen::Vector3d;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kNotLooked = -2;
constexpr int kCellJoints = 3;
constexpr int kSlackSteps = 60;
// Limits and cells count as that much wider: the tolerance of the limits and rounding [rad].
constexpr double kWiden = 1e-7;

void set_half(AxisMotion& axis, double half) {
  const double turn = std::min(half + kWiden, kPi);
  axis.chord = 2.0 * std::sin(0.5 * turn);
  axis.sine = std::sin(turn);
  axis.versed = 1.0 - std::cos(turn);
}

}  // namespace

BlockedCells::Impl::Impl(CollisionChecker& checker, double opening)
    : robot(checker.cell().robot), scene(describe_solids(checker)), lattice(make_lattice(*robot)) {
  if (!std::isfinite(opening)) throw InvalidInput("E_NUMBER", "opening", "is not finite");
  const std::size_t joints = robot->joints.size();
  middle_.opening = opening;
  middle_.q = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(joints));
  axes_.resize(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    const JointLimit& limit = robot->joints[j].limit;
    const bool bounded = std::isfinite(limit.lower) && std::isfinite(limit.upper);
    if (bounded) middle_.q[static_cast<Eigen::Index>(j)] = 0.5 * (limit.lower + limit.upper);
    set_half(axes_[j], bounded ? 0.5 * (limit.upper - limit.lower) : kPi);
  }
  X_RM_.resize(scene.movers.size());
  add_pairs();
  std::size_t cells = 1;
  for (int joints_shared = 1; joints_shared <= kCellJoints; ++joints_shared) {
    Known& known = known_[static_cast<std::size_t>(joints_shared - 1)];
    cells *= static_cast<std::size_t>(lattice.cells(0, joints_shared - 1));
    known.near.resize(cells);
    known.has_near.assign(cells, 0);
    if (joints_shared == kCellJoints) continue;  // each cell is looked at once
    for (int level = 0; level < Lattice::kLevels; ++level) {
      known.proof[static_cast<std::size_t>(level)].assign(cells << (level * joints_shared),
                                                          kNotLooked);
    }
  }
}

void BlockedCells::Impl::add_pairs() {
  place(0, {0, 0, 0});
  for (int m = 0; m < static_cast<int>(scene.movers.size()); ++m) {
    for (std::size_t o = 0; o < scene.obstacles.size(); ++o) {
      if (!scene.obstacles[o].checked[static_cast<std::size_t>(m)]) continue;
      add_pair(m, -1, static_cast<int>(o), scene.obstacles[o].solids);
    }
  }
  for (const std::pair<int, int>& pair : scene.mover_pairs) {
    int far = pair.first, near = pair.second;
    if (scene.movers[static_cast<std::size_t>(far)].depth <
        scene.movers[static_cast<std::size_t>(near)].depth) {
      std::swap(far, near);
    }
    add_pair(far, near, -1, scene.movers[static_cast<std::size_t>(near)].solids);
  }
}

void BlockedCells::Impl::add_pair(int mover, int other, int obstacle,
                                  const std::vector<InnerSolid>& solids) {
  SolidPair pair;
  pair.mover = mover;
  pair.other = other;
  pair.obstacle = obstacle;
  pair.depth = scene.movers[static_cast<std::size_t>(mover)].depth;
  pair.other_depth = other < 0 ? 0 : scene.movers[static_cast<std::size_t>(other)].depth;
  // No joint of the cell moves one against the other.
  if (pair.depth <= pair.other_depth || pair.other_depth >= kCellJoints) return;
  for (const InnerSolid& a : scene.movers[static_cast<std::size_t>(mover)].solids) {
    const double slack = wrist_slack(mover, a);
    for (const InnerSolid& b : solids) {
      if (slack + b.inradius <= 0.0) continue;
      pair.a = &a;
      pair.b = &b;
      pairs.push_back(pair);
    }
  }
}

/// The most that a point's depth exceeds what the joints after the third can move it: what of the
/// solid stays put whatever they do.
double BlockedCells::Impl::wrist_slack(int mover, const InnerSolid& solid) {
  RelativeMotion motion;
  motion.axes = axes_.data();
  motion.cell_begin = motion.cell_end = kCellJoints;
  motion.free_end = std::max(kCellJoints, scene.movers[static_cast<std::size_t>(mover)].depth);
  const Pose& X = X_RM_[static_cast<std::size_t>(mover)];
  Vector3d local = solid.centre;
  double best = -1e9;
  for (int step = 0; step < kSlackSteps; ++step) {
    Vector3d slope;
    std::size_t face = 0;
    double depth = 1e9;
    for (std::size_t i = 0; i < solid.normals.size(); ++i) {
      const double here = solid.offsets[i] - solid.normals[i].dot(local);
      if (here < depth) {
        depth = here;
        face = i;
      }
    }
    const double slack = depth - motion.bound(X * local, &slope);
    if (depth >= 0.0) best = std::max(best, slack);
    slope = -(X.linear().transpose() * slope) - solid.normals[face];
    if (slope.norm() < 1e-9) break;
    local += slope.normalized() * (solid.radius / (2.0 + step));
  }
  return best;
}

void BlockedCells::Impl::place(int level, const CellIndex& cell) {
  if (level == placed_level_ && cell == placed_cell_) return;
  placed_level_ = level;
  placed_cell_ = cell;
  for (int j = 0; j < kCellJoints; ++j) {
    middle_.q[j] = lattice.centre(level, j, cell[static_cast<std::size_t>(j)]);
    set_half(axes_[static_cast<std::size_t>(j)], 0.5 * lattice.cell_width(level, j));
  }
  body_poses(*robot, middle_, X_RB_);
  for (std::size_t j = 0; j < axes_.size(); ++j) {
    const Pose& X_RC = X_RB_[static_cast<std::size_t>(robot->joints[j].child)];
    axes_[j].point = X_RC.translation();
    axes_[j].direction = X_RC.linear() * robot->joints[j].axis;
  }
  for (std::size_t m = 0; m < scene.movers.size(); ++m) {
    X_RM_[m] = X_RB_[static_cast<std::size_t>(scene.movers[m].body)] * scene.movers[m].X_BM;
  }
}

RelativeMotion BlockedCells::Impl::motion_of(const SolidPair& pair) const {
  RelativeMotion motion;
  motion.axes = axes_.data();
  motion.cell_begin = pair.other_depth;
  motion.cell_end = std::min(pair.depth, kCellJoints);
  motion.free_end = pair.depth;
  return motion;
}

PlacedSolid BlockedCells::Impl::placed_a(const SolidPair& pair) const {
  return {*pair.a, X_RM_[static_cast<std::size_t>(pair.mover)]};
}

PlacedSolid BlockedCells::Impl::placed_b(const SolidPair& pair) const {
  static const Pose kIdentity = Pose::Identity();
  return {*pair.b, pair.other < 0 ? kIdentity : X_RM_[static_cast<std::size_t>(pair.other)]};
}

bool BlockedCells::Impl::can_meet(const SolidPair& pair) const {
  const PlacedSolid a = placed_a(pair);
  const double motion = motion_of(pair).bound_in_ball(a.X_RS * a.solid.centre, a.solid.radius);
  return !plainly_apart(a, placed_b(pair), motion);
}

std::size_t BlockedCells::Impl::key(int level, const CellIndex& cell, int joints) const {
  std::size_t index = 0;
  for (int j = 0; j < joints; ++j) {
    index = index * static_cast<std::size_t>(lattice.cells(level, j)) +
            static_cast<std::size_t>(cell[static_cast<std::size_t>(j)]);
  }
  return index;
}

/// Pairs that these first joints and no others of the cell move, and that can meet in the coarse
/// cell.
const std::vector<int>& BlockedCells::Impl::near_pairs(const CellIndex& coarse, int joints) {
  Known& known = known_[static_cast<std::size_t>(joints - 1)];
  const std::size_t index = key(0, coarse, joints);
  std::vector<int>& near = known.near[index];
  if (known.has_near[index]) return near;
  known.has_near[index] = 1;
  place(0, coarse);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (std::min(pairs[p].depth, kCellJoints) != joints) continue;
    if (can_meet(pairs[p])) near.push_back(static_cast<int>(p));
  }
  return near;
}

int BlockedCells::Impl::prove_shared(int level, const CellIndex& cell, int joints) {
  int* known = nullptr;
  if (joints < kCellJoints) {
    Known& shared = known_[static_cast<std::size_t>(joints - 1)];
    known = &shared.proof[static_cast<std::size_t>(level)][key(level, cell, joints)];
    if (*known != kNotLooked) return *known;
  }
  const CellIndex coarse{cell[0] >> level, cell[1] >> level, cell[2] >> level};
  const std::vector<int>& near = near_pairs(coarse, joints);
  int proof = kNoPair;
  if (!near.empty()) place(level, cell);
  for (const int p : near) {
    const SolidPair& pair = pairs[static_cast<std::size_t>(p)];
    const PlacedSolid a = placed_a(pair), b = placed_b(pair);
    if (plainly_apart(a, b, 0.0)) continue;
    const PlacedSolid& smaller = a.solid.radius < b.solid.radius ? a : b;
    Vector3d x = smaller.X_RS * smaller.solid.centre;
    if (!overlaps_throughout(a, b, motion_of(pair), x)) continue;
    proof = p;
    break;
  }
  if (known != nullptr) *known = proof;
  return proof;
}

int BlockedCells::Impl::proving_pair(int level, const CellIndex& cell) {
  for (int joints = 1; joints <= kCellJoints; ++joints) {
    const int proof = prove_shared(level, cell, joints);
    if (proof != kNoPair) return proof;
  }
  return kNoPair;
}

bool BlockedCells::Impl::can_be_blocked(int level, const CellIndex& cell) {
  const CellIndex coarse{cell[0] >> level, cell[1] >> level, cell[2] >> level};
  for (int joints = 1; joints <= kCellJoints; ++joints) {
    const std::vector<int>& near = near_pairs(coarse, joints);
    if (near.empty()) continue;
    if (level == 0) return true;
    place(level, cell);
    if (std::any_of(near.begin(), near.end(),
                    [this](int p) { return can_meet(pairs[static_cast<std::size_t>(p)]); })) {
      return true;
    }
  }
  return false;
}

BlockedProof BlockedCells::Impl::named(int index) const {
  if (index == kNoPair) return {};
  const SolidPair& pair = pairs[static_cast<std::size_t>(index)];
  return {true, scene.movers[static_cast<std::size_t>(pair.mover)].name,
          pair.other < 0 ? scene.obstacles[static_cast<std::size_t>(pair.obstacle)].name
                         : scene.movers[static_cast<std::size_t>(pair.other)].name};
}

BlockedCells::BlockedCells(CollisionChecker& checker, double opening)
    : impl_(std::make_unique<Impl>(checker, opening)) {}
BlockedCells::~BlockedCells() = default;
BlockedCells::BlockedCells(BlockedCells&&) noexcept = default;

const Lattice& BlockedCells::lattice() const { return impl_->lattice; }

BlockedProof BlockedCells::prove(int level, const CellIndex& cell) {
  if (level < 0 || level >= Lattice::kLevels) {
    throw InvalidInput(
        "E_RANGE", "level",
        std::to_string(level) + ", expected 0 to " + std::to_string(Lattice::kLevels - 1));
  }
  for (int j = 0; j < kCellJoints; ++j) {
    const int index = cell[static_cast<std::size_t>(j)], count = impl_->lattice.cells(level, j);
    if (index < 0 || index >= count) {
      throw InvalidInput("E_RANGE", "cell",
                         "index " + std::to_string(index) + " of joint " + std::to_string(j + 1) +
                             ", expected 0 to " + std::to_string(count - 1));
    }
  }
  return impl_->named(impl_->proving_pair(level, cell));
}

}  // namespace handey
