#include "replay.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

using namespace handey;
using Eigen::Vector3d;

namespace benchmark {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kStep = 0.25 * 0.017453292519943295;  // of the joint that moves farthest [rad]

std::vector<std::vector<Solid>> robot_solids(const Robot& robot) {
  std::vector<std::vector<Solid>> result;
  for (const RobotBody& body : robot.bodies) result.push_back(solids_of(body.shapes));
  return result;
}

// Joined by a joint, or in the robot file's list. (Links joined by fixed joints are one body.)
bool are_exempt(const Robot& robot, int a, int b) {
  const auto is_pair = [a, b](int one, int other) {
    return (a == one && b == other) || (a == other && b == one);
  };
  for (const ArmJoint& joint : robot.joints) {
    if (is_pair(joint.parent, joint.child)) return true;
  }
  for (const FingerJoint& finger : robot.gripper.fingers) {
    if (is_pair(finger.parent, finger.child)) return true;
  }
  return std::any_of(robot.ignored_pairs.begin(), robot.ignored_pairs.end(),
                     [&](const auto& pair) { return is_pair(pair.first, pair.second); });
}

void place_all(const std::vector<std::vector<Solid>>& bodies, const std::vector<Pose>& poses,
               std::vector<std::vector<Solid>>& placed) {
  placed.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    placed[i].resize(bodies[i].size());
    for (std::size_t k = 0; k < bodies[i].size(); ++k) {
      place_solid(bodies[i][k], poses[i], placed[i][k]);
    }
  }
}

std::string describe(const Contact& contact) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3f mm deep at %.3f: ", 1e3 * contact.depth, contact.at);
  return text + contact.a + " in " + contact.b;
}

}  // namespace

std::vector<std::pair<int, int>> checked_self_pairs(const Robot& robot) {
  const std::vector<std::vector<Solid>> bodies = robot_solids(robot);
  std::vector<std::vector<Solid>> placed;
  std::mt19937_64 generator(1);
  std::vector<std::pair<int, int>> pairs;
  for (int a = 0; a < static_cast<int>(bodies.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(bodies.size()); ++b) {
      if (!are_exempt(robot, a, b)) pairs.emplace_back(a, b);
    }
  }
  std::vector<int> overlaps(pairs.size(), 0);
  const auto count = [&](const Configuration& configuration, std::vector<char>& found) {
    place_all(bodies, body_poses(robot, configuration), placed);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      found[k] = deepest(placed[static_cast<std::size_t>(pairs[k].first)],
                         placed[static_cast<std::size_t>(pairs[k].second)]) > 0.0;
    }
  };
  std::vector<char> at_home(pairs.size()), found(pairs.size());
  count({robot.home, robot.gripper.max_opening}, at_home);
  for (int i = 0; i < 1000; ++i) {
    Configuration drawn{robot.home, 0.0};
    const auto share = [&generator] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const JointLimit& limit = robot.joints[j].limit;
      const double lower = std::isfinite(limit.lower) ? limit.lower : -kPi;
      const double upper = std::isfinite(limit.upper) ? limit.upper : kPi;
      drawn.q(static_cast<Eigen::Index>(j)) = lower + (upper - lower) * share();
    }
    drawn.opening = robot.gripper.max_opening * share();
    count(drawn, found);
    for (std::size_t k = 0; k < pairs.size(); ++k) overlaps[k] += found[k];
  }
  std::vector<std::pair<int, int>> checked;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (!(at_home[k] && overlaps[k] > 950)) checked.push_back(pairs[k]);
  }
  return checked;
}

Replay::Replay(const Cell& cell, std::vector<std::pair<int, int>> self_pairs)
    : cell_(cell), self_pairs_(std::move(self_pairs)), bodies_(robot_solids(*cell.robot)) {
  for (const Body& body : cell.fixtures) {
    Obstacle obstacle{body.name, solids_of(body.shapes), {}};
    for (Solid& solid : obstacle.solids) {
      const Solid in_body = solid;
      place_solid(in_body, cell.X_WR.inverse() * body.X_WB, solid);
      for (const Vector3d& point : solid.points) obstacle.box.extend(point);
    }
    obstacles_.push_back(std::move(obstacle));
  }
}

void Replay::place(const Configuration& configuration) {
  body_poses(*cell_.robot, configuration, poses_);
  place_all(bodies_, poses_, placed_);
}

Contact Replay::find_contact(const Configuration& configuration) {
  place(configuration);
  Contact result;
  const auto take = [&](double found, int body, const std::string& other) {
    if (found > result.depth) {
      result = {cell_.robot->bodies[static_cast<std::size_t>(body)].name, other, found, 0.0};
    }
  };
  for (std::size_t body = 1; body < placed_.size(); ++body) {  // the base stays where it is
    for (const Obstacle& obstacle : obstacles_) {
      for (const Solid& piece : placed_[body]) {
        if (obstacle.box.exteriorDistance(piece.centre) > piece.radius) continue;
        for (const Solid& solid : obstacle.solids) {
          take(overlap_depth(piece, solid), static_cast<int>(body), obstacle.name);
        }
      }
    }
  }
  for (const auto& pair : self_pairs_) {
    const std::size_t a = static_cast<std::size_t>(pair.first),
                      b = static_cast<std::size_t>(pair.second);
    take(deepest(placed_[a], placed_[b]), pair.first, cell_.robot->bodies[b].name);
  }
  return result;
}

ReplayResult Replay::check(const std::vector<Configuration>& path, const Configuration& start,
                           const Configuration& goal) {
  ReplayResult result;
  if (path.empty() || (path.front().q - start.q).cwiseAbs().maxCoeff() > 1e-9 ||
      (path.back().q - goal.q).cwiseAbs().maxCoeff() > 1e-9) {
    result.reason = "does not lead from the start to the goal";
    return result;
  }
  for (std::size_t edge = 0; edge + 1 < path.size(); ++edge) {
    const Eigen::VectorXd way = path[edge + 1].q - path[edge].q;
    const int steps = std::max(1, static_cast<int>(std::ceil(way.cwiseAbs().maxCoeff() / kStep)));
    for (int i = 0; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      const Configuration sample{path[edge].q + share * way, path[edge].opening};
      const std::string beyond = limit_violation(*cell_.robot, sample.q);
      if (!beyond.empty()) result.reason = beyond;
      Contact contact = find_contact(sample);
      if (contact.depth <= result.deepest.depth) continue;
      contact.at = static_cast<double>(edge) + share;
      result.deepest = contact;
    }
  }
  if (result.deepest.depth > 0.0) result.reason = describe(result.deepest);
  return result;
}

}  // namespace benchmark
