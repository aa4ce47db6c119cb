// A checker from within: what moves, what stands, and which of their pieces are to be kept apart.
// All in the robot frame R.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "handey/collision/box_certificate.hpp"
#include "model.hpp"

namespace handey {

namespace collision {

/// A robot body that is checked, or the held part.
struct Mover {
  std::string label;
  const BodyGeometry* geometry = nullptr;
  int body = 0;                  ///< robot body that it is or is held by
  Pose X_BM = Pose::Identity();  ///< mover in that body
  int depth = 0;                 ///< number of arm joints that move it
  bool finger = false;           ///< moved by half of the opening besides
  bool is_base() const { return depth == 0 && !finger; }
  std::vector<char> against;  ///< per obstacle: checked or not
};

/// A fixture, or a part that stands.
struct Obstacle {
  std::string label;
  BodyRef ref;
  const BodyGeometry* geometry = nullptr;
  Pose X_RB = Pose::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the geometry's ball, in R
  int first_piece = 0;                               ///< in the checker's obstacle_pieces
};

/// The bodies that stand in the cell: fixtures, then the parts that are not held.
/// @param X_RW world in the frame wanted
std::vector<Obstacle> make_obstacles(const CollisionModel::Impl& model, const Cell& cell,
                                     const Pose& X_RW);
/// @throws InvalidInput unless the cell has the bodies that the model was made for, at rigid poses
void require_same_bodies(const CollisionModel::Impl& model, const Cell& cell);
/// @throws InvalidInput unless the cell has a part of this index
void require_part(const Cell& cell, int part, const char* place);

struct ObstaclePiece {
  const Piece* piece = nullptr;
  int obstacle = 0;
  Pose X_RO = Pose::Identity();  ///< its box in R
};

using handey::PiecePair;

}  // namespace collision

struct CollisionChecker::Impl {
  std::shared_ptr<const CollisionModel> owner;  ///< keeps the model alive
  const CollisionModel::Impl* model = nullptr;
  Cell cell;
  std::vector<collision::Mover> movers;
  std::vector<collision::Obstacle> obstacles;
  std::vector<collision::ObstaclePiece> obstacle_pieces;
  std::vector<std::pair<int, int>> mover_pairs;  ///< movers that are checked against each other

  std::optional<collision::PiecePair> last_hit;  ///< that find_hit() met

  // Where the movers are: set by place().
  std::vector<Pose> X_RB;  ///< of the robot bodies
  std::vector<Pose> X_RM;  ///< of the movers
  std::vector<Eigen::Vector3d> mover_centres;

  Impl(std::shared_ptr<const CollisionModel> model_in, const Cell& cell_in,
       const Allowance& allowance);
  /// @throws InvalidInput for wrong lengths or numbers that are not finite
  void place(const Configuration& configuration);
  /// Lower bound of the distance of two pieces as placed; same terms as convex_distance.
  double distance(const collision::PiecePair& pair, double least, double enough,
                  Eigen::Vector3d* apart = nullptr) const;
  /// How far the first piece of a pair lies beyond the second along a unit direction, as placed;
  /// pieces that are not convex count as the boxes that contain them [m].
  double distance_along(const collision::PiecePair& pair, const Eigen::Vector3d& direction) const;
  /// As distance(), but pieces that are not convex count as the boxes that contain them.
  double hull_distance(const collision::PiecePair& pair, double enough,
                       Eigen::Vector3d* apart) const;
  bool are_convex(const collision::PiecePair& pair) const;
  /// A cheap lower bound of the same, from balls and boxes.
  double rough_distance(const collision::PiecePair& pair) const;
  Hit hit(const collision::PiecePair& pair, double distance) const;
  const collision::Piece& piece(int mover, int index) const {
    return *movers[static_cast<std::size_t>(mover)]
                .geometry->pieces[static_cast<std::size_t>(index)];
  }

  /// Are so many pieces of one body nearer to the ball of a mover than this? [m]
  bool is_in_crowd(int mover, double reach, int count) const;

