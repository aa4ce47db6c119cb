// Places the robot's pieces and looks at those pairs that balls and boxes do not keep apart.
#include "handey/collision/checker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "checker_impl.hpp"
#include "handey/errors.hpp"
#include "handey/stop.hpp"

namespace handey {

using collision::Mover;
using collision::Obstacle;
using collision::ObstaclePiece;
using collision::PiecePair;
using Eigen::Vector3d;

namespace collision {

void require_same_bodies(const CollisionModel::Impl& model, const Cell& cell) {
  const auto require_same = [](const auto& geometries, const std::vector<Body>& bodies,
                               const char* place) {
    if (geometries.size() != bodies.size()) {
      throw InvalidInput("E_REF", place,
                         "the cell has " + std::to_string(bodies.size()) +
                             ", its collision model was made for " +
                             std::to_string(geometries.size()));
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      require_rigid(bodies[i].X_WB, std::string(place) + "." + bodies[i].name + ".pose");
      if (bodies[i].name != geometries[i].name) {
        throw InvalidInput("E_REF", std::string(place) + "." + bodies[i].name,
                           "the collision model has '" + geometries[i].name + "' in this place");
      }
    }
  };
  if (cell.robot != model.robot) {
    throw InvalidInput("E_REF", "robot", "is not the robot that the collision model was made for");
  }
  require_same(model.fixtures, cell.fixtures, "fixtures");
  require_same(model.parts, cell.parts, "parts");
  require_rigid(cell.X_WR, "robot.base");
}

void require_part(const Cell& cell, int part, const char* place) {
  if (part >= 0 && part < static_cast<int>(cell.parts.size())) return;
  throw InvalidInput("E_REF", place,
                     "part index " + std::to_string(part) + ", the cell has " +
                         std::to_string(cell.parts.size()) + " parts");
}

std::vector<Obstacle> make_obstacles(const CollisionModel::Impl& model, const Cell& cell,
                                     const Pose& X_RW) {
  std::vector<Obstacle> obstacles;
  for (std::size_t i = 0; i < cell.fixtures.size(); ++i) {
    obstacles.push_back({cell.fixtures[i].name,
                         {BodyRef::Kind::Fixture, static_cast<int>(i)},
                         &model.fixtures[i],
                         X_RW * cell.fixtures[i].X_WB,
                         {},
                         0});
  }
  for (std::size_t i = 0; i < cell.parts.size(); ++i) {
    if (cell.held && cell.held->part == static_cast<int>(i)) continue;
    obstacles.push_back({cell.parts[i].name,
                         {BodyRef::Kind::Part, static_cast<int>(i)},
                         &model.parts[i],
                         X_RW * cell.parts[i].X_WB,
                         {},
                         0});
  }
  return obstacles;
}

}  // namespace collision

namespace {

std::vector<Mover> make_movers(const CollisionModel::Impl& model, const Cell& cell) {
  std::vector<Mover> movers;
  for (std::size_t i = 0; i < model.robot_bodies.size(); ++i) {
    Mover mover;
    mover.label = model.robot_bodies[i].name;
    mover.geometry = &model.robot_bodies[i];
    mover.body = static_cast<int>(i);
    mover.depth = model.depth[i];
    mover.finger = model.is_finger[i] != 0;
    movers.push_back(std::move(mover));
  }
  if (!cell.held) return movers;
  const Gripper& gripper = cell.robot->gripper;
  const std::size_t part = static_cast<std::size_t>(cell.held->part);
  Mover held;
  held.label = "held " + cell.parts[part].name;
  held.geometry = &model.parts[part];
  held.body = gripper.body;
  held.X_BM = gripper.X_BH * cell.held->X_HP;
  held.depth = model.depth[static_cast<std::size_t>(gripper.body)];
  movers.push_back(std::move(held));
  return movers;
}

/// Which obstacles a mover is checked against.
void set_checked(Mover& mover, bool held, const std::vector<Obstacle>& obstacles,
                 const Allowance& allowance) {
  for (const Obstacle& obstacle : obstacles) {
    bool checked = true;
    if (held) {
      const std::vector<BodyRef>& touched = allowance.held_touches;
      checked = std::find(touched.begin(), touched.end(), obstacle.ref) == touched.end();
    } else if (mover.is_base()) {
      checked = false;  // the base
    } else if (mover.finger && allowance.closed_on) {
      checked = !(obstacle.ref == BodyRef{BodyRef::Kind::Part, *allowance.closed_on});
    }
    mover.against.push_back(checked ? 1 : 0);
  }
}

}  // namespace

CollisionChecker::Impl::Impl(std::shared_ptr<const CollisionModel> model_in, const Cell& cell_in,
                             const Allowance& allowance)
    : owner(std::move(model_in)), cell(cell_in) {
  if (owner == nullptr) throw InvalidInput("E_REF", "model", "is null");
  model = &owner->impl();
  collision::require_same_bodies(*model, cell);
  if (allowance.closed_on) collision::require_part(cell, *allowance.closed_on, "closed_on");
  if (cell.held) {
    collision::require_part(cell, cell.held->part, "held.part");
    require_rigid(cell.held->X_HP, "held.pose");
  }
  obstacles = collision::make_obstacles(*model, cell, cell.X_WR.inverse());
  movers = make_movers(*model, cell);
  const int bodies = static_cast<int>(model->robot_bodies.size());
  for (int m = 0; m < static_cast<int>(movers.size()); ++m) {
    set_checked(movers[static_cast<std::size_t>(m)], m >= bodies, obstacles, allowance);
  }
  mover_pairs = model->self_pairs;
  for (int b = bodies - 1; b >= 0 && cell.held; --b) {
    if (!model->is_finger[static_cast<std::size_t>(b)]) mover_pairs.emplace_back(b, bodies);
  }
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    obstacles[o].centre = obstacles[o].X_RB * obstacles[o].geometry->centre;
    obstacles[o].first_piece = static_cast<int>(obstacle_pieces.size());
    for (const auto& piece : obstacles[o].geometry->pieces) {
      obstacle_pieces.push_back(
          {piece.get(), static_cast<int>(o), obstacles[o].X_RB * piece->box.X_BO});
    }
  }
  X_RM.resize(movers.size());
  mover_centres.resize(movers.size());
}

