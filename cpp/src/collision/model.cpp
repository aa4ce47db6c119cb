// Makes the collision model of a cell and finds the pairs of robot bodies that are never checked.
#include "model.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "handey/errors.hpp"
#include "handey/stop.hpp"

namespace handey {
namespace {

using collision::BodyGeometry;
using collision::Pieces;
using Eigen::Vector3d;

// The rule of the robot file's format: overlapping at home and in more than 950 of 1000 random
// configurations.
constexpr int kRandomConfigurations = 1000;
constexpr int kMostMisses = 49;
constexpr std::uint64_t kSeed = 560;
constexpr double kPi = 3.14159265358979323846;

BodyGeometry make_body(const std::string& name, const std::vector<Shape>& shapes) {
  BodyGeometry body;
  body.name = name;
  body.shapes = shapes;
  body.pieces = collision::make_pieces(shapes, name);
  Eigen::AlignedBox3d extent;
  for (const auto& piece : body.pieces) {
    const Vector3d reach = piece->box.X_BO.linear().cwiseAbs() * piece->box.half;
    extent.extend(Vector3d(piece->box.X_BO.translation() - reach));
    extent.extend(Vector3d(piece->box.X_BO.translation() + reach));
  }
  if (body.pieces.empty()) return body;
  body.centre = extent.center();
  for (const auto& piece : body.pieces) {
    const double reach = (piece->box.X_BO.translation() - body.centre).norm() + piece->radius;
    body.radius = std::max(body.radius, reach);
  }
  body.radius = std::min(body.radius, 0.5 * extent.sizes().norm());
  if (body.has_tree()) body.tree = collision::PieceTree(body.pieces);
  return body;
}

bool are_same(const Shape& a, const Shape& b) {
  if (a.geometry.index() != b.geometry.index() || a.X_BS.matrix() != b.X_BS.matrix()) return false;
  if (const Box* box = std::get_if<Box>(&a.geometry)) {
    return box->size == std::get<Box>(b.geometry).size;
  }
  if (const Cylinder* cylinder = std::get_if<Cylinder>(&a.geometry)) {
    const Cylinder& other = std::get<Cylinder>(b.geometry);
    return cylinder->radius == other.radius && cylinder->length == other.length;
  }
  if (const Sphere* sphere = std::get_if<Sphere>(&a.geometry)) {
    return sphere->radius == std::get<Sphere>(b.geometry).radius;
  }
  const MeshShape &mesh = std::get<MeshShape>(a.geometry), &other = std::get<MeshShape>(b.geometry);
  return mesh.mesh == other.mesh && mesh.solid == other.solid && mesh.convex == other.convex;
}

/// The geometry of a body, taken over where it is known.
BodyGeometry body_of(const Body& body, const std::vector<BodyGeometry>& known) {
  for (const BodyGeometry& geometry : known) {
    if (geometry.name == body.name &&
        std::equal(body.shapes.begin(), body.shapes.end(), geometry.shapes.begin(),
                   geometry.shapes.end(), are_same)) {
      return geometry;
    }
  }
  return make_body(body.name, body.shapes);
}

void find_depths(CollisionModel::Impl& model) {
  const Robot& robot = *model.robot;
  model.depth.assign(robot.bodies.size(), 0);
  model.is_finger.assign(robot.bodies.size(), 0);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    model.depth[static_cast<std::size_t>(robot.joints[j].child)] = static_cast<int>(j) + 1;
  }
  for (const FingerJoint& finger : robot.gripper.fingers) {
    const std::size_t child = static_cast<std::size_t>(finger.child);
    model.depth[child] = model.depth[static_cast<std::size_t>(finger.parent)];
    model.is_finger[child] = 1;
  }
}

bool are_joined(const Robot& robot, int a, int b) {
  const auto joins = [&](int parent, int child) {
    return (parent == a && child == b) || (parent == b && child == a);
  };
  for (const ArmJoint& joint : robot.joints) {
    if (joins(joint.parent, joint.child)) return true;
  }
  for (const FingerJoint& finger : robot.gripper.fingers) {
    if (joins(finger.parent, finger.child)) return true;
  }
  return std::any_of(
      robot.ignored_pairs.begin(), robot.ignored_pairs.end(),
      [&](const std::pair<int, int>& pair) { return joins(pair.first, pair.second); });
}

bool overlap(const BodyGeometry& a, const Pose& X_RA, const BodyGeometry& b, const Pose& X_RB) {
  if ((X_RA * a.centre - X_RB * b.centre).norm() > a.radius + b.radius) return false;
  for (const auto& piece_a : a.pieces) {
    for (const auto& piece_b : b.pieces) {
      if (collision::piece_distance(*piece_a, X_RA, *piece_b, X_RB, 0.0, 0.0) <= 0.0) return true;
    }
  }
  return false;
}

/// Uniform in [0, 1), the same on every machine.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

Configuration random_configuration(const Robot& robot, std::mt19937_64& generator) {
  Configuration configuration;
  configuration.q.resize(static_cast<Eigen::Index>(robot.joints.size()));
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const JointLimit& limit = robot.joints[j].limit;
    const double lower = std::isfinite(limit.lower) ? limit.lower : -kPi;
    const double upper = std::isfinite(limit.upper) ? limit.upper : kPi;
    configuration.q[static_cast<Eigen::Index>(j)] = lower + (upper - lower) * uniform(generator);
  }
  const Gripper& gripper = robot.gripper;
  configuration.opening =
      gripper.min_opening + (gripper.max_opening - gripper.min_opening) * uniform(generator);
  return configuration;
}

