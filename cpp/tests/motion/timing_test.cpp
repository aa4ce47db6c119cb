// Claims about timing: limits hold on a 1 ms grid and between any two rows, rows lie on the
// polyline, and the duration is the least, by formula on one edge and against a fine numerical
// integration on many.
#include "handey/motion/timing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "handey/errors.hpp"

namespace handey {
namespace {

using Eigen::VectorXd;

// Timing needs limits only: links and shapes do not enter.
Robot robot_with(const std::vector<double>& velocity, const std::vector<double>& acceleration) {
  Robot robot;
  for (std::size_t j = 0; j < velocity.size(); ++j) {
    ArmJoint joint;
    joint.name = "joint" + std::to_string(j + 1);
    joint.limit = {-3.0, 3.0, velocity[j], acceleration[j]};
    robot.joints.push_back(joint);
  }
  robot.gripper.fingers[0].velocity = 0.08;
  robot.gripper.fingers[1].velocity = 0.05;
  robot.gripper.acceleration = 0.5;
  return robot;
}

Robot two_joints() { return robot_with({1.5, 2.0}, {4.0, 5.0}); }

Configuration at(std::initializer_list<double> q, double opening = 0.05) {
  Configuration configuration;
  configuration.q = VectorXd(static_cast<Eigen::Index>(q.size()));
  std::copy(q.begin(), q.end(), configuration.q.data());
  configuration.opening = opening;
  return configuration;
}

// Arm joints and a finger joint.
VectorXd coordinates(const Configuration& configuration) {
  VectorXd x(configuration.q.size() + 1);
  x << configuration.q, 0.5 * configuration.opening;
  return x;
}

VectorXd velocity_limits(const Robot& robot) {
  VectorXd limits(static_cast<Eigen::Index>(robot.joints.size()) + 1);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    limits(static_cast<Eigen::Index>(j)) = robot.joints[j].limit.velocity;
  }
  limits(limits.size() - 1) =
      std::min(robot.gripper.fingers[0].velocity, robot.gripper.fingers[1].velocity);
  return limits;
}

VectorXd acceleration_limits(const Robot& robot) {
  VectorXd limits(static_cast<Eigen::Index>(robot.joints.size()) + 1);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    limits(static_cast<Eigen::Index>(j)) = robot.joints[j].limit.acceleration;
  }
  limits(limits.size() - 1) = robot.gripper.acceleration;
  return limits;
}

std::vector<Configuration> random_path(std::mt19937_64& random, int joints, int waypoints,
                                       double step) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Configuration> path;
  VectorXd q = VectorXd::Zero(joints);
  double opening = 0.05;
  for (int k = 0; k < waypoints; ++k) {
    path.push_back({q, opening});
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      q(j) = std::clamp(q(j) + step * unit(random), -3.0, 3.0);
    }
    if (k % 3 == 0) opening = std::clamp(opening + 0.05 * step * unit(random), 0.0, 0.1);
  }
  return path;
}

VectorXd coordinates_at(const TimedPath& timed, double time) {
  const auto next = std::upper_bound(timed.time.begin(), timed.time.end(), time);
  if (next == timed.time.end()) return coordinates(timed.configurations.back());
  const std::size_t i = static_cast<std::size_t>(next - timed.time.begin());
  const double share = (time - timed.time[i - 1]) / (timed.time[i] - timed.time[i - 1]);
  const VectorXd a = coordinates(timed.configurations[i - 1]);
  const VectorXd b = coordinates(timed.configurations[i]);
  return a + share * (b - a);
}

double distance_to_polyline(const std::vector<Configuration>& path, const VectorXd& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const VectorXd a = coordinates(path[k]);
    const VectorXd edge = coordinates(path[k + 1]) - a;
    const double length = edge.squaredNorm();
    const double share = length > 0.0 ? std::clamp(edge.dot(x - a) / length, 0.0, 1.0) : 0.0;
    least = std::min(least, (a + share * edge - x).norm());
  }
  return least;
}

double trapezoid_duration(double distance, double velocity, double acceleration) {
  const double ramps = velocity * velocity / acceleration;
  if (distance <= ramps) return 2.0 * std::sqrt(distance / acceleration);
  return distance / velocity + velocity / acceleration;
}

std::string code_of(const Robot& robot, const std::vector<Configuration>& path,
                    const TimingOptions& options = {}) {
  try {
    time_path(robot, path, options);
  } catch (const InvalidInput& error) {
    return error.faults().front().code;
  }
  return "";
}