void CollisionChecker::Impl::place(const Configuration& configuration) {
  throw_if_stopped();  // whatever is asked of a checker begins here
  if (!std::isfinite(configuration.opening)) {
    throw InvalidInput("E_NUMBER", "configuration.opening", "is not finite");
  }
  body_poses(*model->robot, configuration, X_RB);
  for (std::size_t m = 0; m < movers.size(); ++m) {
    const Pose& X = X_RB[static_cast<std::size_t>(movers[m].body)];
    X_RM[m] = m < model->robot_bodies.size() ? X : X * movers[m].X_BM;
    mover_centres[m] = X_RM[m] * movers[m].geometry->centre;
  }
}

double CollisionChecker::Impl::distance(const PiecePair& pair, double least, double enough,
                                        Vector3d* apart) const {
  const std::size_t m = static_cast<std::size_t>(pair.mover);
  const std::size_t index = static_cast<std::size_t>(pair.other_piece);
  if (pair.other >= 0) {
    return piece_distance(piece(pair.mover, pair.piece), X_RM[m],
                          piece(pair.other, pair.other_piece),
                          X_RM[static_cast<std::size_t>(pair.other)], least, enough, apart);
  }
  const ObstaclePiece& obstacle = obstacle_pieces[index];
  return piece_distance(piece(pair.mover, pair.piece), X_RM[m], *obstacle.piece,
                        obstacles[static_cast<std::size_t>(obstacle.obstacle)].X_RB, least, enough,
                        apart);
}

namespace {

/// The other piece of a pair, and where it is.
std::pair<const collision::Piece*, const Pose*> other_of(const CollisionChecker::Impl& checker,
                                                         const PiecePair& pair) {
  if (pair.other >= 0) {
    return {&checker.piece(pair.other, pair.other_piece),
            &checker.X_RM[static_cast<std::size_t>(pair.other)]};
  }
  const ObstaclePiece& obstacle =
      checker.obstacle_pieces[static_cast<std::size_t>(pair.other_piece)];
  return {obstacle.piece, &checker.obstacles[static_cast<std::size_t>(obstacle.obstacle)].X_RB};
}

}  // namespace

bool CollisionChecker::Impl::are_convex(const PiecePair& pair) const {
  return piece(pair.mover, pair.piece).convex && other_of(*this, pair).first->convex;
}

double CollisionChecker::Impl::hull_distance(const PiecePair& pair, double enough,
                                             Vector3d* apart) const {
  const auto [other, X_RO] = other_of(*this, pair);
  return collision::convex_distance(piece(pair.mover, pair.piece).hull,
                                    X_RM[static_cast<std::size_t>(pair.mover)], other->hull, *X_RO,
                                    0.0, enough, apart);
}

