#include "handey/world/depth_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "../collision/puma_cell.hpp"
#include "handey/errors.hpp"
#include "handey/geometry/convex_pieces.hpp"

namespace handey {
namespace {

using namespace testing;
using Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

HeightMap heights(int rows, int columns, std::vector<double> values, double cell = 0.1) {
  HeightMap map;
  map.rows = rows;
  map.columns = columns;
  map.heights = std::move(values);
  map.cell = cell;
  return map;
}

DepthImage image(int rows, int columns, std::vector<double> depths, double focal = 10.0) {
  DepthImage made;
  made.rows = rows;
  made.columns = columns;
  made.depths = std::move(depths);
  made.fx = made.fy = focal;
  made.cx = 0.5 * (columns - 1);
  made.cy = 0.5 * (rows - 1);
  return made;
}

/// The convex solids of a body by the planes of their triangles.
class Solids {
 public:
  explicit Solids(const Body& body) {
    for (const Shape& shape : body.shapes) {
      const TriangleMesh mesh = tessellate(shape);
      std::vector<std::pair<Vector3d, double>> planes;
      for (const Eigen::Vector3i& t : mesh.triangles) {
        const auto corner = [&](int k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
        const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
        planes.emplace_back(normal, normal.dot(corner(0)));
      }
      solids_.push_back(std::move(planes));
    }
  }
  bool hold(const Vector3d& point) const {
    return std::any_of(solids_.begin(), solids_.end(), [&](const auto& planes) {
      return std::all_of(planes.begin(), planes.end(), [&](const auto& plane) {
        return plane.first.dot(point) <= plane.second + 1e-9;
      });
    });
  }

 private:
  std::vector<std::vector<std::pair<Vector3d, double>>> solids_;
};

/// Is a point of the body's frame in one of its solids?
bool holds(const Body& body, const Vector3d& point) { return Solids(body).hold(point); }

Vector3d random_point(const Shape& shape, std::mt19937& random) {
  const TriangleMesh mesh = tessellate(shape);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Vector3d point = Vector3d::Zero();
  double total = 0.0;
  for (const Vector3d& vertex : mesh.vertices) {
    const double weight = -std::log(1.0 - share(random));
    point += weight * vertex;
    total += weight;
  }
  return point / total;
}

/// Distance of two numbers from an interval.
double beyond(double x, double low, double high) { return std::max({low - x, x - high, 0.0}); }

double distance_from_columns(const HeightMap& map, const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (int v = 0; v < map.rows; ++v) {
    for (int u = 0; u < map.columns; ++u) {
      const double h = map.heights[static_cast<std::size_t>(v * map.columns + u)];
      if (!(h > 0.0)) continue;
      const double half = 0.5 * map.cell;
      least = std::min(least, Vector3d(beyond(p.x(), u * map.cell - half, u * map.cell + half),
                                       beyond(p.y(), v * map.cell - half, v * map.cell + half),
                                       beyond(p.z(), 0.0, h))
                                  .norm());
    }
  }
  return least;
}

/// From the cone of one pixel: the section at each depth is a rectangle, and the distance convex
/// in it.
double distance_from_cone(const DepthImage& map, int v, int u, double depth, const Vector3d& p) {
  const auto at = [&](double z) {
    const double x0 = (u - 0.5 - map.cx) / map.fx * z, x1 = (u + 0.5 - map.cx) / map.fx * z;
    const double y0 = (v - 0.5 - map.cy) / map.fy * z, y1 = (v + 0.5 - map.cy) / map.fy * z;
    return Vector3d(beyond(p.x(), x0, x1), beyond(p.y(), y0, y1), p.z() - z).norm();
  };
  double low = depth, high = depth + map.far;
  for (int i = 0; i < 40; ++i) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
  }
  return at(0.5 * (low + high));
}

double distance_from_cones(const DepthImage& map, const std::vector<char>& taken_out,
                           const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (int v = 0; v < map.rows; ++v) {
    for (int u = 0; u < map.columns; ++u) {
      const std::size_t i = static_cast<std::size_t>(v * map.columns + u);
      if (taken_out.empty() || taken_out[i] == 0) {
        least = std::min(least, distance_from_cone(map, v, u, map.depths[i], p));
      }
    }
  }
  return least;
}

template <class Call>
std::string code_of(const Call& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.faults().front().code;
  }
  return "";
}

TEST(DepthMap, OneHeightIsOneBox) {
  const MeasuredBody found = cover_heights("heap", heights(1, 1, {0.3}));
  EXPECT_EQ(found.body.name, "heap");
  EXPECT_LT(found.excess, 1e-9);
  ASSERT_EQ(found.body.shapes.size(), 1u);
  const Box* box = std::get_if<Box>(&found.body.shapes[0].geometry);
  ASSERT_NE(box, nullptr);
  EXPECT_TRUE(box->size.isApprox(Vector3d(0.1, 0.1, 0.3), 1e-12));
  EXPECT_TRUE(found.body.shapes[0].X_BS.translation().isApprox(Vector3d(0, 0, 0.15), 1e-12));
}

TEST(DepthMap, OnePixelIsItsCone) {
  DepthImage one = image(1, 1, {1.0});
  one.far = 0.5;
  const MeasuredBody found = cover_depths("camera", one, {});
  ASSERT_EQ(found.body.shapes.size(), 1u);
  EXPECT_LT(found.excess, 1e-9);
  std::vector<Vector3d> expected;
  for (const double z : {1.0, 1.5}) {
    for (const double x : {-0.05, 0.05}) {
      for (const double y : {-0.05, 0.05}) expected.push_back(z * Vector3d(x, y, 1.0));
    }
  }
  const TriangleMesh mesh = tessellate(found.body.shapes[0]);
  ASSERT_EQ(mesh.vertices.size(), 8u);
  for (const Vector3d& corner : expected) {
    EXPECT_TRUE(std::any_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vector3d& v) {
      return (v - corner).norm() < 1e-12;
    })) << corner.transpose();
  }
  EXPECT_NEAR(inspect_surface(mesh).volume, 0.01 * (1.5 * 1.5 * 1.5 - 1.0) / 3.0, 1e-12);
}