  /// Calls visit(pair) for every pair of pieces whose balls and boxes are not seen to be farther
  /// apart than reach(pair); stops when visit is true. reach is also asked for whole movers: their
  /// pieces are then -1.
  template <class Reach, class Visit>
  bool visit_near(const Reach& reach, const Visit& visit) const;
};

template <class Reach, class Visit>
bool CollisionChecker::Impl::visit_near(const Reach& reach, const Visit& visit) const {
  using collision::PiecePair;
  for (int m = static_cast<int>(movers.size()) - 1; m >= 0; --m) {  // the hand meets things first
    const collision::Mover& mover = movers[static_cast<std::size_t>(m)];
    const Pose& X = X_RM[static_cast<std::size_t>(m)];
    const Eigen::Vector3d& centre = mover_centres[static_cast<std::size_t>(m)];
    const double coarse = reach(PiecePair{m, -1, -1, -1});
    const double radius = mover.geometry->radius;
    const auto visit_piece = [&](int o) {
      const collision::ObstaclePiece& obstacle = obstacle_pieces[static_cast<std::size_t>(o)];
      const Eigen::Vector3d& half = obstacle.piece->box.half;
      if (collision::ball_to_box(centre, radius, obstacle.X_RO, half) > coarse) return false;
      for (std::size_t p = 0; p < mover.geometry->pieces.size(); ++p) {
        const collision::Piece& own = *mover.geometry->pieces[p];
        const Eigen::Vector3d at = X * own.box.X_BO.translation();
        const PiecePair pair{m, static_cast<int>(p), -1, o};
        const double far = reach(pair);
        if (collision::ball_to_box(at, own.radius, obstacle.X_RO, half) > far) continue;
        if (collision::box_to_box(X * own.box.X_BO, own.box.half, obstacle.X_RO, half) > far) {
          continue;
        }
        if (visit(pair)) return true;
      }
      return false;
    };
    for (std::size_t o = 0; o < obstacles.size(); ++o) {
      if (!mover.against[o]) continue;
      const collision::Obstacle& obstacle = obstacles[o];
      const collision::BodyGeometry& geometry = *obstacle.geometry;
      const double balls = radius + geometry.radius + coarse;
      if (balls < 0.0 || (centre - obstacle.centre).squaredNorm() > balls * balls) continue;
      const int first = obstacle.first_piece;
      if (geometry.has_tree()) {
        const Eigen::Vector3d local =
            obstacle.X_RB.linear().transpose() * (centre - obstacle.X_RB.translation());
        if (geometry.tree.visit_near(local, radius, coarse,
                                     [&](int piece) { return visit_piece(first + piece); })) {
          return true;
        }
        continue;
      }
      const int count = static_cast<int>(geometry.pieces.size());
      for (int piece = 0; piece < count; ++piece) {
        if (visit_piece(first + piece)) return true;
      }
    }
  }
  for (const std::pair<int, int>& pair : mover_pairs) {
    const std::size_t a = static_cast<std::size_t>(pair.first),
                      b = static_cast<std::size_t>(pair.second);
    const collision::BodyGeometry& one = *movers[a].geometry;
    const collision::BodyGeometry& two = *movers[b].geometry;
    const double apart = (mover_centres[a] - mover_centres[b]).norm() - one.radius - two.radius;
    if (apart > reach(PiecePair{pair.first, -1, pair.second, -1})) continue;
    for (std::size_t p = 0; p < one.pieces.size(); ++p) {
      const Eigen::Vector3d at = X_RM[a] * one.pieces[p]->box.X_BO.translation();
      for (std::size_t r = 0; r < two.pieces.size(); ++r) {
        const PiecePair candidate{pair.first, static_cast<int>(p), pair.second,
                                  static_cast<int>(r)};
        const collision::Piece& other = *two.pieces[r];
        const double balls = (at - X_RM[b] * other.box.X_BO.translation()).norm() -
                             one.pieces[p]->radius - other.radius;
        const double far = reach(candidate);
        if (balls > far) continue;
        const Pose X_RP = X_RM[a] * one.pieces[p]->box.X_BO, X_RQ = X_RM[b] * other.box.X_BO;
        if (collision::box_to_box(X_RP, one.pieces[p]->box.half, X_RQ, other.box.half) > far) {
          continue;
        }
        if (visit(candidate)) return true;
      }
    }
  }
  return false;
}

}  // namespace handey