TEST(Timing, OneEdgeTakesTheTimeOfATrapezoid) {
  const Robot robot = two_joints();
  for (double distance : {1e-6, 0.01, 0.2, 0.5625, 0.6, 2.5}) {
    const TimedPath timed = time_path(robot, {at({0.0, 0.1}), at({distance, 0.1})});
    EXPECT_NEAR(timed.duration(), trapezoid_duration(distance, 1.5, 4.0), 1e-9) << distance;
  }
}

TEST(Timing, TheSlowestJointSetsThePaceOfAnEdge) {
  // Joint 1 takes longest at full speed, joint 2 is longest in speeding up: rates along the edge
  // are the lesser of both.
  const Robot robot = robot_with({1.0, 2.0}, {8.0, 2.0});
  const TimedPath timed = time_path(robot, {at({0.0, 0.0}), at({1.0, 1.5})});
  // Along the share 0..1 of the edge: speed min(1/1, 2/1.5), acceleration min(8/1, 2/1.5).
  EXPECT_NEAR(timed.duration(), trapezoid_duration(1.0, 1.0, 2.0 / 1.5), 1e-9);
}

TEST(Timing, AFingerMovesHalfTheOpeningAtTheSlowerFingersLimit) {
  const TimedPath timed = time_path(two_joints(), {at({0.0, 0.0}, 0.0), at({0.0, 0.0}, 0.1)});
  EXPECT_NEAR(timed.duration(), trapezoid_duration(0.05, 0.05, 0.5), 1e-9);
}

TEST(Timing, CollinearWaypointsCostNoTime) {
  const Robot robot = two_joints();
  const TimedPath whole = time_path(robot, {at({-1.0, 0.4}), at({1.5, -0.6})});
  std::vector<Configuration> split;
  for (int k = 0; k <= 50; ++k) {
    const double share = k / 50.0;
    split.push_back(at({-1.0 + 2.5 * share, 0.4 - 1.0 * share}));
  }
  EXPECT_NEAR(time_path(robot, split).duration(), whole.duration(), 1e-9);
}

TEST(Timing, RepeatedWaypointsAreDropped) {
  const Robot robot = two_joints();
  const Configuration a = at({0.0, 0.0}), b = at({0.5, 0.2}), c = at({0.1, 0.9});
  const TimedPath once = time_path(robot, {a, b, c});
  const TimedPath twice = time_path(robot, {a, a, b, b, b, c, c});
  EXPECT_EQ(once.time, twice.time);
  const TimedPath still = time_path(robot, {a, a, a});
  ASSERT_EQ(still.time.size(), 1u);
  EXPECT_EQ(still.time.front(), 0.0);
  EXPECT_EQ(still.duration(), 0.0);
}

TEST(Timing, StopsWhereThePathTurns) {
  const Robot robot = two_joints();
  const Configuration a = at({0.0, 0.0}), b = at({0.5, 0.0});
  const TimedPath there_and_back = time_path(robot, {a, b, a});
  EXPECT_NEAR(there_and_back.duration(), 2.0 * trapezoid_duration(0.5, 1.5, 4.0), 1e-9);
}

// Everything that must hold for any path, on the rows and on a 1 ms grid.
void expect_within_limits(const Robot& robot, const std::vector<Configuration>& path,
                          const TimingOptions& options) {
  const TimedPath timed = time_path(robot, path, options);
  const VectorXd v = velocity_limits(robot), a = acceleration_limits(robot);
  ASSERT_EQ(timed.time.size(), timed.configurations.size());
  ASSERT_GE(timed.time.size(), 2u);
  EXPECT_EQ(timed.time.front(), 0.0);
  EXPECT_EQ(timed.configurations.front().q, path.front().q);
  EXPECT_EQ(timed.configurations.back().q, path.back().q);
  EXPECT_EQ(timed.configurations.back().opening, path.back().opening);

  VectorXd velocity_before = VectorXd::Zero(v.size());
  double step_before = 0.0;
  for (std::size_t i = 0; i + 1 < timed.time.size(); ++i) {
    const double step = timed.time[i + 1] - timed.time[i];
    ASSERT_GT(step, 0.0);
    const VectorXd velocity =
        (coordinates(timed.configurations[i + 1]) - coordinates(timed.configurations[i])) / step;
    EXPECT_LE(velocity.cwiseAbs().cwiseQuotient(v).maxCoeff(), 1.0 + 1e-9) << "row " << i;
    // Differences of rounded numbers over two short times: 1e-15 / step^2.
    const double noise = 1e-6 + 1e-14 / (step * std::min(step, i ? step_before : step));
    const double mean_step = 0.5 * (step + step_before);
    const double used =
        (velocity - velocity_before).cwiseAbs().cwiseQuotient(a).maxCoeff() / mean_step;
    EXPECT_LE(used, 1.0 + noise) << "row " << i << " of " << timed.time.size();
    EXPECT_LE(distance_to_polyline(path, coordinates(timed.configurations[i])), 1e-12);
    velocity_before = velocity;
    step_before = step;
  }
  // At rest in the end: what is left of the last row's speed is what one row interval brakes away.
  EXPECT_LE(velocity_before.cwiseAbs().cwiseQuotient(a).maxCoeff(), 0.5 * step_before + 1e-9);

  for (double t = 0.0; t < timed.duration(); t += 0.001) {
    const VectorXd velocity = (coordinates_at(timed, t + 0.001) - coordinates_at(timed, t)) / 0.001;
    EXPECT_LE(velocity.cwiseAbs().cwiseQuotient(v).maxCoeff(), 1.0 + 1e-9);
  }
}

