// A hand with a part in it finds its way out of a pocket that no straight motion leads out of; an
// open hand round a part likewise.
#include "handey/approach/departure.hpp"

#include <cmath>
#include <random>

#include "../../src/approach/hand_with_part.hpp"
#include "../../src/approach/obstacle_layers.hpp"
#include "handey/approach/plane_search.hpp"
#include "handey/approach/retreat.hpp"
#include "handey/collision/box_certificate.hpp"
#include "handey/errors.hpp"
#include "puma_scene.hpp"

namespace handey {
namespace {

using namespace test;

constexpr double kPi = 3.14159265358979323846;
const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

/// The hand over the part, pointing down, closing along x of the world: the grasp plane is upright.
Pose hand_on_part(const Cell& cell) {
  Pose X_WH = Pose::Identity();
  X_WH.linear().col(0) = Eigen::Vector3d::UnitY();
  X_WH.linear().col(1) = Eigen::Vector3d::UnitX();
  X_WH.linear().col(2) = -Eigen::Vector3d::UnitZ();
  X_WH.translation() = cell.parts[0].X_WB.translation();
  return X_WH;
}

/// A long block on the table, 16 mm from a stop before its near end and 10 mm from one behind its
/// far end, a ledge 15 mm over the far end, rails beside it: up, back under no ledge, up again.
Cell block_in_pocket(double far_ledge = 0.03) {
  Cell cell = block_on_table({
      box("near stop", {0.10, 0.01, 0.04}, at(0.5, 0.119, 0.02)),
      box("far stop", {0.10, 0.01, 0.085}, at(0.5, 0.275, 0.0425)),
      box("ledge", {0.10, far_ledge, 0.02}, at(0.5, 0.28 - far_ledge / 2, 0.075)),
      box("left rail", {0.02, 0.10, 0.05}, at(0.446, 0.2, 0.025)),
      box("right rail", {0.02, 0.10, 0.05}, at(0.554, 0.2, 0.025)),
  });
  cell.parts[0].shapes[0].geometry = Box{{0.04, 0.12, 0.05}};
  return cell;
}

/// An L of 120 x 50 mm, 40 mm thick, as one mesh: at its far end it is half as high.
Shape l_shape() {
  TriangleMesh mesh;
  const double x = 0.02;
  const std::vector<Eigen::Vector2d> l = {{-0.06, -0.025}, {0.06, -0.025}, {0.06, 0.0},
                                          {0.03, 0.0},     {0.03, 0.025},  {-0.06, 0.025}};
  for (const double side : {-x, x}) {
    for (const Eigen::Vector2d& p : l) mesh.vertices.emplace_back(side, p.x(), p.y());
  }
  const int n = static_cast<int>(l.size());
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.triangles.emplace_back(j, n + j, n + i);
    mesh.triangles.emplace_back(i, j, n + i);
  }
  for (const Eigen::Vector3i& t : {Eigen::Vector3i(0, 1, 2), Eigen::Vector3i(0, 2, 3),
                                   Eigen::Vector3i(0, 3, 4), Eigen::Vector3i(0, 4, 5)}) {
    mesh.triangles.emplace_back(t[0] + n, t[1] + n, t[2] + n);
    mesh.triangles.emplace_back(t[2], t[1], t[0]);
  }
  return {MeshShape{std::make_shared<const TriangleMesh>(std::move(mesh)), true}, Pose::Identity()};
}

struct HeldPart {
  explicit HeldPart(const Cell& standing)
      : solver(*standing.robot),
        cell(standing.with_held(0, hand_on_part(standing).inverse() * standing.parts[0].X_WB)),
        model(make_collision_model(cell)),
        in_contact(model, cell, {std::nullopt, {{BodyRef::Kind::Fixture, 0}}}),
        clear(model, cell) {
    const Pose X_RH = cell.X_WR.inverse() * hand_on_part(standing);
    for (const InverseSolution& solution : solver.solve(X_RH).solutions) {
      if (in_contact.is_free({solution.q, 0.04})) {
        start = {solution.q, 0.04};
        return;
      }
    }
    ADD_FAILURE() << "no free configuration";
  }

