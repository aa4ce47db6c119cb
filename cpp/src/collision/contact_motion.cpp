// Planes are sought among the faces of the two pieces, where the edge begins; what a plane leaves
// in the middle of the edge, less what the motion bound allows along its normal, holds all along.
#include "handey/collision/contact_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "checker_impl.hpp"
#include "handey/errors.hpp"
#include "handey/stop.hpp"
#include "motion_bounds.hpp"
#include "overlap.hpp"

namespace handey {

using collision::ConvexSolid;
using collision::MotionBounds;
using collision::Piece;
using collision::PiecePair;
using Eigen::Vector3d;

namespace {

// Choice: faces of a piece that are tried, the largest first. A plane that keeps a part off what it
// stands on is mostly the face that it stands on.
constexpr std::size_t kMostFaces = 64;
constexpr double kSameDirection = 1e-9;  // 1 - cos
constexpr double kRounding = 1e-9;       // of sums and bounds [m]

/// The directions of a piece's faces, body frame; those of the largest faces first.
std::vector<Vector3d> face_directions(const Piece& piece, const Vector3d& toward) {
  if (piece.convex && piece.hull.kind != ConvexSolid::Kind::Points) {
    const Eigen::Matrix3d axes = piece.hull.X_BC.linear();
    std::vector<Vector3d> result;
    for (int k = 0; k < 3; ++k) {
      result.push_back(axes.col(k));
      result.push_back(-axes.col(k));
    }
    if (piece.hull.kind == ConvexSolid::Kind::Cylinder) {
      Vector3d out = toward - piece.hull.centre;
      out -= out.dot(axes.col(2)) * axes.col(2);
      if (out.norm() > kSameDirection) result.push_back(out.normalized());
    }
    return result;
  }
  const MeshShape* mesh = std::get_if<MeshShape>(&piece.shape.geometry);
  if (mesh == nullptr) {  // a sphere
    const Vector3d out = toward - piece.hull.centre;
    return out.norm() > kSameDirection ? std::vector<Vector3d>{out.normalized()}
                                       : std::vector<Vector3d>{};
  }
  std::vector<Vector3d> areas;
  for (const Eigen::Vector3i& t : mesh->mesh->triangles) {
    const auto corner = [&](int k) -> const Vector3d& {
      return mesh->mesh->vertices[static_cast<std::size_t>(t[k])];
    };
    areas.push_back((corner(1) - corner(0)).cross(corner(2) - corner(0)));
  }
  std::sort(areas.begin(), areas.end(),
            [](const Vector3d& x, const Vector3d& y) { return x.squaredNorm() > y.squaredNorm(); });
  std::vector<Vector3d> result;
  for (const Vector3d& area : areas) {
    if (result.size() == kMostFaces || area.squaredNorm() < 1e-24) break;
    const Vector3d unit = area.normalized();
    const bool known = std::any_of(result.begin(), result.end(), [&](const Vector3d& other) {
      return unit.dot(other) > 1.0 - kSameDirection;
    });
    if (!known) result.push_back(unit);
  }
  return result;
}

/// How far the piece reaches along a direction, both in R.
double reach_along(const Piece& piece, const Pose& X_RB, const Vector3d& direction) {
  const Vector3d local = X_RB.linear().transpose() * direction;
  const double origin = X_RB.translation().dot(direction);
  if (piece.convex) return origin + piece.hull.farthest(local).dot(local) + piece.hull.rounding;
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Vector3d& vertex : std::get<MeshShape>(piece.shape.geometry).mesh->vertices) {
    farthest = std::max(farthest, vertex.dot(local));
  }
  return origin + farthest;
}

class Contacts {
 public:
  Contacts(CollisionChecker& clear, CollisionChecker& in_contact, const Configuration& a,
           const Configuration& b, const ContactMotionOptions& options)
      : clear_(clear.impl()),
        allowed_(in_contact.impl()),
        bounds_(clear.impl()),
        a_(a),
        b_(b),
        options_(options) {}

  ContactMotion run() {
    const std::vector<PiecePair> pairs = allowed_pairs();
    if (pairs.empty()) return result_;
    clear_.place(a_);
    X_RM_start_ = clear_.X_RM;
    clear_.place({0.5 * (a_.q + b_.q), 0.5 * (a_.opening + b_.opening)});
    bounds_.set(0.5 * (b_.q - a_.q), 0.25 * std::abs(b_.opening - a_.opening), true);
    for (const PiecePair& pair : pairs) {
      throw_if_stopped();
      if (clear_.rough_distance(pair) > bounds_.approach(pair)) continue;
      const bool held = has_plane(pair);
      ++(held ? result_.proved : result_.measured);
      if (!held) unproved_.push_back(pair);
    }
    if (!unproved_.empty()) measure();
    return result_;
  }

