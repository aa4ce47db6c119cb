// Destination obstacles seen from the part: the article's Figure 4 by hand, and the frame equation
// as a property.
#include "handey/grasp/backproject.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "handey/errors.hpp"
#include "parts.hpp"

namespace handey {
namespace {

using testing::box_body;
using testing::translation;

Cell bench() {
  Cell cell = testing::jaw_cell();
  cell.fixtures.push_back(box_body("table", {2.0, 2.0, 0.05}, translation(0, 0, -0.025)));
  cell.fixtures.push_back(box_body("post", {0.02, 0.02, 0.2}, translation(0.55, 0.1, 0.1)));
  cell.parts.push_back(box_body("block", {0.04, 0.06, 0.03}, translation(0, 0, 0.015)));
  cell.parts.push_back(box_body("other", {0.02, 0.02, 0.02}, translation(0.05, 0, 0.01)));
  return cell;
}

TEST(NearbyBodies, AreThoseWithinReachAtEitherEnd) {
  const std::vector<NearbyBody> nearby =
      nearby_bodies(bench(), 0, translation(0.5, 0.1, 0.015), 0.1);
  std::vector<std::string> names;
  for (const NearbyBody& near : nearby) {
    names.push_back(near.name + (near.at_destination ? " d" : " o"));
  }
  EXPECT_EQ(names, (std::vector<std::string>{"table o", "other o", "table d", "post d"}));
}

TEST(NearbyBodies, StandWhereTheyStandInTheWorld) {
  const Cell cell = bench();
  const Pose goal = pose_from_xyz_rpy({0.5, 0.1, 0.3}, {0.4, 0.5, 2.0});
  for (const NearbyBody& near : nearby_bodies(cell, 0, goal, 10.0)) {
    const Pose X_WP = near.at_destination ? goal : cell.parts[0].X_WB;
    EXPECT_TRUE((X_WP * near.X_PB).isApprox(cell.body(near.body).X_WB, 1e-12));
  }
}

TEST(NearbyBodies, AtTheDestinationAreMovedByTheInverseOfT) {
  const Cell cell = bench();
  const Pose goal = pose_from_xyz_rpy({0.5, 0.1, 0.3}, {0.0, 0.0, M_PI / 2});
  const Pose T = goal * cell.parts[0].X_WB.inverse();
  for (const NearbyBody& near : nearby_bodies(cell, 0, goal, 10.0)) {
    if (!near.at_destination) continue;
    const Pose moved = T.inverse() * cell.body(near.body).X_WB;
    EXPECT_TRUE((cell.parts[0].X_WB * near.X_PB).isApprox(moved, 1e-12));
  }
}

TEST(NearbyBodies, RefuseAnUnknownPartAndABadPose) {
  EXPECT_THROW(nearby_bodies(bench(), 2, Pose::Identity()), InvalidInput);
  Pose skewed = Pose::Identity();
  skewed.linear()(0, 0) = 2.0;
  EXPECT_THROW(nearby_bodies(bench(), 0, skewed), InvalidInput);
}

}  // namespace
}  // namespace handey
