#include "ompl_peer.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <ctime>
#include <stdexcept>

using namespace handey;
namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace benchmark {
namespace {

constexpr double kDegree = 0.017453292519943295;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

using FclGeometry = std::shared_ptr<fcl::CollisionGeometryd>;

FclGeometry convex_geometry(const TriangleMesh& mesh) {
  const auto faces = std::make_shared<std::vector<int>>();
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    faces->insert(faces->end(), {3, triangle(0), triangle(1), triangle(2)});
  }
  return std::make_shared<fcl::Convexd>(
      std::make_shared<const std::vector<Eigen::Vector3d>>(mesh.vertices),
      static_cast<int>(mesh.triangles.size()), faces);
}

FclGeometry surface_geometry(const TriangleMesh& mesh) {
  const auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Triangle> triangles;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    triangles.emplace_back(triangle(0), triangle(1), triangle(2));
  }
  model->beginModel();
  model->addSubModel(mesh.vertices, triangles);
  if (model->endModel() != fcl::BVH_OK) throw std::runtime_error("FCL refuses a mesh");
  return model;
}

struct MakeGeometry {
  FclGeometry operator()(const Box& box) const { return std::make_shared<fcl::Boxd>(box.size); }
  FclGeometry operator()(const Cylinder& cylinder) const {
    return std::make_shared<fcl::Cylinderd>(cylinder.radius, cylinder.length);
  }
  FclGeometry operator()(const Sphere& sphere) const {
    return std::make_shared<fcl::Sphered>(sphere.radius);
  }
  FclGeometry operator()(const MeshShape& mesh) const {
    // Nobody would ask a large mesh; this is not to be counted as the peer's time.
    const bool convex = mesh.mesh->triangles.size() < 1000 && is_convex(*mesh.mesh);
    return convex ? convex_geometry(*mesh.mesh) : surface_geometry(*mesh.mesh);
  }
};

std::unique_ptr<fcl::CollisionObjectd> make_object(const FclGeometry& geometry, const Pose& X_RS) {
  auto object = std::make_unique<fcl::CollisionObjectd>(geometry);
  object->setTransform(X_RS);
  object->computeAABB();
  return object;
}

bool do_collide(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b) {
  fcl::CollisionRequestd request;
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::CollisionResultd result;
  return fcl::collide(a, b, request, result) > 0;
}

bool stop_at_hit(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* found) {
  return *static_cast<bool*>(found) = do_collide(a, b);
}

}  // namespace

struct PeerRobot::Impl {
  std::vector<std::vector<FclGeometry>> bodies;
  std::vector<std::pair<int, int>> self_pairs;
};

PeerRobot::PeerRobot(const Robot& robot, std::vector<std::pair<int, int>> self_pairs) {
  auto impl = std::make_unique<Impl>();
  impl->self_pairs = std::move(self_pairs);
  for (const RobotBody& body : robot.bodies) {
    impl->bodies.emplace_back();
    for (const Shape& shape : body.shapes) {
      impl->bodies.back().push_back(std::visit(MakeGeometry(), shape.geometry));
    }
  }
  impl_ = std::move(impl);
}
PeerRobot::~PeerRobot() = default;
PeerRobot::PeerRobot(PeerRobot&&) noexcept = default;

struct OmplPeer::Impl {
  struct RobotPiece {
    std::unique_ptr<fcl::CollisionObjectd> object;
    Pose X_BS;
  };
  const Cell& cell;
  std::vector<std::vector<RobotPiece>> bodies;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> obstacles;
  fcl::DynamicAABBTreeCollisionManagerd tree;
  const std::vector<std::pair<int, int>>& self_pairs;
  std::vector<Pose> poses;