TEST(DepthMap, HeightsAtOrBelowThePlaneAreNothing) {
  EXPECT_TRUE(cover_heights("heap", heights(1, 2, {0.0, -0.1})).body.shapes.empty());
}

TEST(DepthMap, AHeightThatWasNotMeasuredIsAsHighAsTheHighest) {
  const MeasuredBody found = cover_heights("heap", heights(2, 2, {0.1, kNaN, 0.2, 0.1}));
  EXPECT_TRUE(holds(found.body, {0.1, 0.0, 0.2}));
  EXPECT_FALSE(holds(found.body, {0.0, 0.0, 0.11}));
  EXPECT_FALSE(holds(found.body, {0.1, 0.0, 0.201}));
}

TEST(DepthMap, AHoleIsAsNearAsTheNearestPixelOnItsBorder) {
  // Two holes that touch at a corner only; the pixel at depth 0.5 borders on neither.
  const MeasuredBody found = cover_depths("camera",
                                          image(3, 4,
                                                {0.0, 1.1, 1.2, 1.3,   //
                                                 1.4, kNaN, 1.6, 1.7,  //
                                                 0.5, 1.8, 1.9, 0.0}),
                                          {});
  DepthImage filled = image(3, 4, {1.1, 1.1, 1.2, 1.3, 1.4, 1.1, 1.6, 1.7, 0.5, 1.8, 1.9, 1.7});
  for (int v = 0; v < 3; ++v) {
    for (int u = 0; u < 4; ++u) {
      const double z = filled.depths[static_cast<std::size_t>(4 * v + u)];
      const Vector3d ray((u - filled.cx) / filled.fx, (v - filled.cy) / filled.fy, 1.0);
      EXPECT_TRUE(holds(found.body, (z + 1e-6) * ray)) << v << ' ' << u;
      EXPECT_FALSE(holds(found.body, (z - found.excess - 1e-6) * ray)) << v << ' ' << u;
    }
  }
}

