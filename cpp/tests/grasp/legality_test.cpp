// Legal grasps of the Puma: every pose found is tested again by forward kinematics, by a checker of
// its own and by areas; poses that must not be found are looked for by hand.
#include "handey/grasp/legality.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "../kinematics/puma.hpp"
#include "handey/errors.hpp"
#include "handey/stop.hpp"
#include "parts.hpp"

namespace handey {
namespace {

using testing::box_body;
using testing::puma;
using testing::translation;

Cell puma_bench() {
  Cell cell;
  cell.name = "bench";
  cell.robot = puma();
  cell.fixtures.push_back(box_body("table", {1.6, 1.4, 0.05}, translation(0.55, 0, -0.025)));
  cell.start = {puma()->home, 0.1};
  return cell;
}

GraspScene make_scene(Cell cell, const Pose& X_WP_goal) {
  return {make_collision_model(cell), cell, 0, X_WP_goal};
}

Cell block_on_table() {
  Cell cell = puma_bench();
  cell.parts.push_back(box_body("block", {0.04, 0.06, 0.05}, translation(0.50, 0.20, 0.025)));
  return cell;
}

// What is promised of a legal pose, tested without the room.
void expect_legal(const GraspScene& scene, const RankedPair& pair, const GraspPose& pose,
                  const LegalityOptions& options = {}) {
  const Robot& robot = *scene.cell.robot;
  EXPECT_TRUE(
      pose.X_PH.isApprox(pair.pair.X_PG * hand_in_plane(pose.in_plane, pose.flipped), 1e-12));
  EXPECT_GE(pose.opening, pose.width + 2 * 0.002 - 1e-9);
  EXPECT_LE(pose.opening, robot.gripper.max_opening);
  EXPECT_GE(pose.contact_area, 30e-6);
  EXPECT_NEAR(pose.contact_area, pad_contact_area(pair.unobstructed, pose.in_plane, robot.gripper),
              1e-12);
  ASSERT_FALSE(pose.q_pick.empty());
  ASSERT_FALSE(pose.q_place.empty());
  Allowance closed;
  closed.closed_on = scene.part;
  for (const bool at_goal : {false, true}) {
    const Cell cell = at_goal ? scene.cell.with_part_at(scene.part, scene.X_WP_goal) : scene.cell;
    const Pose X_WH = cell.parts[static_cast<std::size_t>(scene.part)].X_WB * pose.X_PH;
    CollisionChecker open_hand(scene.model, cell), closed_hand(scene.model, cell, closed);
    for (const Eigen::VectorXd& q : at_goal ? pose.q_place : pose.q_pick) {
      EXPECT_TRUE(hand_in_world(cell, q).isApprox(X_WH, 1e-7));
      EXPECT_EQ(limit_violation(robot, q), "");
      EXPECT_TRUE(open_hand.is_free({q, pose.opening}, options.clearance));
      EXPECT_TRUE(closed_hand.is_free({q, pose.width}, options.clearance));
    }
  }
}

TEST(LegalGrasps, OfABlockOnATableAreManyAndLegal) {
  const GraspScene scene = make_scene(block_on_table(), translation(0.45, -0.25, 0.025));
  const SphericalWristSolver solver(*puma());
  RankingOptions two_faces;
  two_faces.pairs = PairChoice::TwoFaces;
  for (const RankedPair& pair : rank_grasps(scene.cell, 0, scene.X_WP_goal, two_faces).ranked) {
    const LegalGrasps legal = find_legal_grasps(scene, solver, pair);
    EXPECT_EQ(legal.poses.size(), 16u);
    for (const GraspPose& pose : legal.poses) expect_legal(scene, pair, pose);
    EXPECT_TRUE(
        std::is_sorted(legal.poses.begin(), legal.poses.end(),
                       [](const auto& a, const auto& b) { return a.merit > b.merit + 1e-9; }));
    EXPECT_EQ(legal.tried, static_cast<int>(legal.poses.size()) + legal.too_little_contact +
                               legal.would_turn + legal.unreachable_at_origin +
                               legal.unreachable_at_destination + legal.collides_at_origin +
                               legal.collides_at_destination);
    EXPECT_GT(legal.poses.front().merit, 0.5);
    EXPECT_LE(legal.poses.front().merit, 1.0);
  }
}

TEST(LegalGrasps, AreTheSameEveryTime) {
  const GraspScene scene = make_scene(block_on_table(), translation(0.45, -0.25, 0.025));
  const SphericalWristSolver solver(*puma());
  const RankedPair pair = rank_grasps(scene.cell, 0, scene.X_WP_goal).ranked.at(0);
  const LegalGrasps a = find_legal_grasps(scene, solver, pair);
  const LegalGrasps b = find_legal_grasps(scene, solver, pair);
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_EQ(a.poses[i].X_PH.matrix(), b.poses[i].X_PH.matrix());
    EXPECT_EQ(a.poses[i].q_pick, b.poses[i].q_pick);
  }
}

std::set<std::string> keys(const std::vector<GraspPose>& poses) {
  std::set<std::string> keys;
  for (const GraspPose& pose : poses) {
    std::ostringstream key;
    key << pose.in_plane.x << ' ' << pose.in_plane.y << ' ' << pose.in_plane.theta << ' '
        << pose.flipped;
    keys.insert(key.str());
  }
  return keys;
}

TEST(LegalGraspSearch, FindsInPortionsWhatIsFoundAtOnce) {
  const GraspScene scene = make_scene(block_on_table(), translation(0.45, -0.25, 0.025));
  const SphericalWristSolver solver(*puma());
  const RankedPair pair = rank_grasps(scene.cell, 0, scene.X_WP_goal).ranked.at(0);
  for (const bool spread : {false, true}) {
    LegalityOptions options;
    options.most_poses = 100000;
    options.spread = spread;
    LegalGraspSearch search(scene, solver, pair, options);
    std::vector<GraspPose> found;
    int portions = 0;
    for (; !search.is_done(); ++portions) {
      for (const GraspPose& pose : search.next(7)) found.push_back(pose);
    }
    const LegalGrasps at_once = find_legal_grasps(scene, solver, pair, options);
    EXPECT_GT(portions, 5);
    EXPECT_EQ(keys(found), keys(at_once.poses));
    EXPECT_EQ(search.result().tried, at_once.tried);
    EXPECT_EQ(search.result().worst_reason, at_once.worst_reason);
  }
}

TEST(LegalGraspSearch, GoesOnWhereItWasStopped) {
  const GraspScene scene = make_scene(block_on_table(), translation(0.45, -0.25, 0.025));
  const SphericalWristSolver solver(*puma());
  const RankedPair pair = rank_grasps(scene.cell, 0, scene.X_WP_goal).ranked.at(0);
  for (const bool spread : {false, true}) {
    LegalityOptions options;
    options.most_poses = 100000;
    options.spread = spread;
    LegalGraspSearch search(scene, solver, pair, options);
    std::vector<GraspPose> found;
    int stops = 0, looks = 0;
    while (!search.is_done()) {
      CancelToken token;
      StopHooks hooks;
      hooks.between_polls = std::chrono::milliseconds(0);
      int left = 1 + 37 * stops % 211;  // never the same place of the loop
      hooks.poll = [&] {
        ++looks;
        if (--left == 0) token.cancel();
      };
      const StopScope scope(token, hooks);
      try {
        for (const GraspPose& pose : search.next(50)) found.push_back(pose);
      } catch (const Stopped&) {
        ++stops;
      }
    }
    const LegalGrasps at_once = find_legal_grasps(scene, solver, pair, options);
    const LegalGrasps result = search.result();
    EXPECT_GT(stops, 10) << looks;
    EXPECT_EQ(keys(found), keys(at_once.poses));
    EXPECT_EQ(keys(result.poses), keys(at_once.poses));
    EXPECT_EQ(found.size(), at_once.poses.size()) << "none is told twice";
    EXPECT_EQ(result.tried, at_once.tried);
    EXPECT_EQ(result.collides_at_origin, at_once.collides_at_origin);
    EXPECT_EQ(result.too_little_contact, at_once.too_little_contact);
    EXPECT_EQ(result.worst_reason, at_once.worst_reason);
  }
}

TEST(LegalGraspSearch, SpreadLooksAtUnpromisingCandidatesToo) {
  const GraspScene scene = make_scene(block_on_table(), translation(0.45, -0.25, 0.025));
  const SphericalWristSolver solver(*puma());
  const RankedPair pair = rank_grasps(scene.cell, 0, scene.X_WP_goal).ranked.at(0);
  LegalityOptions options;
  options.most_poses = 100000;
  const LegalGrasps all = find_legal_grasps(scene, solver, pair, options);
  const auto worst_of_first = [&](bool spread) {
    options.spread = spread;
    LegalGraspSearch search(scene, solver, pair, options);
    std::vector<GraspPose> found;
    while (found.size() < all.poses.size() / 8) {
      for (GraspPose& pose : search.next(1)) found.push_back(std::move(pose));
    }
    double worst = 1.0;
    for (const GraspPose& pose : found) worst = std::min(worst, pose.merit);
    return worst;
  };
  EXPECT_LT(worst_of_first(true), worst_of_first(false));
}

TEST(LegalGrasps, DrawThePadsBackWhereTheTipsWouldHitTheTable) {
  // 20 mm high: with the pads' centres at half height the tips, 15 mm beyond, would be in the
  // table.
  Cell cell = puma_bench();
  cell.parts.push_back(box_body("slab", {0.06, 0.04, 0.02}, translation(0.50, 0.20, 0.010)));
  const GraspScene scene = make_scene(cell, translation(0.45, -0.25, 0.010));
  const SphericalWristSolver solver(*puma());
  const RankedPair pair = rank_grasps(cell, 0, scene.X_WP_goal).ranked.at(0);
  const LegalGrasps legal = find_legal_grasps(scene, solver, pair);
  ASSERT_FALSE(legal.poses.empty()) << legal.worst_reason;
  for (const GraspPose& pose : legal.poses) expect_legal(scene, pair, pose);
}

TEST(LegalGrasps, NameTheWallThatTheHandHitsAtTheDestination) {
  // Walls 20 mm from the wide faces at the destination, too near for fingers 8 mm open and higher
  // than the palm.
  Cell cell = block_on_table();
  cell.fixtures.push_back(box_body("left", {0.02, 0.3, 0.4}, translation(0.42, -0.25, 0.2)));
  cell.fixtures.push_back(
      box_body("right", {0.02, 0.3, 0.4}, translation(0.48 + 0.02, -0.25, 0.2)));
  const GraspScene scene = make_scene(cell, translation(0.46, -0.25, 0.025));
  const SphericalWristSolver solver(*puma());
  RankingOptions origin_only;
  origin_only.use_destination = false;
  for (const RankedPair& pair : rank_grasps(cell, 0, scene.X_WP_goal, origin_only).ranked) {
    const LegalGrasps legal = find_legal_grasps(scene, solver, pair);
    EXPECT_TRUE(legal.poses.empty());
    EXPECT_GT(legal.collides_at_destination, 0);
    EXPECT_NE(legal.worst_reason, "");
  }
}

TEST(LegalGrasps, SayWhenTheDestinationIsOutOfReach) {
  const GraspScene scene = make_scene(block_on_table(), translation(2.0, 0.0, 0.025));
  const SphericalWristSolver solver(*puma());
  const RankedPair pair = rank_grasps(scene.cell, 0, scene.X_WP_goal).ranked.at(0);
  const LegalGrasps legal = find_legal_grasps(scene, solver, pair);
  EXPECT_TRUE(legal.poses.empty());
  EXPECT_GT(legal.unreachable_at_destination, 20);
  EXPECT_EQ(legal.collides_at_destination, 0);
  EXPECT_NE(legal.worst_reason.find("(destination)"), std::string::npos) << legal.worst_reason;
}

// By how many of a kind candidates fell at an end.
int fallen(const LegalGrasps& legal, GraspEnd end, FallKind kind) {
  int count = 0;
  for (const Fallen& one : legal.fallen) {
    if (one.end == end && one.kind == kind) count += one.count;
  }
  return count;
}

TEST(LegalGrasps, TellWhatEveryCandidateFellBy) {
  Cell cell = block_on_table();
  cell.fixtures.push_back(box_body("roof", {0.4, 0.4, 0.02}, translation(0.45, -0.25, 0.09)));
  const GraspScene scene = make_scene(cell, translation(0.45, -0.25, 0.025));
  const SphericalWristSolver solver(*puma());
  int under_the_roof = 0;
  for (const RankedPair& pair : rank_grasps(cell, 0, scene.X_WP_goal).ranked) {
    const LegalGrasps legal = find_legal_grasps(scene, solver, pair);
    const GraspEnd origin = GraspEnd::Origin, destination = GraspEnd::Destination;
    EXPECT_EQ(fallen(legal, GraspEnd::Both, FallKind::LittleContact), legal.too_little_contact);
    EXPECT_EQ(fallen(legal, GraspEnd::Both, FallKind::Turns), legal.would_turn);
    EXPECT_EQ(
        fallen(legal, origin, FallKind::OutOfReach) + fallen(legal, origin, FallKind::JointLimit),
        legal.unreachable_at_origin);
    EXPECT_EQ(fallen(legal, destination, FallKind::OutOfReach) +
                  fallen(legal, destination, FallKind::JointLimit),
              legal.unreachable_at_destination);
    EXPECT_EQ(fallen(legal, origin, FallKind::Collision), legal.collides_at_origin);
    EXPECT_EQ(fallen(legal, destination, FallKind::Collision), legal.collides_at_destination);
    EXPECT_TRUE(std::is_sorted(legal.fallen.begin(), legal.fallen.end(),
                               [](const auto& a, const auto& b) { return a.count > b.count; }));
    for (const Fallen& one : legal.fallen) {
      EXPECT_NE(one.text, "");
      EXPECT_EQ(one.joint >= 0, one.kind == FallKind::JointLimit) << one.text;
      EXPECT_EQ(one.body.empty(), one.kind != FallKind::Collision) << one.text;
      if (one.body == "roof" && one.mover == "hand") under_the_roof += one.count;
    }
  }
  EXPECT_GT(under_the_roof, 0);
}

// The nearest miss that is told is one: asked again, that pose misses by so much.
TEST(LegalGrasps, TellTheNearestMissOfEachJoint) {
  const GraspScene scene = make_scene(block_on_table(), translation(0.45, -0.25, 0.025));
  const SphericalWristSolver solver(*puma());
  const RankedPair pair = rank_grasps(scene.cell, 0, scene.X_WP_goal).ranked.at(0);
  LegalityOptions options;
  options.most_poses = 100000;
  int limited = 0;
  for (const Fallen& one : find_legal_grasps(scene, solver, pair, options).fallen) {
    if (one.kind != FallKind::JointLimit && one.kind != FallKind::OutOfReach) continue;
    ASSERT_NE(one.end, GraspEnd::Both);
    const Pose& X_WP = one.end == GraspEnd::Origin ? scene.cell.parts[0].X_WB : scene.X_WP_goal;
    const InverseResult inverse = solver.solve(scene.cell.X_WR.inverse() * X_WP * one.X_PH);
    EXPECT_TRUE(inverse.solutions.empty());
    EXPECT_EQ(inverse.joint, one.joint);
    EXPECT_NEAR(inverse.excess, one.least.value(), 1e-12);
    limited += one.kind == FallKind::JointLimit ? 1 : 0;
  }
  EXPECT_GT(limited, 0);
}

TEST(LegalGrasps, TellAPartThatSlipsFromOneThatTurns) {
  Cell cell = block_on_table();
  cell.parts[0].mass = 30.0;
  const GraspScene scene = make_scene(cell, translation(0.45, -0.25, 0.025));
  const RankedPair pair = rank_grasps(cell, 0, scene.X_WP_goal).ranked.at(0);
  const LegalGrasps legal = find_legal_grasps(scene, SphericalWristSolver(*puma()), pair);
  EXPECT_EQ(fallen(legal, GraspEnd::Both, FallKind::Turns), 0);
  EXPECT_EQ(fallen(legal, GraspEnd::Both, FallKind::Slips), legal.would_turn);
  EXPECT_GT(legal.would_turn, 0);
}

TEST(LegalGrasps, KeepThePadsOffARib) {
  Cell cell = puma_bench();
  Body part;
  part.name = "ribbed";
  part.X_WB = translation(0.50, 0.20, 0.03);
  part.shapes.push_back({Box{{0.03, 0.08, 0.06}}, Pose::Identity()});
  part.shapes.push_back({Box{{0.004, 0.006, 0.06}}, translation(0.017, 0.0, 0.0)});
  cell.parts.push_back(part);
  const GraspScene scene = make_scene(cell, translation(0.45, -0.25, 0.03));
  const SphericalWristSolver solver(*puma());
  int found = 0;
  for (const RankedPair& pair : rank_grasps(cell, 0, scene.X_WP_goal).ranked) {
    if (std::abs(pair.pair.width - 0.03) > 1e-9) continue;
    for (const GraspPose& pose : find_legal_grasps(scene, solver, pair).poses) {
      expect_legal(scene, pair, pose);
      ++found;
      // Corners and middle of the pad's edges in the part: none over the rib.
      for (const double x : {-0.01, -0.005, 0.0, 0.005, 0.01}) {
        for (const double z : {-0.015, -0.0075, 0.0, 0.0075, 0.015}) {
          const Eigen::Vector3d at = pose.X_PH * Eigen::Vector3d(x, 0.0, z);
          EXPECT_FALSE(std::abs(at.y()) < 0.003 && std::abs(at.z()) < 0.03)
              << "pad over the rib at " << at.transpose();
        }
      }
    }
  }
  EXPECT_GT(found, 0);
}

TEST(GraspPoseTest, AgreesWithTheSearch) {
  const GraspScene scene = make_scene(block_on_table(), translation(0.45, -0.25, 0.025));
  const SphericalWristSolver solver(*puma());
  const RankedPair pair = rank_grasps(scene.cell, 0, scene.X_WP_goal).ranked.at(0);
  for (const GraspPose& pose : find_legal_grasps(scene, solver, pair).poses) {
    const LegalGrasps again = test_grasp_pose(scene, solver, pair, pose.in_plane, pose.flipped);
    ASSERT_EQ(again.poses.size(), 1u);
    EXPECT_EQ(again.poses[0].X_PH.matrix(), pose.X_PH.matrix());
    EXPECT_NEAR(again.poses[0].merit, pose.merit, 1e-12);
    EXPECT_EQ(again.poses[0].q_pick.size(), pose.q_pick.size());
  }
}

TEST(GraspPoseTest, SaysWhyAPoseIsNotLegal) {
  const GraspScene scene = make_scene(block_on_table(), translation(0.45, -0.25, 0.025));
  const SphericalWristSolver solver(*puma());
  const RankedPair pair = rank_grasps(scene.cell, 0, scene.X_WP_goal).ranked.at(0);
  const LegalGrasps beside = test_grasp_pose(scene, solver, pair, {0.2, 0.2, 0.0}, false);
  EXPECT_EQ(beside.too_little_contact, 1);
  EXPECT_NE(beside.worst_reason.find("0.0 mm2"), std::string::npos) << beside.worst_reason;
  // From below, through the table.
  const Eigen::Vector3d up_in_G = pair.pair.X_PG.linear().transpose() * Eigen::Vector3d::UnitZ();
  const PlanarPose from_below{0.0, 0.0, std::atan2(up_in_G.y(), up_in_G.x())};
  const LegalGrasps below = test_grasp_pose(scene, solver, pair, from_below, false);
  EXPECT_TRUE(below.poses.empty());
  EXPECT_EQ(below.collides_at_origin + below.unreachable_at_origin +
                below.unreachable_at_destination + below.collides_at_destination,
            1)
      << below.worst_reason;
}

TEST(GraspPoseTest, RefusesBadInputs) {
  const GraspScene scene = make_scene(block_on_table(), translation(0.45, -0.25, 0.025));
  const SphericalWristSolver solver(*puma());
  const RankedPair pair = rank_grasps(scene.cell, 0, scene.X_WP_goal).ranked.at(0);
  EXPECT_THROW(test_grasp_pose(scene, solver, pair, {std::nan(""), 0.0, 0.0}, false), InvalidInput);
  GraspScene holding = scene;
  holding.cell = scene.cell.with_held(0, Pose::Identity());
  EXPECT_THROW(find_legal_grasps(holding, solver, pair), InvalidInput);
  LegalityOptions options;
  options.most_poses = 0;
  EXPECT_THROW(find_legal_grasps(scene, solver, pair, options), InvalidInput);
}

}  // namespace
}  // namespace handey