/// The pairs that overlap nearly always, of those that overlap at home.
std::vector<std::pair<int, int>> always_overlapping(const CollisionModel::Impl& model,
                                                    std::vector<std::pair<int, int>> candidates) {
  const auto overlaps = [&](const std::vector<Pose>& poses, const std::pair<int, int>& pair) {
    const std::size_t a = static_cast<std::size_t>(pair.first),
                      b = static_cast<std::size_t>(pair.second);
    return overlap(model.robot_bodies[a], poses[a], model.robot_bodies[b], poses[b]);
  };
  const Configuration home{model.robot->home, model.robot->gripper.max_opening};
  const std::vector<Pose> at_home = body_poses(*model.robot, home);
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                  [&](const auto& pair) { return !overlaps(at_home, pair); }),
                   candidates.end());
  std::vector<int> misses(candidates.size(), 0);
  std::mt19937_64 generator(kSeed);
  for (int i = 0; i < kRandomConfigurations && !candidates.empty(); ++i) {
    throw_if_stopped();
    const std::vector<Pose> poses =
        body_poses(*model.robot, random_configuration(*model.robot, generator));
    for (std::size_t k = candidates.size(); k-- > 0;) {
      if (overlaps(poses, candidates[k]) || ++misses[k] <= kMostMisses) continue;
      candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(k));
      misses.erase(misses.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }
  return candidates;
}

void find_self_pairs(CollisionModel::Impl& model) {
  const int count = static_cast<int>(model.robot_bodies.size());
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      const std::size_t ia = static_cast<std::size_t>(a), ib = static_cast<std::size_t>(b);
      const bool rigid =
          model.depth[ia] == model.depth[ib] && !model.is_finger[ia] && !model.is_finger[ib];
      if (!rigid && !are_joined(*model.robot, a, b)) model.self_pairs.emplace_back(a, b);
    }
  }
  const std::vector<std::pair<int, int>> always = always_overlapping(model, model.self_pairs);
  std::vector<std::pair<int, int>>& pairs = model.self_pairs;
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                             [&](const auto& pair) {
                               return std::find(always.begin(), always.end(), pair) != always.end();
                             }),
              pairs.end());
}

}  // namespace

std::shared_ptr<const CollisionModel> make_collision_model(
    const Cell& cell, const std::shared_ptr<const CollisionModel>& known) {
  require_valid(cell);
  std::unique_ptr<CollisionModel::Impl> model = std::make_unique<CollisionModel::Impl>();
  const CollisionModel::Impl none;
  const CollisionModel::Impl& before = known != nullptr ? known->impl() : none;
  if (known != nullptr && before.robot == cell.robot) {
    model->robot = before.robot;
    model->robot_bodies = before.robot_bodies;
    model->self_pairs = before.self_pairs;
    model->depth = before.depth;
    model->is_finger = before.is_finger;
  } else {
    model->robot = cell.robot;
    for (const RobotBody& body : cell.robot->bodies) {
      model->robot_bodies.push_back(make_body(body.name, body.shapes));
    }
    find_depths(*model);
    find_self_pairs(*model);
  }
  for (const Body& body : cell.fixtures) model->fixtures.push_back(body_of(body, before.fixtures));
  for (const Body& body : cell.parts) model->parts.push_back(body_of(body, before.parts));
  return std::make_shared<const CollisionModel>(std::move(model));
}

CollisionModel::CollisionModel(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
CollisionModel::~CollisionModel() = default;

}  // namespace handey