TEST(DepthMap, AnExplainedPixelIsTakenOutOfItsHolesBorderNot) {
  const DepthImage row = image(1, 3, {0.8, 0.0, 1.2});
  const MeasuredBody found = cover_depths("camera", row, {1, 0, 0});
  EXPECT_FALSE(holds(found.body, {-0.08, 0.0, 0.81}));
  EXPECT_TRUE(holds(found.body, {0.0, 0.0, 0.81}));
  EXPECT_TRUE(holds(found.body, {0.12, 0.0, 1.21}));
  EXPECT_TRUE(cover_depths("camera", image(1, 1, {1.0}), {1}).body.shapes.empty());
}

TEST(DepthMap, SolidsContainWhatWasMeasuredAndStandOutNoMoreThanTold) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int trial = 0; trial < 12; ++trial) {
    // A slope with steps, holes that were taken out, and noise.
    const int rows = 4 + trial, columns = 19 - trial;
    std::vector<double> upper;
    std::vector<char> empty;
    for (int v = 0; v < rows; ++v) {
      for (int u = 0; u < columns; ++u) {
        upper.push_back(0.4 + 0.01 * u - 0.02 * v + (u > 7 ? 0.1 : 0.0) +
                        0.001 * trial * share(random));
        empty.push_back(share(random) < 0.08 * (trial % 4) || (u - 5) * (u - 5) + v * v < 9);
      }
    }
    DepthMapOptions options;
    options.most_solids = 5 + 7 * trial;
    options.excess = 0.004;
    const DepthImage depths = image(rows, columns, upper, 60.0);
    const MeasuredBody seen = cover_depths("camera", depths, empty, options);
    std::vector<double> with_gaps = upper;
    for (std::size_t i = 0; i < upper.size(); ++i) {
      if (empty[i] != 0) with_gaps[i] = -0.1;
    }
    const HeightMap map = heights(rows, columns, with_gaps, 0.007);
    const MeasuredBody heap = cover_heights("heap", map, options);
    EXPECT_LE(static_cast<int>(seen.body.shapes.size()), options.most_solids + 1);
    EXPECT_LE(static_cast<int>(heap.body.shapes.size()), options.most_solids + 1);
    const Solids seen_solids(seen.body), heap_solids(heap.body);
    for (int k = 0; k < 400; ++k) {
      const std::size_t i = random() % upper.size();
      if (empty[i] != 0) continue;
      const double u = static_cast<int>(i) % columns + share(random) - 0.5,
                   v = static_cast<int>(i) / columns + share(random) - 0.5;
      const double z = upper[i] + depths.far * share(random);
      EXPECT_TRUE(
          seen_solids.hold({(u - depths.cx) / depths.fx * z, (v - depths.cy) / depths.fy * z, z}));
      EXPECT_TRUE(heap_solids.hold({0.007 * u, 0.007 * v, upper[i] * share(random)}));
    }
    for (const Shape& shape : seen.body.shapes) {
      const MeshShape* mesh = std::get_if<MeshShape>(&shape.geometry);
      if (mesh != nullptr) EXPECT_TRUE(mesh->convex && is_convex(*mesh->mesh));
      for (int k = 0; k < 8; ++k) {
        EXPECT_LE(distance_from_cones(depths, empty, random_point(shape, random)),
                  seen.excess + 1e-9);
      }
    }
    for (const Shape& shape : heap.body.shapes) {
      for (int k = 0; k < 8; ++k) {
        EXPECT_LE(distance_from_columns(map, random_point(shape, random)), heap.excess + 1e-9);
      }
    }
  }
}

TEST(DepthMap, ASmoothSlopeTakesFewSolids) {
  std::vector<double> upper;
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 80; ++u) upper.push_back(0.1 + 0.0005 * u + 0.0002 * v);
  }
  const MeasuredBody found = cover_heights("ramp", heights(60, 80, upper, 0.002));
  EXPECT_LE(found.body.shapes.size(), 2u);
  EXPECT_LE(found.excess, 0.003);
}

