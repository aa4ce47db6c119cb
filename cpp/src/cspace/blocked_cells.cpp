// Which cells are proved blocked.
#include "blocked_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "handey/errors.hpp"
#include "handey/stop.hpp"

namespace handey {

using cspace::coarse_cells;
using cspace::kMostCoarseCells;
using cspace::kNoPair;
using cspace::SolidPair;
using Eigen::Vector3d;

double cspace::coarse_cells(const Lattice& lattice) {
  return 1.0 * lattice.count[0] * lattice.count[1] * lattice.count[2];
}

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

BlockedCells::Impl::Impl(CollisionChecker& checker, double opening, int finest_level, bool fingers)
    : robot(checker.cell().robot),
      scene(describe_solids(checker)),
      lattice(make_lattice(*robot)),
      finest_level_(finest_level) {
  if (!std::isfinite(opening)) throw InvalidInput("E_NUMBER", "opening", "is not finite");
  if (coarse_cells(lattice) > kMostCoarseCells) {
    throw InvalidInput("E_RANGE", "robot.joints", "the first three joints' ranges are too wide");
  }
  for (SolidMover& mover : scene.movers) {
    if (mover.finger && !fingers) mover.solids.clear();
  }
  middle_.opening = opening;
  middle_.q.resize(static_cast<Eigen::Index>(robot->joints.size()));
  for (const ArmJoint& joint : robot->joints) {
    const JointLimit& limit = joint.limit;
    const bool bounded = std::isfinite(limit.lower) && std::isfinite(limit.upper);
    range_middle_.push_back(bounded ? 0.5 * (limit.lower + limit.upper) : 0.0);
    range_half_.push_back(bounded ? 0.5 * (limit.upper - limit.lower) : kPi);
  }
  axes_.resize(robot->joints.size());
  X_RM_.resize(scene.movers.size());
  add_pairs();
  std::size_t cells = 1;
  for (std::size_t j = 0; j < kCellJoints; ++j) {
    cells *= static_cast<std::size_t>(lattice.count[j]);
    near_[j].resize(cells);
    if (j + 1 == kCellJoints) break;  // each cell is looked at once
    for (std::size_t level = 0; level < Lattice::kLevels; ++level) {
      shared_proofs_[j][level].assign(cells << (level * (j + 1)), kNotLooked);
    }
  }
}

void BlockedCells::Impl::add_pairs() {
  place(0, {0, 0, 0}, kCellJoints);
  for (int m = 0; m < static_cast<int>(scene.movers.size()); ++m) {
    for (const InnerSolid& solid : scene.movers[static_cast<std::size_t>(m)].solids) {
      moving_.emplace_back();
      moving_.back().mover = m;
      moving_.back().solid = &solid;
      moving_.back().slack = wrist_slack(m, solid);
    }
  }
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
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    if (moving_[i].mover != mover) continue;
    pair.moving = static_cast<int>(i);
    pair.a = moving_[i].solid;
    pair.slack = moving_[i].slack;
    for (const InnerSolid& b : solids) {
      pair.b = &b;
      if (pair.slack + b.inradius > 0.0) pairs.push_back(pair);
    }
  }
}