 private:
  std::vector<PiecePair> allowed_pairs() const {
    std::vector<PiecePair> pairs;
    for (std::size_t m = 0; m < clear_.movers.size(); ++m) {
      const collision::Mover& mover = clear_.movers[m];
      for (std::size_t o = 0; o < clear_.obstacle_pieces.size(); ++o) {
        const std::size_t body = static_cast<std::size_t>(clear_.obstacle_pieces[o].obstacle);
        if (!mover.against[body] || allowed_.movers[m].against[body]) continue;
        for (std::size_t p = 0; p < mover.geometry->pieces.size(); ++p) {
          pairs.push_back({static_cast<int>(m), static_cast<int>(p), -1, static_cast<int>(o)});
        }
      }
    }
    return pairs;
  }

  const Piece& other(const PiecePair& pair) const {
    return *clear_.obstacle_pieces[static_cast<std::size_t>(pair.other_piece)].piece;
  }
  const Pose& place_of_other(const PiecePair& pair) const {
    const auto& piece = clear_.obstacle_pieces[static_cast<std::size_t>(pair.other_piece)];
    return clear_.obstacles[static_cast<std::size_t>(piece.obstacle)].X_RB;
  }
  const Pose& place_of_own(const PiecePair& pair) const {
    return clear_.X_RM[static_cast<std::size_t>(pair.mover)];
  }

  bool has_plane(const PiecePair& pair) {
    const Piece& own = clear_.piece(pair.mover, pair.piece);
    const Pose &X_RO = place_of_other(pair), &X_RM = place_of_own(pair);
    const Vector3d own_centre = X_RO.inverse() * (X_RM * own.hull.centre);
    for (const Vector3d& n : face_directions(other(pair), own_centre)) {
      if (holds(pair, X_RO.linear() * n)) return true;
    }
    const Vector3d other_centre = X_RM.inverse() * (X_RO * other(pair).hull.centre);
    for (const Vector3d& n : face_directions(own, other_centre)) {
      if (holds(pair, -(X_RM.linear() * n))) return true;
    }
    return false;
  }

  /// Does a plane keep the mover's piece beyond the obstacle's along its normal (in R) all along?
  /// What overlaps along a normal where the edge begins is the depth of a contact, or more.
  bool holds(const PiecePair& pair, const Vector3d& normal) {
    const Piece& own = clear_.piece(pair.mover, pair.piece);
    const double from = reach_along(other(pair), place_of_other(pair), normal);
    const Pose& X_RM_start = X_RM_start_[static_cast<std::size_t>(pair.mover)];
    const double at_start = -reach_along(own, X_RM_start, -normal) - from;
    if (at_start < options_.deeper - options_.deepest) return false;
    const double least = -reach_along(own, place_of_own(pair), -normal) - from -
                         bounds_.approach_along(pair, normal) * (1.0 + kRounding) - kRounding;
    return least >= std::min(0.0, at_start) - options_.deeper;
  }

  void measure() {
    std::vector<double> at_start(unproved_.size(), 0.0);
    for (int station = 0; station < options_.stations; ++station) {
      const double share = static_cast<double>(station) / options_.stations;
      clear_.place({a_.q + share * (b_.q - a_.q), a_.opening + share * (b_.opening - a_.opening)});
      for (std::size_t i = 0; i < unproved_.size(); ++i) {
        const PiecePair& pair = unproved_[i];
        const double depth =
            collision::overlap_depth(clear_.piece(pair.mover, pair.piece), place_of_own(pair),
                                     other(pair), place_of_other(pair));
        if (station == 0) at_start[i] = depth;
        if (depth <= at_start[i] + options_.deeper) continue;
        result_.deeper = clear_.hit(pair, -depth);
        return;
      }
    }
  }

  CollisionChecker::Impl& clear_;
  const CollisionChecker::Impl& allowed_;
  MotionBounds bounds_;
  const Configuration &a_, &b_;
  const ContactMotionOptions& options_;
  std::vector<Pose> X_RM_start_;
  std::vector<PiecePair> unproved_;
  ContactMotion result_;
};

}  // namespace

ContactMotion follow_contacts(CollisionChecker& clear, CollisionChecker& in_contact,
                              const Configuration& a, const Configuration& b,
                              const ContactMotionOptions& options) {
  if (clear.impl().model != in_contact.impl().model ||
      clear.impl().movers.size() != in_contact.impl().movers.size() ||
      clear.impl().obstacles.size() != in_contact.impl().obstacles.size()) {
    throw InvalidInput("E_REF", "in_contact", "is a checker of another cell");
  }
  if (!(options.deeper >= 0.0 && options.deepest >= options.deeper && options.stations >= 1 &&
        std::isfinite(options.deepest))) {
    throw InvalidInput("E_RANGE", "follow_contacts",
                       "there must be 0 <= deeper <= deepest, and a station");
  }
  clear.impl().place(a);  // checks lengths and numbers
  clear.impl().place(b);
  return Contacts(clear, in_contact, a, b, options).run();
}

}  // namespace handey