TEST(DepthMap, NothingStandsOutWhereAPartStands) {
  // Heights that differ from column to column; a part stands on the highest of a few.
  std::mt19937 random(3);
  std::vector<double> upper;
  for (int i = 0; i < 40 * 40; ++i)
    upper.push_back(0.05 + 1e-3 * static_cast<double>(random() % 20));
  const HeightMap map = heights(40, 40, upper, 0.005);
  DepthMapOptions options;
  options.most_solids = 20;
  options.places = {box_body("part", {0.03, 0.03, 0.04}, at(0.1, 0.1, 0.069 + 0.02))};
  const MeasuredBody found = cover_heights("heap", map, options);
  EXPECT_TRUE(found.exact_at_places);
  EXPECT_GT(found.excess, 0.01);
  std::uniform_real_distribution<double> share(-0.5, 0.5);
  const Solids solids(found.body);
  for (int k = 0; k < 2000; ++k) {
    const Vector3d p =
        Vector3d(0.1, 0.1, 0.089) +
        Vector3d(0.034 * share(random), 0.034 * share(random), 0.044 * share(random));
    if (distance_from_columns(map, p) <= 1e-6) continue;
    EXPECT_FALSE(solids.hold(p)) << p.transpose();
  }
}

TEST(DepthMap, WhatTheArmCannotReachIsLeftOut) {
  DepthMapOptions options;
  options.reach = 0.3;
  options.reach_centre = {0.0, 0.0, 0.0};
  const MeasuredBody found =
      cover_heights("row", heights(1, 12, std::vector<double>(12, 0.1)), options);
  ASSERT_FALSE(found.body.shapes.empty());
  EXPECT_TRUE(holds(found.body, {0.2, 0.0, 0.05}));
  options.reach_centre = {0.0, 5.0, 0.0};
  EXPECT_TRUE(cover_heights("row", heights(1, 12, std::vector<double>(12, 0.1)), options)
                  .body.shapes.empty());
}

TEST(DepthMap, TheReachBallHoldsTheArmAtEveryConfiguration) {
  const Cell cell = puma_cell();
  const ReachBall ball = reach_ball(cell);
  EXPECT_LT(ball.radius, 2.0);
  std::mt19937 random(5);
  for (int k = 0; k < 200; ++k) {
    Configuration configuration = cell.start;
    for (Eigen::Index j = 0; j < configuration.q.size(); ++j) {
      const JointLimit& limit = cell.robot->joints[static_cast<std::size_t>(j)].limit;
      configuration.q[j] =
          limit.lower + (limit.upper - limit.lower) * static_cast<double>(random() % 1000) / 999.0;
    }
    const std::vector<Pose> poses = body_poses(*cell.robot, configuration);
    for (std::size_t b = 1; b < poses.size(); ++b) {
      for (const Shape& shape : cell.robot->bodies[b].shapes) {
        for (const Vector3d& point : hull_points(shape)) {
          EXPECT_LE((cell.X_WR * poses[b] * point - ball.centre).norm(), ball.radius + 1e-9);
        }
      }
    }
  }
}

TEST(DepthMap, PixelsNearAKnownSurfaceAreExplained) {
  Cell cell = puma_cell();
  cell.fixtures.clear();
  cell.parts.clear();
  cell.X_WR = at(50, 0, 0);
  DepthImage seen = image(1, 1, {1.0});
  const auto is_explained = [&](const Geometry& geometry, double z) {
    Body body;
    body.name = "thing";
    body.shapes = {{geometry, Pose::Identity()}};
    body.X_WB = at(0, 0, z);
    cell.fixtures = {body};
    return explained_pixels(seen, cell)[0] != 0;
  };
  TriangleMesh cube = tessellate({Box{Vector3d(0.2, 0.2, 0.2)}, Pose::Identity()});
  const Geometry shapes[] = {Box{Vector3d(0.2, 0.2, 0.2)}, Cylinder{0.1, 0.2}, Sphere{0.1},
                             MeshShape{std::make_shared<const TriangleMesh>(cube), true}};
  for (const Geometry& shape : shapes) {
    EXPECT_TRUE(is_explained(shape, 1.1));
    EXPECT_TRUE(is_explained(shape, 1.1 + 0.0049));
    EXPECT_FALSE(is_explained(shape, 1.1 + 0.0051));
    EXPECT_TRUE(is_explained(shape, 1.1 - 0.0049));
    EXPECT_FALSE(is_explained(shape, 1.1 - 0.0051));
    EXPECT_FALSE(is_explained(shape, 1.0));  // deep inside
    EXPECT_TRUE(is_explained(shape, 0.9));
  }
  seen.explained = 0.0;
  EXPECT_FALSE(is_explained(Sphere{0.1}, 1.1));
}