double CollisionChecker::Impl::distance_along(const PiecePair& pair,
                                              const Vector3d& direction) const {
  const auto [other, X_RO] = other_of(*this, pair);
  return collision::convex_distance_along(piece(pair.mover, pair.piece).hull,
                                          X_RM[static_cast<std::size_t>(pair.mover)], other->hull,
                                          *X_RO, direction);
}

double CollisionChecker::Impl::rough_distance(const PiecePair& pair) const {
  const collision::Piece& own = piece(pair.mover, pair.piece);
  const Pose X_RP = X_RM[static_cast<std::size_t>(pair.mover)] * own.box.X_BO;
  if (pair.other < 0) {
    const ObstaclePiece& obstacle = obstacle_pieces[static_cast<std::size_t>(pair.other_piece)];
    const Vector3d& half = obstacle.piece->box.half;
    return std::max(collision::ball_to_box(X_RP.translation(), own.radius, obstacle.X_RO, half),
                    collision::box_to_box(X_RP, own.box.half, obstacle.X_RO, half));
  }
  const collision::Piece& other = piece(pair.other, pair.other_piece);
  const Pose X_RQ = X_RM[static_cast<std::size_t>(pair.other)] * other.box.X_BO;
  return std::max((X_RP.translation() - X_RQ.translation()).norm() - own.radius - other.radius,
                  collision::box_to_box(X_RP, own.box.half, X_RQ, other.box.half));
}

bool CollisionChecker::Impl::is_in_crowd(int mover, double reach, int count) const {
  const std::size_t m = static_cast<std::size_t>(mover);
  const double radius = movers[m].geometry->radius;
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const Obstacle& obstacle = obstacles[o];
    if (!movers[m].against[o] || !obstacle.geometry->has_tree()) continue;
    const Vector3d local =
        obstacle.X_RB.linear().transpose() * (mover_centres[m] - obstacle.X_RB.translation());
    int near = 0;
    const auto is_last = [&](int) { return ++near >= count; };
    if (obstacle.geometry->tree.visit_near(local, radius, reach, is_last)) return true;
  }
  return false;
}

Hit CollisionChecker::Impl::hit(const PiecePair& pair, double distance) const {
  Hit result;
  result.a = movers[static_cast<std::size_t>(pair.mover)].label;
  result.b =
      pair.other >= 0
          ? movers[static_cast<std::size_t>(pair.other)].label
          : obstacles[static_cast<std::size_t>(
                          obstacle_pieces[static_cast<std::size_t>(pair.other_piece)].obstacle)]
                .label;
  result.distance = distance;
  return result;
}

CollisionChecker::CollisionChecker(std::shared_ptr<const CollisionModel> model, const Cell& cell,
                                   const Allowance& allowance)
    : impl_(std::make_unique<Impl>(std::move(model), cell, allowance)) {}
CollisionChecker::~CollisionChecker() = default;
CollisionChecker::CollisionChecker(CollisionChecker&&) noexcept = default;
CollisionChecker& CollisionChecker::operator=(CollisionChecker&&) noexcept = default;

const Cell& CollisionChecker::cell() const { return impl_->cell; }

std::optional<Hit> CollisionChecker::find_hit(const Configuration& configuration,
                                              double clearance) {
  if (!std::isfinite(clearance)) throw InvalidInput("E_NUMBER", "clearance", "is not finite");
  impl_->place(configuration);
  std::optional<Hit> found;
  const auto visit = [&](const PiecePair& pair) {
    const double distance = impl_->distance(pair, clearance, clearance);
    if (distance > clearance) return false;
    found = impl_->hit(pair, distance);
    impl_->last_hit = pair;
    return true;
  };
  // What stood in the way of the last configuration often does in that of the next.
  if (impl_->last_hit && impl_->rough_distance(*impl_->last_hit) <= clearance &&
      visit(*impl_->last_hit)) {
    return found;
  }
  impl_->visit_near([clearance](const PiecePair&) { return clearance; }, visit);
  return found;
}

Hit CollisionChecker::closest(const Configuration& configuration, double horizon) {
  if (!std::isfinite(horizon) || horizon < 0.0) {
    throw InvalidInput("E_RANGE", "horizon", "must be finite and not negative");
  }
  impl_->place(configuration);
  Hit best;
  best.distance = horizon;
  impl_->visit_near([&best](const PiecePair&) { return best.distance; },
                    [&](const PiecePair& pair) {
                      const double distance =
                          std::max(0.0, impl_->distance(pair, 0.0, best.distance));
                      if (distance < best.distance || best.a.empty()) {
                        if (distance <= best.distance) best = impl_->hit(pair, distance);
                      }
                      return best.distance <= 0.0 && !best.a.empty();
                    });
  return best;
}

}  // namespace handey
