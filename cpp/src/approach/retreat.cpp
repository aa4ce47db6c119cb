// The hand's straight line out of contact, pose by pose through inverse kinematics. The first,
// short edge may touch what was touched before, so the contacts are followed along it: none may get
// deeper, which is proved where a plane lies between. From its end on nothing may touch.
#include "handey/approach/retreat.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "certified_path.hpp"
#include "handey/collision/contact_motion.hpp"
#include "handey/errors.hpp"
#include "reason.hpp"
#include "room.hpp"

namespace handey {

namespace {

// Choice: far above what a straight joint line leaves a straight hand line by in contact_travel
// (micrometres), far below the contact tolerance of 0.5 mm.
constexpr double kMostBack = 2e-5;  // [m]
constexpr double kMostTurn = 1e-4;  // [rad]
constexpr int kSamples = 8;         // along the first edge

void require_range(bool good, const std::string& message) {
  if (!good) throw InvalidInput("E_RANGE", "plan_retreat", message);
}

void require_valid(const Cell& cell, const Configuration& start, const Eigen::Vector3d& direction,
                   const RetreatOptions& options) {
  const std::size_t joints = cell.robot->joints.size();
  if (static_cast<std::size_t>(start.q.size()) != joints) {
    throw InvalidInput("E_DOF", "plan_retreat",
                       "the start has " + std::to_string(start.q.size()) +
                           " joint values, the arm " + std::to_string(joints) + " joints");
  }
  if (!start.q.allFinite() || !std::isfinite(start.opening) || !direction.allFinite()) {
    throw InvalidInput("E_NUMBER", "plan_retreat", "start and direction must be finite numbers");
  }
  require_range(std::abs(direction.norm() - 1.0) < 1e-6, "the direction must be a unit vector");
  require_range(options.contact_travel > 0.0 && options.step > 0.0,
                "contact_travel and step must be positive");
  require_range(options.contact_travel <= options.least && options.least <= options.most,
                "there must be contact_travel <= least <= most");
  require_range(options.room >= 0.0 && options.room < 1.0, "room must be 0 to 1 rad");
  require_range(options.most < 10.0 && options.most / options.step < 1e5,
                "most must be some steps");
}

/// How far the hand is along the line at each pose [m].
std::vector<double> stations(const RetreatOptions& options) {
  std::vector<double> result{options.contact_travel};
  while (result.back() < options.most - 1e-9) {
    result.push_back(std::min(result.back() + options.step, options.most));
  }
  return result;
}

/// Points whose hull holds the gripper and what it holds, in H.
std::vector<Eigen::Vector3d> points_of_hand(const Cell& cell, const Configuration& configuration) {
  const Robot& robot = *cell.robot;
  const std::vector<Pose> X_RB = body_poses(robot, configuration);
  const Pose X_HR = hand_pose(robot, configuration.q).inverse(Eigen::Isometry);
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](const std::vector<Shape>& shapes, const Pose& X_HB) {
    for (const Shape& shape : shapes) {
      for (const Eigen::Vector3d& point : hull_points(shape)) points.push_back(X_HB * point);
    }
  };
  const Gripper& gripper = robot.gripper;
  for (const int body : {gripper.body, gripper.fingers[0].child, gripper.fingers[1].child}) {
    const std::size_t index = static_cast<std::size_t>(body);
    add(robot.bodies[index].shapes, X_HR * X_RB[index]);
  }
  if (cell.held) {
    add(cell.parts[static_cast<std::size_t>(cell.held->part)].shapes, cell.held->X_HP);
  }
  return points;
}

/// Empty if no point moves back and the hand keeps its direction along the edge, else what does.
std::string deepening(const Cell& cell, const Configuration& a, const Configuration& b,
                      const Eigen::Vector3d& direction) {
  const std::vector<Eigen::Vector3d> points = points_of_hand(cell, a);
  const Pose X_WH_start = hand_in_world(cell, a.q);
  std::vector<double> farthest;  // each point along the direction, so far
  for (const Eigen::Vector3d& point : points) {
    farthest.push_back(direction.dot(X_WH_start * point));
  }
  for (int sample = 1; sample <= kSamples; ++sample) {
    const Eigen::VectorXd q = a.q + (b.q - a.q) * (static_cast<double>(sample) / kSamples);
    const Pose X_WH = hand_in_world(cell, q);
    const double turn = Eigen::AngleAxisd(X_WH_start.linear().transpose() * X_WH.linear()).angle();
    if (turn > kMostTurn) {
      return "the hand turns by " + degrees(turn) + " while still in contact";
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double along = direction.dot(X_WH * points[i]);
      if (along < farthest[i] - kMostBack) {
        return "a point of the hand or part moves back by " + millimetres(farthest[i] - along) +
               " while still in contact";
      }
      farthest[i] = std::max(farthest[i], along);
    }
  }
  return "";
}

/// The first edge, out of contact; empty if good.
std::string leave_contact(CollisionChecker& in_contact, CollisionChecker& clear,
                          const Configuration& a, const Configuration& b,
                          const Eigen::Vector3d& direction, const RetreatOptions& options) {
  const EdgeResult edge = certify_edge(in_contact, a, b, options.certificate);
  if (!edge.is_free()) return describe(edge.hit);
  const ContactMotion contacts = follow_contacts(clear, in_contact, a, b);
  if (contacts.deeper) return contacts.deeper->a + " would pass through " + contacts.deeper->b;
  if (contacts.measured > 0) {
    const std::string back = deepening(in_contact.cell(), a, b, direction);
    if (!back.empty()) return back;
  }
  const std::optional<Hit> hit = clear.find_hit(b, options.certificate.clearance);
  if (!hit) return "";
  return hit->a + " still touches " + hit->b + " there, or has less than " +
         millimetres(options.certificate.clearance) +
         " to spare: it fits too closely to be moved out";
}

/// Ends the path at the last point, not nearer than `least`, at which there is room.
/// @return false, and the path as it was, if there is none
bool draw_back(CollisionChecker& clear, const std::vector<Configuration>& points,
               const std::vector<double>& at, const RetreatOptions& options,
               CertifiedPath& proved) {
  const std::size_t first = static_cast<std::size_t>(
      std::lower_bound(at.begin(), at.end(), options.least - 1e-9) - at.begin());
  const auto end = points.begin() + static_cast<std::ptrdiff_t>(proved.reached) + 1;
  const std::optional<std::size_t> roomy = last_with_room(
      clear, {points.begin(), end}, first, options.room, options.certificate.clearance);
  if (!roomy) return false;
  if (*roomy == proved.reached) return true;
  const auto there = points.begin() + static_cast<std::ptrdiff_t>(*roomy) + 1;
  CertifiedPath shorter = certified_path(clear, {points.begin(), there}, options.certificate);
  if (shorter.reached != *roomy) return false;
  proved = std::move(shorter);
  return true;
}

}  // namespace