TEST(DepthMap, PartsAndTheRobotExplainToo) {
  Cell cell = puma_cell();
  const Pose X_WP = cell.parts[0].X_WB;
  DepthImage seen = image(1, 1, {0.5});
  // Looking down on the part.
  seen.X_WD = Eigen::Translation3d(X_WP.translation() + Vector3d(0, 0, 0.5)) *
              Eigen::AngleAxisd(std::acos(-1.0), Vector3d::UnitX());
  seen.explained = 0.05;
  EXPECT_EQ(explained_pixels(seen, cell)[0], 1);
  const std::vector<Pose> poses = body_poses(*cell.robot, cell.start);
  const Shape& upper_arm = cell.robot->bodies[2].shapes[0];
  const Vector3d point = cell.X_WR * poses[2] * hull_points(upper_arm)[0];
  seen.X_WD.translation() = point + Vector3d(0, 0, 0.5);
  cell.parts.clear();
  cell.fixtures.clear();
  EXPECT_EQ(explained_pixels(seen, cell)[0], 1);
}

TEST(DepthMap, WrongNumbersAreRefused) {
  const auto cover_image = [](const DepthImage& wrong) { cover_depths("camera", wrong, {}); };
  EXPECT_EQ(code_of([] { cover_heights("h", heights(0, 0, {})); }), "E_IMAGE");
  EXPECT_EQ(code_of([] { cover_heights("h", heights(1, 1, {kNaN})); }), "E_IMAGE");
  EXPECT_EQ(code_of([] { cover_heights("h", heights(1, 1, {INFINITY})); }), "E_NUMBER");
  EXPECT_EQ(code_of([] { cover_heights("h", heights(1, 1, {0.1}, 0.0)); }), "E_RANGE");
  EXPECT_EQ(code_of([&] { cover_image(image(1, 2, {1.0})); }), "E_IMAGE");
  EXPECT_EQ(code_of([&] { cover_image(image(1, 2, {0.0, kNaN})); }), "E_IMAGE");
  EXPECT_EQ(code_of([&] { cover_image(image(1, 1, {-1.0})); }), "E_NUMBER");
  EXPECT_EQ(code_of([&] { cover_image(image(1, 1, {1.0}, 0.0)); }), "E_CAMERA");
  EXPECT_EQ(code_of([] { cover_depths("camera", image(1, 1, {1.0}), {0, 0}); }), "E_IMAGE");
  DepthMapOptions wrong;
  wrong.excess = 0.0;
  EXPECT_EQ(code_of([&] { cover_heights("h", heights(1, 1, {0.1}), wrong); }), "E_RANGE");
}

TEST(DepthMap, TheFiltersOfAPngAreUndone) {
  // Two pixels a row: none, left, up, average, Paeth.
  const unsigned char bytes[] = {0, 1, 2, 3, 4, 1, 1, 2, 2, 2, 2, 1, 1,
                                 1, 1, 3, 1, 1, 1, 1, 4, 1, 1, 1, 1};
  const std::vector<unsigned short> found = unfilter_png16(bytes, sizeof bytes, 5, 2);
  const std::vector<unsigned short> expected = {0x0102, 0x0304, 0x0102, 0x0304, 0x0203,
                                                0x0405, 0x0202, 0x0404, 0x0303, 0x0505};
  EXPECT_EQ(found, expected);
  EXPECT_EQ(code_of([&] { unfilter_png16(bytes, sizeof bytes - 1, 5, 2); }), "E_IMAGE");
  const unsigned char unknown[] = {5, 0, 0};
  EXPECT_EQ(code_of([&] { unfilter_png16(unknown, 3, 1, 1); }), "E_IMAGE");
}

}  // namespace
}  // namespace handey