/// The most that a point's depth exceeds what the joints after the third can move it: what of the
/// solid stays put whatever they do.
double BlockedCells::Impl::wrist_slack(int mover, const InnerSolid& solid) {
  throw_if_stopped();
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

/// The first `joints` joints go anywhere in the cell, the others anywhere.
void BlockedCells::Impl::place(int level, const CellIndex& cell, int joints) {
  if (level == placed_level_ && joints == placed_joints_ && cell == placed_cell_) return;
  placed_level_ = level;
  placed_joints_ = joints;
  placed_cell_ = cell;
  finer_ = 1.0 / (1 << std::max(0, finest_level_ - level));
  for (int j = 0; j < static_cast<int>(axes_.size()); ++j) {
    const std::size_t at = static_cast<std::size_t>(j);
    middle_.q[j] = j < joints ? lattice.centre(level, j, cell[at]) : range_middle_[at];
    set_half(axes_[at], j < joints ? 0.5 * lattice.cell_width(level, j) : range_half_[at]);
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
  for (Moving& moving : moving_) moving.known = false;
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

void BlockedCells::Impl::set_reach(Moving& moving, int first_joint) const {
  const int depth = scene.movers[static_cast<std::size_t>(moving.mover)].depth;
  moving.centre = X_RM_[static_cast<std::size_t>(moving.mover)] * moving.solid->centre;
  moving.reach = moving.least = 0.0;
  for (int j = first_joint; j < std::min(depth, kCellJoints); ++j) {
    const AxisMotion& axis = axes_[static_cast<std::size_t>(j)];
    const double distance = axis.direction.cross(moving.centre - axis.point).norm();
    moving.reach += axis.chord * (distance + moving.solid->radius);
    // How far a point goes in the finest cells, at least. The first joint's axis stays.
    if (j == 0) moving.least = finer_ * axis.chord * (distance - moving.solid->radius);
  }
}

const BlockedCells::Impl::Moving& BlockedCells::Impl::moving(int index) {
  Moving& moving = moving_[static_cast<std::size_t>(index)];
  if (!moving.known) set_reach(moving, 0);
  moving.known = true;
  return moving;
}

/// Can the pair overlap deeper, anywhere in the placed cell, than it moves in one of the finest
/// cells?
bool BlockedCells::Impl::can_meet(const SolidPair& pair) {
  if (pair.other < 0) {
    const Moving& a = moving(pair.moving);
    if (pair.slack + pair.b->inradius < a.least) return false;
    const double near = a.reach + a.solid->radius + pair.b->radius;
    if ((a.centre - pair.b->centre).squaredNorm() > near * near) return false;
    return !plainly_apart(placed_a(pair), placed_b(pair), a.reach);
  }
  Moving between = moving_[static_cast<std::size_t>(pair.moving)];
  set_reach(between, pair.other_depth);
  return !plainly_apart(placed_a(pair), placed_b(pair), between.reach);
}

std::size_t BlockedCells::Impl::key(int level, const CellIndex& cell, int joints) const {
  std::size_t index = 0;
  for (int j = 0; j < joints; ++j) {
    index = index * static_cast<std::size_t>(lattice.cells(level, j)) +
            static_cast<std::size_t>(cell[static_cast<std::size_t>(j)]);
  }
  return index;
}

const BlockedCells::Impl::Near& BlockedCells::Impl::near_pairs(const CellIndex& coarse,
                                                               int joints) {
  Near& near = near_[static_cast<std::size_t>(joints - 1)][key(0, coarse, joints)];
  if (near.known) return near;
  near.known = true;
  std::vector<int> all;
  if (joints == 1) {
    all.resize(pairs.size());
    std::iota(all.begin(), all.end(), 0);
  }
  const std::vector<int>& candidates = joints == 1 ? all : near_pairs(coarse, joints - 1).further;
  if (candidates.empty()) return near;
  place(0, coarse, joints);
  for (const int p : candidates) {
    const SolidPair& pair = pairs[static_cast<std::size_t>(p)];
    if (!can_meet(pair)) continue;
    (pair.depth <= joints || joints == kCellJoints ? near.own : near.further).push_back(p);
  }
  return near;
}

bool BlockedCells::Impl::proves(const SolidPair& pair) const {
  const PlacedSolid a = placed_a(pair), b = placed_b(pair);
  if (plainly_apart(a, b, 0.0)) return false;
  const PlacedSolid& smaller = a.solid.radius < b.solid.radius ? a : b;
  Vector3d x = smaller.X_RS * smaller.solid.centre;
  return overlaps_throughout(a, b, motion_of(pair), x);
}

int BlockedCells::Impl::prove_shared(int level, const CellIndex& cell, int joints) {
  int* known = nullptr;
  if (joints < kCellJoints) {
    known = &shared_proofs_[static_cast<std::size_t>(joints - 1)][static_cast<std::size_t>(level)]
                           [key(level, cell, joints)];
    if (*known != kNotLooked) return *known;
  }
  const CellIndex coarse{cell[0] >> level, cell[1] >> level, cell[2] >> level};
  const std::vector<int>& near = near_pairs(coarse, joints).own;
  int proof = kNoPair;
  if (!near.empty()) place(level, cell, joints);
  for (const int p : near) {
    if (!proves(pairs[static_cast<std::size_t>(p)])) continue;
    proof = p;
    break;
  }
  if (known != nullptr) *known = proof;
  return proof;
}

int BlockedCells::Impl::proving_pair(int level, const CellIndex& cell) {
  throw_if_stopped();  // not further in: what is known of a cell must be whole
  for (int joints = 1; joints <= kCellJoints; ++joints) {
    const int proof = prove_shared(level, cell, joints);
    if (proof != kNoPair) return proof;
  }
  return kNoPair;
}

bool BlockedCells::Impl::can_be_blocked(int level, const CellIndex& cell) {
  const CellIndex coarse{cell[0] >> level, cell[1] >> level, cell[2] >> level};
  for (int joints = kCellJoints; joints > 0; --joints) {
    const std::vector<int>& near = near_pairs(coarse, joints).own;
    if (near.empty()) continue;
    if (level == 0) return true;
    place(level, cell, kCellJoints);
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