RetreatResult plan_retreat(CollisionChecker& in_contact, CollisionChecker& clear,
                           const SphericalWristSolver& solver, const Configuration& start,
                           const Eigen::Vector3d& direction, const RetreatOptions& options) {
  const Cell& cell = clear.cell();
  require_valid(cell, start, direction, options);
  RetreatResult result;
  result.path.push_back(start);

  const std::vector<double> at = stations(options);
  const Pose X_WH = hand_in_world(cell, start.q);
  const Pose X_RW = cell.X_WR.inverse(Eigen::Isometry);
  std::vector<Pose> X_RH_path;
  for (const double travelled : at) {
    X_RH_path.push_back(X_RW * Eigen::Translation3d(travelled * direction) * X_WH);
  }
  const HandPathResult arm = follow_hand_path(solver, X_RH_path, start.q);
  if (arm.path.empty()) {
    result.reason = "within the first " + millimetres(at.front()) + ": " + arm.reason;
    return result;
  }

  const Configuration out{arm.path.front(), start.opening};
  const std::string held_up = leave_contact(in_contact, clear, start, out, direction, options);
  if (!held_up.empty()) {
    result.reason = "within the first " + millimetres(at.front()) + ": " + held_up;
    return result;
  }

  std::vector<Configuration> points{out};
  std::string stop = arm.reason;
  for (std::size_t i = 1; i < arm.path.size(); ++i) {
    const Configuration next{arm.path[i], start.opening};
    const std::optional<Hit> hit = clear.find_hit(next, options.certificate.clearance);
    if (hit) {
      stop = describe(*hit);
      break;
    }
    points.push_back(next);
  }
  CertifiedPath proved = certified_path(clear, points, options.certificate);
  if (proved.reached + 1 < points.size()) stop = describe(proved.obstacle.hit);
  const std::size_t farthest = proved.reached;
  if (options.room > 0.0) result.has_room = draw_back(clear, points, at, options, proved);
  result.path.insert(result.path.end(), proved.path.begin(), proved.path.end());
  result.travelled = at[proved.reached];
  result.found = result.travelled >= options.least - 1e-9;
  if (farthest + 1 < at.size()) {
    result.reason = "after " + millimetres(at[farthest]) + ": " + stop;
    if (!result.found) result.reason += "; " + millimetres(options.least) + " are needed";
  }
  return result;
}

}  // namespace handey