  RetreatResult retreat(const Configuration& from, const Eigen::Vector3d& direction) {
    return plan_retreat(in_contact, clear, solver, from, direction);
  }
  /// Where a lift has left contact.
  Configuration lifted() { return retreat(start, kUp).path.at(1); }
  Eigen::Vector3d moved(const Configuration& from, const Configuration& to) const {
    return hand_in_world(cell, to.q).translation() - hand_in_world(cell, from.q).translation();
  }

  SphericalWristSolver solver;
  Cell cell;
  std::shared_ptr<const CollisionModel> model;
  CollisionChecker in_contact, clear;
  Configuration start;
};

void expect_good(CollisionChecker& checker, const Configuration& start,
                 const DepartureResult& result, const DepartureOptions& options = {}) {
  ASSERT_TRUE(result.found) << result.reason;
  EXPECT_EQ(result.reason, "");
  EXPECT_EQ(result.path.front().q, start.q);
  for (const Configuration& c : result.path) EXPECT_EQ(c.opening, start.opening);
  EXPECT_TRUE(certify_path(checker, result.path).is_free());
  expect_free(checker, result.path);
  // The hand stays in its plane, and goes where the poses say.
  const Pose X_WH = hand_in_world(checker.cell(), start.q);
  for (const Configuration& c : result.path) {
    const Pose X_HN = X_WH.inverse() * hand_in_world(checker.cell(), c.q);
    EXPECT_NEAR(X_HN.translation().y(), 0.0, 1e-6);
    EXPECT_NEAR(X_HN.linear()(1, 1), 1.0, 1e-9);
  }
  const PlanarPose &first = result.poses.front(), &last = result.poses.back();
  EXPECT_NEAR(std::hypot(first.x, first.y), 0.0, 1e-9);
  const Pose X_HN = X_WH.inverse() * hand_in_world(checker.cell(), result.path.back().q);
  EXPECT_NEAR(X_HN.translation().z(), last.x, 1e-6);
  EXPECT_NEAR(X_HN.translation().x(), last.y, 1e-6);
  EXPECT_GE(std::hypot(last.x, last.y), options.least - 1e-9);
  if (!result.has_room) return;
  Eigen::VectorXd half = Eigen::VectorXd::Zero(6);
  half.head<3>().setConstant(options.room);
  EXPECT_TRUE(BoxProver(checker).prove({result.path.back(), half}).free);
}

TEST(PlanDeparture, CarriesAPartOutOfAPocketThatNoStraightLeadsOutOf) {
  HeldPart part(block_in_pocket());
  const RetreatResult up = part.retreat(part.start, kUp);
  EXPECT_FALSE(up.found);
  EXPECT_NE(up.reason.find("ledge"), std::string::npos) << up.reason;
  ASSERT_GT(up.path.size(), 2u);
  for (const Configuration& from : {up.path[1], up.path.back()}) {
    for (int eighth = 0; eighth < 8; ++eighth) {
      const double angle = eighth * kPi / 4.0;
      const Eigen::Vector3d level(std::cos(angle), std::sin(angle), 0.0);
      EXPECT_FALSE(part.retreat(from, level).found) << eighth;
    }
  }
  DepartureOptions options;
  for (const int slides : {3, 0}) {
    options.most_slides = slides;
    const DepartureResult way = plan_departure(part.clear, part.solver, part.lifted(), options);
    expect_good(part.clear, part.lifted(), way, options);
    EXPECT_TRUE(way.has_room);
    EXPECT_EQ(way.planner,
              slides > 0 ? ApproachPlanner::Quasipotential : ApproachPlanner::PlaneSearch);
  }
}

TEST(PlanDeparture, CountsThePartToTheHand) {
  // A lid over both ends of the part, open in the middle where the hand came in.
  Cell cell = block_in_pocket();
  cell.fixtures.push_back(box("near ledge", {0.10, 0.03, 0.02}, at(0.5, 0.129, 0.075)));
  HeldPart part(cell);
  const DepartureResult held = plan_departure(part.clear, part.solver, part.lifted());
  EXPECT_FALSE(held.found);
  EXPECT_TRUE(held.path.empty());
  EXPECT_EQ(held.planner, ApproachPlanner::PlaneSearch);
  EXPECT_FALSE(held.reason.empty());
  EXPECT_NE(held.reason.find("held block meets"), std::string::npos) << held.reason;
  // The same hand without the part goes straight up.
  const Cell without = cell.with_part_at(0, at(0.3, -0.4, 0.025));
  CollisionChecker empty(part.model, without);
  expect_good(empty, part.lifted(), plan_departure(empty, part.solver, part.lifted()));
}

TEST(PlanDeparture, DrawsTheOpenHandOutFromUnderALid) {
  // Over the palm there is a lid, beside the block there is room: level out, then up.
  Cell cell = block_on_table({
      box("lid", {0.3, 0.20, 0.02}, at(0.5, 0.20, 0.40)),
  });
  cell.fixtures.push_back(box("stand", {0.06, 0.06, 0.20}, at(0.5, 0.2, 0.10)));
  cell.parts[0].X_WB = at(0.5, 0.2, 0.225);
  const SphericalWristSolver solver(*cell.robot);
  CollisionChecker checker(make_collision_model(cell), cell);
  // The hand comes level along y: x of the hand is upright, and so is the plane.
  Pose X_WH = Pose::Identity();
  X_WH.linear().col(2) = Eigen::Vector3d::UnitY();
  X_WH.linear().col(1) = Eigen::Vector3d::UnitX();
  X_WH.linear().col(0) = X_WH.linear().col(1).cross(X_WH.linear().col(2));
  X_WH.translation() = cell.parts[0].X_WB.translation();
  for (const InverseSolution& solution : solver.solve(cell.X_WR.inverse() * X_WH).solutions) {
    const Configuration start{solution.q, 0.056};
    if (!checker.is_free(start)) continue;
    EXPECT_FALSE(plan_retreat(checker, checker, solver, start, -kUp).found);  // the stand
    DepartureOptions options;
    options.most_slides = 0;
    const DepartureResult way = plan_departure(checker, solver, start, options);
    expect_good(checker, start, way, options);
    EXPECT_EQ(way.planner, ApproachPlanner::PlaneSearch);
    return;
  }
  FAIL() << "no free configuration";
}

TEST(PlanDeparture, CarriesAPartThatIsNotConvexAndGivesTheSameWayTwice) {
  // An L of two bars as one mesh: its notch is free, so the pocket's ledge may reach into it.
  Cell cell = block_in_pocket();
  cell.parts[0].shapes = {l_shape()};
  HeldPart part(cell);
  DepartureOptions options;
  options.most_slides = 0;
  const DepartureResult way = plan_departure(part.clear, part.solver, part.lifted(), options);
  expect_good(part.clear, part.lifted(), way, options);
  const DepartureResult again = plan_departure(part.clear, part.solver, part.lifted(), options);
  ASSERT_EQ(way.path.size(), again.path.size());
  for (std::size_t i = 0; i < way.path.size(); ++i) EXPECT_EQ(way.path[i].q, again.path[i].q);
}

/// Hand and part among random boxes: what the lattice says of each pose, and what the checker says.
TEST(HandWithPart, MasksOnlyWhatCollidesAndFreesOnlyWhatDoesNot) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> away(-0.09, 0.09), size(0.01, 0.05);
  std::uniform_int_distribution<int> cells(-14, 14), turns(0, 35);
  int masked = 0, free = 0;
  for (int round = 0; round < 6; ++round) {
    std::vector<Body> boxes;
    for (int n = 0; n < 8; ++n) {
      const Pose X_WB =
          at(0.5 + away(random), 0.2 + away(random), 0.5 + away(random), away(random));
      boxes.push_back(
          box("box " + std::to_string(n), {size(random), size(random), size(random)}, X_WB));
    }
    Cell cell = block_on_table(boxes);
    cell.parts[0].shapes = {l_shape()};
    if (round % 2 == 1) cell.parts[0].shapes = {{Cylinder{0.02, 0.09}, Pose::Identity()}};
    // The part lies in the hand a little aslant.
    const Pose X_HP = pose_from_xyz_rpy({0.003, 0.002, 0.01}, {0.3, 0.1 * round, 1.5});
    const Cell held = cell.with_held(0, X_HP);
    CollisionChecker checker(make_collision_model(held), held);
    const SphericalWristSolver solver(*held.robot);
    Pose X_WH = hand_on_part(cell);
    X_WH.translation() = Eigen::Vector3d(0.5, 0.2, 0.5);
    const Pose X_WG = X_WH * hand_in_plane({}, false).inverse();

    const GripperOutline gripper = gripper_outline(*held.robot, 0.04, false);
    const GripperOutline outline = outline_with_part(gripper, held);
    const GripperOutline core = core_with_part(gripper, checker);
    EXPECT_GT(outline.pieces.size(), gripper.pieces.size());
    EXPECT_GT(core.pieces.size(), gripper.pieces.size()) << "round " << round;
    const ObstacleLayers around(held, outline, X_WG, {0, 0}, 0.35);
    const ObstacleLayers within(held, core, X_WG, {0, 0}, 0.35);
    PlaneSearchOptions options;
    options.directions = 36;
    const PlaneSearch plane(around.draw(0.004), outline, within.draw_inside(0.004), core, {}, 0.06,
                            options);
    for (int trial = 0; trial < 400; ++trial) {
      const LatticePoint point{cells(random), cells(random), turns(random)};
      const Pose X_RH = held.X_WR.inverse() * X_WG * hand_in_plane(plane.pose(point), false);
      for (const InverseSolution& solution : solver.solve(X_RH).solutions) {
        const std::optional<Hit> hit = checker.find_hit({solution.q, 0.04}, 0.0);
        const bool by_hand = hit && (hit->a.rfind("held", 0) == 0 || hit->a == "left_finger" ||
                                     hit->a == "right_finger");
        if (plane.is_blocked(point)) {
          ++masked;
          EXPECT_TRUE(hit.has_value()) << "round " << round;
        } else if (plane.is_free(point)) {
          ++free;
          EXPECT_FALSE(by_hand && hit->b.rfind("box", 0) == 0) << hit->a << " " << hit->b;
        }
      }
    }
  }
  EXPECT_GT(masked, 1000);
  EXPECT_GT(free, 300);
}

TEST(PlanDeparture, RefusesWrongInput) {
  HeldPart part(block_in_pocket());
  const Configuration lifted = part.lifted();
  EXPECT_THROW(plan_departure(part.clear, part.solver, part.start), InvalidInput);  // in contact
  const auto with = [&](const DepartureOptions& options) {
    return plan_departure(part.clear, part.solver, lifted, options);
  };
  DepartureOptions options;
  options.least = 0.2;
  EXPECT_THROW(with(options), InvalidInput);
  options = {};
  options.cell = 0.005;
  EXPECT_THROW(with(options), InvalidInput);
  options = {};
  options.search_levels = 4;
  EXPECT_THROW(with(options), InvalidInput);
  options = {};
  options.room = -0.1;
  EXPECT_THROW(with(options), InvalidInput);
  Configuration short_of{lifted.q.head(5), lifted.opening};
  EXPECT_THROW(plan_departure(part.clear, part.solver, short_of), InvalidInput);
}

}  // namespace
}  // namespace handey