TEST(Timing, LimitsHoldOnEveryRowAndOnAMillisecondGrid) {
  std::mt19937_64 random(7);
  const Robot robot = robot_with({1.5, 1.2, 2.0, 3.0, 3.0, 4.0}, {4, 5, 5, 8, 6, 9});
  for (double step : {1e-3, 0.02, 0.3, 2.0}) {
    for (int repeat = 0; repeat < 5; ++repeat) {
      TimingOptions options;
      options.interval = repeat % 2 ? 0.008 : 0.02;
      options.speed_scale = repeat == 4 ? 0.4 : 1.0;
      expect_within_limits(robot, random_path(random, 6, 12, step), options);
    }
  }
}

TEST(Timing, LimitsHoldForVeryShortAndVeryLongEdgesTogether) {
  const Robot robot = two_joints();
  expect_within_limits(robot,
                       {at({0.0, 0.0}), at({1e-7, 0.0}), at({1e-7, 2e-7}), at({2.0, 1.0}),
                        at({2.0, 1.0 - 1e-8}), at({-2.0, 0.0})},
                       {});
}

TEST(Timing, ACurveOfManyCornersIsDrivenWithinTheAccelerationLimitInEveryInterval) {
  // A circle in joint space cut into edges that take less time than a row interval: corners add up.
  const Robot robot = robot_with({2.0, 2.0}, {4.0, 4.0});
  std::vector<Configuration> circle;
  for (int k = 0; k <= 2000; ++k) {
    const double angle = 2.0 * 3.14159265358979323846 * k / 2000.0;
    circle.push_back(at({0.5 * std::cos(angle), 0.5 * std::sin(angle)}));
  }
  const TimedPath timed = time_path(robot, circle);
  const double h = 0.02;
  for (double t = 0.0; t + 2 * h < timed.duration(); t += h) {
    const VectorXd change = coordinates_at(timed, t + 2 * h) - 2.0 * coordinates_at(timed, t + h) +
                            coordinates_at(timed, t);
    EXPECT_LE(change.cwiseAbs().maxCoeff() / (h * h), 4.0 * (1.0 + 1e-6));
  }
}

// The fastest speed profile found without formulas: s in 20 000 steps, speed pushed up to every
// limit, once from each end. The stop at corners and the limits are stated anew in joint space.
double brute_force_duration(const Robot& robot, const std::vector<Configuration>& path) {
  const VectorXd v = velocity_limits(robot), a = acceleration_limits(robot);
  const int per_edge = 20000 / static_cast<int>(path.size() - 1);
  std::vector<double> length, speed{0.0};
  std::vector<VectorXd> direction;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const VectorXd edge = coordinates(path[k + 1]) - coordinates(path[k]);
    const double total = edge.cwiseAbs().cwiseQuotient(v).maxCoeff();
    for (int i = 0; i < per_edge; ++i) {
      length.push_back(total / per_edge);
      direction.push_back(edge / total);
      speed.push_back(1.0);
    }
  }
  speed.back() = 0.0;
  for (std::size_t i = 1; i + 1 < speed.size(); ++i) {
    const VectorXd jump = direction[i] - direction[i - 1];
    if (jump.cwiseAbs().maxCoeff() > 1e-9) speed[i] = 0.0;
  }
  const auto gain = [&](std::size_t i) {
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < v.size(); ++j) {
      least = std::min(least, a(j) / std::max(1e-300, std::abs(direction[i](j))));
    }
    return 2.0 * least * length[i];
  };
  for (std::size_t i = 0; i < length.size(); ++i) {
    speed[i + 1] = std::min(speed[i + 1], std::sqrt(speed[i] * speed[i] + gain(i)));
  }
  for (std::size_t i = length.size(); i-- > 0;) {
    speed[i] = std::min(speed[i], std::sqrt(speed[i + 1] * speed[i + 1] + gain(i)));
  }
  double duration = 0.0;
  for (std::size_t i = 0; i < length.size(); ++i) {
    duration += 2.0 * length[i] / (speed[i] + speed[i + 1]);
  }
  return duration;
}

