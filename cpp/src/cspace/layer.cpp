// A quadtree over theta2 and theta3: what a box leaves near is all that its quarters look at.
#include "handey/cspace/layer.hpp"

#include <cmath>
#include <string>

#include "handey/errors.hpp"

namespace handey {
namespace {

void require_level(const LayerOptions& options) {
  if (options.level < 0 || options.level >= Lattice::kLevels) {
    throw InvalidInput("E_RANGE", "options.level",
                       "found " + std::to_string(options.level) + ", expected 0 to " +
                           std::to_string(Lattice::kLevels - 1));
  }
}

void require_wrist(const WristRange& wrist, std::size_t joints) {
  const Eigen::Index expected = static_cast<Eigen::Index>(joints) - 3;
  if (wrist.lower.size() != expected || wrist.upper.size() != expected) {
    throw InvalidInput("E_DOF", "wrist",
                       "expected " + std::to_string(expected) +
                           " values for each bound: one for every joint after the third");
  }
  if (!wrist.lower.allFinite() || !wrist.upper.allFinite()) {
    throw InvalidInput("E_NUMBER", "wrist", "holds a number that is not finite");
  }
  if ((wrist.lower.array() > wrist.upper.array()).any()) {
    throw InvalidInput("E_RANGE", "wrist", "a lower bound is greater than its upper bound");
  }
}

void require_opening(const Gripper& gripper, double opening) {
  if (opening >= gripper.min_opening && opening <= gripper.max_opening) return;
  throw InvalidInput("E_RANGE", "opening",
                     "found " + std::to_string(opening) + ", expected " +
                         std::to_string(gripper.min_opening) + " to " +
                         std::to_string(gripper.max_opening) + " m");
}

int waist_cell(const Lattice& lattice, int level, double theta1) {
  if (!std::isfinite(theta1)) throw InvalidInput("E_NUMBER", "theta1", "is not finite");
  const int cell = lattice.index_of(level, 0, theta1);
  if (cell >= 0) return cell;
  throw InvalidInput("E_LIMIT", "theta1",
                     std::to_string(theta1) + " rad is outside the limits of the first joint");
}

class LayerProof {
 public:
  LayerProof(CollisionChecker& checker, const Lattice& lattice, SliceLayer& layer,
             const WristRange& wrist, double opening, const LayerOptions& options)
      : checker_(checker),
        prover_(checker, options.clearance),
        lattice_(lattice),
        layer_(layer),
        level_(options.level),
        clearance_(options.clearance) {
    box_.centre.opening = opening;
    box_.centre.q.resize(3 + wrist.lower.size());
    box_.half.resize(box_.centre.q.size());
    box_.centre.q << layer.theta1, 0.0, 0.0, 0.5 * (wrist.lower + wrist.upper);
    box_.half << 0.5 * lattice.cell_width(level_, 0), 0.0, 0.0, 0.5 * (wrist.upper - wrist.lower);
  }

  /// @param near  pairs to look at; null for all
  void look(int level, int column, int row, const std::vector<NearPair>* near) {
    box_.centre.q(1) = lattice_.centre(level, 1, column);
    box_.centre.q(2) = lattice_.centre(level, 2, row);
    box_.half(1) = 0.5 * lattice_.cell_width(level, 1);
    box_.half(2) = 0.5 * lattice_.cell_width(level, 2);
    const BoxProof proof = near == nullptr ? prover_.prove(box_) : prover_.prove(box_, *near);
    if (proof.free) {
      paint(level, column, row, CellKind::Free);
      return;
    }
    if (level == level_) {
      const bool collides = proof.collides || !checker_.is_free(box_.centre, clearance_);
      paint(level, column, row, collides ? CellKind::Collides : CellKind::NotProved);
      return;
    }
    for (int child = 0; child < 4; ++child) {
      look(level + 1, 2 * column + child % 2, 2 * row + child / 2, &proof.near);
    }
  }

 private:
  void paint(int level, int column, int row, CellKind kind) {
    const int width = 1 << (level_ - level);
    for (int r = row * width; r < (row + 1) * width; ++r) {
      for (int c = column * width; c < (column + 1) * width; ++c) {
        layer_.kinds[static_cast<std::size_t>(r) * static_cast<std::size_t>(layer_.columns) +
                     static_cast<std::size_t>(c)] = kind;
      }
    }
  }

  CollisionChecker& checker_;
  BoxProver prover_;
  const Lattice& lattice_;
  SliceLayer& layer_;
  int level_;
  double clearance_;
  ConfigurationBox box_;
};

}  // namespace

SliceLayer prove_layer(CollisionChecker& checker, double theta1, const WristRange& wrist,
                       double opening, const LayerOptions& options) {
  const Robot& robot = *checker.cell().robot;
  require_level(options);
  const Lattice lattice = make_lattice(robot);
  require_wrist(wrist, robot.joints.size());
  require_opening(robot.gripper, opening);
  SliceLayer layer;
  layer.theta1 = lattice.centre(options.level, 0, waist_cell(lattice, options.level, theta1));
  layer.columns = lattice.cells(options.level, 1);
  layer.rows = lattice.cells(options.level, 2);
  layer.kinds.assign(static_cast<std::size_t>(layer.columns) * static_cast<std::size_t>(layer.rows),
                     CellKind::NotProved);
  LayerProof proof(checker, lattice, layer, wrist, opening, options);
  for (int row = 0; row < lattice.count[2]; ++row) {
    for (int column = 0; column < lattice.count[1]; ++column) proof.look(0, column, row, nullptr);
  }
  return layer;
}

}  // namespace handey
