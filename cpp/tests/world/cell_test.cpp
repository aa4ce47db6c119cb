#include "handey/world/cell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "../collision/puma_cell.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

using namespace testing;

std::vector<std::string> codes(const Cell& cell) {
  std::vector<std::string> found;
  try {
    require_valid(cell);
  } catch (const InvalidInput& error) {
    for (const Fault& fault : error.faults()) found.push_back(fault.code);
  }
  return found;
}

TEST(Cell, AGoodCellIsValid) { EXPECT_TRUE(codes(puma_cell()).empty()); }

TEST(Cell, EditsLeaveTheOriginalAlone) {
  const Cell cell = puma_cell();
  const Cell moved = cell.with_part_at(0, at(1, 2, 3));
  EXPECT_DOUBLE_EQ(moved.parts[0].X_WB.translation().x(), 1.0);
  EXPECT_DOUBLE_EQ(cell.parts[0].X_WB.translation().x(), 0.45);
  const Cell held = cell.with_held(0, at(0, 0, 0.1));
  ASSERT_TRUE(held.held.has_value());
  EXPECT_FALSE(cell.held.has_value());
  const Cell released = held.with_released(at(3, 2, 1));
  EXPECT_FALSE(released.held.has_value());
  EXPECT_DOUBLE_EQ(released.parts[0].X_WB.translation().x(), 3.0);
  EXPECT_THROW(cell.with_released(at(0, 0, 0)), InvalidInput);
  EXPECT_THROW(cell.with_held(1, at(0, 0, 0)), InvalidInput);
  EXPECT_THROW(cell.with_part_at(-1, at(0, 0, 0)), InvalidInput);
}

TEST(Cell, AnUnknownNameIsAnsweredWithTheNearestAndTheLegalOnes) {
  Cell cell = puma_cell();
  cell.parts.push_back(box_body("bracket", {0.1, 0.1, 0.1}, at(0, 0, 0)));
  EXPECT_EQ(cell.part_index("bracket"), 1);
  try {
    cell.part_index("brackte");
    FAIL();
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("did you mean 'bracket'"), std::string::npos) << text;
    EXPECT_NE(text.find("block, bracket"), std::string::npos) << text;
  }
  try {
    cell.part_index("something else");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(std::string(error.what()).find("did you mean"), std::string::npos);
  }
}

TEST(Cell, EveryFaultIsFoundAtOnce) {
  Cell cell = puma_cell();
  cell.start.q[1] = 9.0;
  cell.start.opening = 0.5;
  cell.fixtures[0].X_WB.linear() *= 1.01;
  cell.parts[0].friction = -0.1;
  cell.parts[0].mass = 0.0;
  cell.parts.push_back(box_body("table", {0.1, 0.1, 0.1}, at(0, 0, 0)));
  cell.parts.push_back(Body());
  const std::vector<std::string> found = codes(cell);
  const std::vector<std::string> expected{"E_LIMIT", "E_LIMIT", "E_NUMBER", "E_RANGE",
                                          "E_RANGE", "E_DUP",   "E_NAME",   "E_EMPTY"};
  EXPECT_EQ(found, expected);
}

TEST(Cell, SizesMustBePositiveAndFinite) {
  for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()}) {
    Cell cell = puma_cell();
    cell.parts[0].shapes[0].geometry = Box{Eigen::Vector3d(0.1, size, 0.1)};
    EXPECT_FALSE(codes(cell).empty()) << size;
  }
}

TEST(Cell, APartIsAClosedSolidAFixtureMayBeASkin) {
  TriangleMesh open = box_mesh({0.1, 0.1, 0.1});
  open.triangles.pop_back();
  Cell cell = puma_cell();
  cell.fixtures.push_back(mesh_body("skin", open, at(0, 0, 3), false));
  EXPECT_TRUE(codes(cell).empty());
  cell.parts.push_back(mesh_body("open", open, at(0, 0, 3), true));
  cell.parts.push_back(mesh_body("declared", open, at(0, 0, 3), false));
  TriangleMesh inside_out = box_mesh({0.1, 0.1, 0.1});
  for (Eigen::Vector3i& t : inside_out.triangles) std::swap(t[0], t[1]);
  cell.parts.push_back(mesh_body("turned", inside_out, at(0, 0, 3)));
  EXPECT_EQ(codes(cell),
            (std::vector<std::string>{"E_NOT_CLOSED", "E_NOT_CLOSED", "E_MESH_DEGENERATE"}));
}

TEST(Cell, TheHandIsBehindTheBase) {
  Cell cell = puma_cell();
  const Pose before = hand_in_world(cell, cell.start.q);
  cell.X_WR = at(1, 2, 3);
  EXPECT_TRUE(hand_in_world(cell, cell.start.q).isApprox(cell.X_WR * before, 1e-12));
}

TEST(CentreOfMass, WeighsShapesByVolume) {
  Body body = box_body("two", {0.1, 0.1, 0.1}, at(5, 5, 5));
  Shape second{Box{Eigen::Vector3d(0.1, 0.1, 0.3)}, at(0.2, 0, 0)};
  body.shapes.push_back(second);
  EXPECT_TRUE(centre_of_mass(body).isApprox(Eigen::Vector3d(0.15, 0, 0), 1e-12));
}

TEST(CentreOfMass, OfAMeshIsThatOfItsVolume) {
  // An L of two legs: by hand, areas 0.3 x 0.1 and 0.1 x 0.2.
  const Body body = mesh_body("l", l_mesh(0.3, 0.1), at(0, 0, 0));
  const double x = (0.03 * 0.15 + 0.02 * 0.05) / 0.05, z = (0.03 * 0.05 + 0.02 * 0.2) / 0.05;
  EXPECT_LT((centre_of_mass(body) - Eigen::Vector3d(x, 0, z)).norm(), 1e-12);
}

TEST(CentreOfMass, OfASkinIsRefused) {
  TriangleMesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_THROW(centre_of_mass(mesh_body("flat", flat, at(0, 0, 0), false)), InvalidInput);
  EXPECT_THROW(centre_of_mass(Body()), InvalidInput);
}

}  // namespace
}  // namespace handey