TEST(Timing, DurationEqualsAFineNumericalIntegration) {
  std::mt19937_64 random(11);
  const Robot robot = robot_with({1.5, 1.2, 2.0}, {4, 5, 7});
  for (double step : {0.05, 0.5, 2.0}) {
    const std::vector<Configuration> path = random_path(random, 3, 9, step);
    const double brute = brute_force_duration(robot, path);
    EXPECT_NEAR(time_path(robot, path).duration(), brute, 2e-4 * brute) << step;
  }
}

TEST(Timing, HalfTheSpeedScaleNeverExceedsHalfTheVelocity) {
  TimingOptions options;
  options.speed_scale = 0.5;
  const TimedPath timed = time_path(two_joints(), {at({-2.0, 0.0}), at({2.0, 0.0})}, options);
  EXPECT_NEAR(timed.duration(), trapezoid_duration(4.0, 0.75, 4.0), 1e-9);
}

TEST(Timing, RowsStandNoFartherApartThanTheIntervalWhileTheSpeedChanges) {
  TimingOptions options;
  options.interval = 0.01;
  const TimedPath timed = time_path(two_joints(), {at({-2.0, 0.0}), at({2.0, 0.0})}, options);
  int cruises = 0;
  for (std::size_t i = 1; i < timed.time.size(); ++i) {
    if (timed.time[i] - timed.time[i - 1] <= options.interval * (1.0 + 1e-9)) continue;
    ++cruises;
    const double moved = timed.configurations[i].q(0) - timed.configurations[i - 1].q(0);
    EXPECT_NEAR(moved / (timed.time[i] - timed.time[i - 1]), 1.5, 1e-9);
  }
  EXPECT_EQ(cruises, 1);
}

TEST(Timing, RefusesWrongInput) {
  const Robot robot = two_joints();
  const Configuration a = at({0.0, 0.0}), b = at({0.5, 0.0});
  const double nan = std::nan("");
  EXPECT_EQ(code_of(robot, {}), "E_EMPTY");
  EXPECT_EQ(code_of(robot, {a, at({0.1})}), "E_DOF");
  EXPECT_EQ(code_of(robot, {a, at({0.1, nan})}), "E_NUMBER");
  EXPECT_EQ(code_of(robot, {a, at({0.1, 0.1}, nan)}), "E_NUMBER");
  EXPECT_EQ(code_of(robot, {a, at({0.1, 3.0 + 2e-9})}), "E_LIMIT");
  EXPECT_EQ(code_of(robot, {a, at({0.1, 3.0 + 5e-10})}), "");
  EXPECT_EQ(code_of(robot, {a, at({0.1, 0.1}, 0.11)}), "E_LIMIT");
  EXPECT_EQ(code_of(robot, {a, b}, {0.0, 1.0}), "E_RANGE");
  EXPECT_EQ(code_of(robot, {a, b}, {nan, 1.0}), "E_RANGE");
  EXPECT_EQ(code_of(robot, {a, b}, {0.008, 0.0}), "E_RANGE");
  EXPECT_EQ(code_of(robot, {a, b}, {0.008, 1.1}), "E_RANGE");
  EXPECT_EQ(code_of(robot, {a, b}, {0.008, nan}), "E_RANGE");
  EXPECT_EQ(code_of(robot_with({1.0, 0.0}, {1.0, 1.0}), {a, b}), "E_LIMIT");
  EXPECT_EQ(code_of(robot_with({1.0, 1.0}, {1.0, nan}), {a, b}), "E_LIMIT");
  EXPECT_EQ(code_of(robot_with({1.0, 1.0}, {1e-9, 1e-9}), {a, b}), "E_RANGE");
}

TEST(Timing, NamesTheJointThatIsOutsideItsLimit) {
  try {
    time_path(two_joints(), {at({0.0, 0.0}), at({0.0, 3.5})});
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.faults().front().place, "path[1]");
    EXPECT_NE(error.faults().front().message.find("joint2"), std::string::npos);
  }
}

}  // namespace
}  // namespace handey