  Impl(const Cell& in, const PeerRobot::Impl& robot) : cell(in), self_pairs(robot.self_pairs) {
    for (std::size_t i = 0; i < robot.bodies.size(); ++i) {
      bodies.emplace_back();
      for (std::size_t k = 0; k < robot.bodies[i].size(); ++k) {
        bodies.back().push_back({make_object(robot.bodies[i][k], Pose::Identity()),
                                 cell.robot->bodies[i].shapes[k].X_BS});
      }
    }
    for (const Body& body : cell.fixtures) {
      for (const Shape& shape : body.shapes) {
        obstacles.push_back(make_object(std::visit(MakeGeometry(), shape.geometry),
                                        cell.X_WR.inverse() * body.X_WB * shape.X_BS));
        tree.registerObject(obstacles.back().get());
      }
    }
    tree.setup();
  }

  void place(const Configuration& configuration) {
    body_poses(*cell.robot, configuration, poses);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (RobotPiece& piece : bodies[i]) {
        piece.object->setTransform(poses[i] * piece.X_BS);
        piece.object->computeAABB();
      }
    }
  }

  bool is_free(const Configuration& configuration) {
    place(configuration);
    for (std::size_t i = bodies.size(); i-- > 1;) {  // the hand first; the base never moves
      for (RobotPiece& piece : bodies[i]) {
        bool hit = false;
        tree.collide(piece.object.get(), &hit, stop_at_hit);
        if (hit) return false;
      }
    }
    for (const auto& pair : self_pairs) {
      for (RobotPiece& a : bodies[static_cast<std::size_t>(pair.first)]) {
        for (RobotPiece& b : bodies[static_cast<std::size_t>(pair.second)]) {
          if (!a.object->getAABB().overlap(b.object->getAABB())) continue;
          if (do_collide(a.object.get(), b.object.get())) return false;
        }
      }
    }
    return true;
  }
};

OmplPeer::OmplPeer(const Cell& cell, const PeerRobot& robot)
    : impl_(std::make_unique<Impl>(cell, *robot.impl_)) {}
OmplPeer::~OmplPeer() = default;

void OmplPeer::seed(std::uint64_t seed) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(seed + 1));  // 0 would mean the clock
}

bool OmplPeer::is_free(const Configuration& configuration) { return impl_->is_free(configuration); }

PeerResult OmplPeer::plan(const Configuration& start, const Configuration& goal, double limit) {
  const double begin = cpu_seconds();
  const Robot& robot = *impl_->cell.robot;
  const unsigned joints = static_cast<unsigned>(robot.joints.size());
  const auto space = std::make_shared<ob::RealVectorStateSpace>(joints);
  ob::RealVectorBounds bounds(joints);
  for (unsigned j = 0; j < joints; ++j) {
    bounds.setLow(j, robot.joints[j].limit.lower);
    bounds.setHigh(j, robot.joints[j].limit.upper);
  }
  space->setBounds(bounds);
  og::SimpleSetup setup(space);
  Configuration asked = start;
  const auto read = [&asked, joints](const ob::State* state) -> const Configuration& {
    const double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
    for (unsigned j = 0; j < joints; ++j) asked.q(j) = values[j];
    return asked;
  };
  setup.setStateValidityChecker(
      [this, &read](const ob::State* state) { return impl_->is_free(read(state)); });
  setup.getSpaceInformation()->setStateValidityCheckingResolution(kDegree /
                                                                  space->getMaximumExtent());
  ob::ScopedState<ob::RealVectorStateSpace> from(space), to(space);
  for (unsigned j = 0; j < joints; ++j) {
    from[j] = start.q(j);
    to[j] = goal.q(j);
  }
  setup.setStartAndGoalStates(from, to);
  setup.setPlanner(std::make_shared<og::RRTConnect>(setup.getSpaceInformation()));
  const ob::PlannerTerminationCondition stop(
      [begin, limit] { return cpu_seconds() - begin > limit; });
  const ob::PlannerStatus status = setup.solve(stop);
  PeerResult result;
  const double solved = cpu_seconds();
  result.planning = solved - begin;
  if (status != ob::PlannerStatus::EXACT_SOLUTION) return result;
  setup.simplifySolution();
  result.simplifying = cpu_seconds() - solved;
  for (const ob::State* state : setup.getSolutionPath().getStates()) {
    result.path.push_back(read(state));
  }
  return result;
}

}  // namespace benchmark
