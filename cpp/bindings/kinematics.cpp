// The floor kinematics: robots, forward and inverse kinematics, hand paths.
#include <memory>
#include <optional>

#include "configurations.hpp"
#include "handey/kinematics/arm.hpp"
#include "handey/kinematics/gripper.hpp"
#include "handey/kinematics/path.hpp"
#include "handey/kinematics/spherical_wrist.hpp"
#include "handey/kinematics/urdf.hpp"
#include "handey/world/cell.hpp"
#include "interruptible.hpp"

namespace py = pybind11;

namespace handey::bindings {
namespace {

std::vector<std::string> joint_names(const Robot& robot) {
  std::vector<std::string> names;
  for (const ArmJoint& joint : robot.joints) names.push_back(joint.name);
  return names;
}

void bind_configuration(py::module_& m) {
  py::class_<Configuration>(m, "Configuration", R"(What is to be driven.

Args:
    q: arm joints, shape (n,) [rad].
    opening: distance between the pads [m].)")
      .def(py::init([](const py::object& q, const py::object& opening) {
             return Configuration{joint_vector(q, "q"), real_number(opening, "opening")};
           }),
           py::arg("q"), py::arg("opening") = 0.0)
      .def_property(
          "q", [](const Configuration& self) { return Eigen::VectorXd(self.q); },
          [](Configuration& self, const py::object& q) { self.q = joint_vector(q, "q"); },
          "Arm joints, shape (n,) [rad]; a copy.")
      .def_property(
          "opening", [](const Configuration& self) { return self.opening; },
          [](Configuration& self, const py::object& opening) {
            self.opening = real_number(opening, "opening");
          },
          "Distance between the pads [m].")
      .def("__repr__", [](const Configuration& self) {
        return py::str("Configuration(q={}, opening={})")
            .format(py::cast(self.q).attr("tolist")(), self.opening);
      });
}

void bind_robot_parts(py::module_& m) {
  py::class_<JointLimit>(m, "JointLimit", "Limits of an arm joint; infinite for a continuous one.")
      .def_readonly("lower", &JointLimit::lower, "[rad]")
      .def_readonly("upper", &JointLimit::upper, "[rad]")
      .def_readonly("velocity", &JointLimit::velocity, "[rad/s]")
      .def_readonly("acceleration", &JointLimit::acceleration, "[rad/s2]");
  py::class_<ArmJoint>(m, "ArmJoint", "A revolute joint: child = parent * X_PJ * Rot(axis, q).")
      .def_readonly("name", &ArmJoint::name)
      .def_readonly("parent", &ArmJoint::parent, "Index of the body that carries it.")
      .def_readonly("child", &ArmJoint::child, "Index of the body that it moves.")
      .def_property_readonly(
          "X_PJ", [](const ArmJoint& self) { return matrix(self.X_PJ); },
          "Joint frame in the parent, (4, 4).")
      .def_property_readonly(
          "axis", [](const ArmJoint& self) { return self.axis; }, "Unit vector, (3,).")
      .def_readonly("limit", &ArmJoint::limit);
  py::class_<RobotBody>(m, "RobotBody", "Links joined by fixed joints: one rigid body.")
      .def_readonly("name", &RobotBody::name, "Of its first link.")
      .def_readonly("links", &RobotBody::links)
      .def_readonly("shapes", &RobotBody::shapes, "Collision geometry in the body's frame.");
  py::class_<FingerJoint>(m, "FingerJoint",
                          "child = parent * X_PJ * Translate(axis * opening / 2).")
      .def_readonly("name", &FingerJoint::name)
      .def_readonly("parent", &FingerJoint::parent)
      .def_readonly("child", &FingerJoint::child)
      .def_property_readonly("X_PJ", [](const FingerJoint& self) { return matrix(self.X_PJ); })
      .def_property_readonly("axis", [](const FingerJoint& self) { return self.axis; })
      .def_readonly("velocity", &FingerJoint::velocity, "Limit of one finger [m/s].");
  py::class_<Gripper>(m, "Gripper",
                      R"(A parallel jaw. Grasp frame H: origin midway between the pads,
+z out past the finger tips, +y the closing axis.)")
      .def_readonly("body", &Gripper::body, "Index of the body that carries H.")
      .def_property_readonly(
          "X_BH", [](const Gripper& self) { return matrix(self.X_BH); }, "H in that body, (4, 4).")
      .def_property_readonly(
          "fingers",
          [](const Gripper& self) { return py::make_tuple(self.fingers[0], self.fingers[1]); })
      .def_readonly("min_opening", &Gripper::min_opening, "[m]")
      .def_readonly("max_opening", &Gripper::max_opening, "[m]")
      .def_readonly("pad_width", &Gripper::pad_width, "Along x of H [m].")
      .def_readonly("pad_length", &Gripper::pad_length, "Along z of H [m].")
      .def_readonly("acceleration", &Gripper::acceleration, "Of one finger [m/s2].");
}

std::shared_ptr<Robot> with_jaws(const Robot& robot, const py::object& max_opening,
                                 const py::object& min_opening) {
  const double most = real_number(max_opening, "max_opening");
  const double least =
      min_opening.is_none() ? robot.gripper.min_opening : real_number(min_opening, "min_opening");
  if (!(least >= 0.0)) {
    throw InvalidInput("E_RANGE", "min_opening",
                       "expected at least 0, found " + std::to_string(least));
  }
  if (!(most > least)) {
    throw InvalidInput("E_RANGE", "max_opening",
                       "expected more than the least opening of " + std::to_string(least) +
                           " m, found " + std::to_string(most));
  }
  std::shared_ptr<Robot> other = std::make_shared<Robot>(robot);
  other->gripper.min_opening = least;
  other->gripper.max_opening = most;
  return other;
}

std::shared_ptr<Robot> with_limit(const Robot& robot, int joint, const py::object& lower,
                                  const py::object& upper) {
  if (joint < 0 || joint >= static_cast<int>(robot.joints.size())) {
    throw InvalidInput("E_RANGE", "joint",
                       "expected 0 to " + std::to_string(robot.joints.size() - 1) + ", found " +
                           std::to_string(joint));
  }
  const double low = real_number(lower, "lower"), high = real_number(upper, "upper");
  if (!(low < high)) {
    throw InvalidInput(
        "E_LIMIT", "lower",
        "expected less than upper, " + std::to_string(high) + " rad, found " + std::to_string(low));
  }
  std::shared_ptr<Robot> other = std::make_shared<Robot>(robot);
  other->joints[static_cast<std::size_t>(joint)].limit.lower = low;
  other->joints[static_cast<std::size_t>(joint)].limit.upper = high;
  return other;
}

void bind_robot(py::module_& m) {
  py::class_<Robot, std::shared_ptr<Robot>>(m, "Robot",
                                            "A robot as URDF and robot file describe it.")
      .def_readonly("name", &Robot::name)
      .def_readonly("bodies", &Robot::bodies, "Body 0 is the base; parents come before children.")
      .def_readonly("joints", &Robot::joints, "Arm joints, base to flange.")
      .def_property_readonly("joint_names", &joint_names)
      .def_property_readonly("dof", [](const Robot& self) { return self.joints.size(); })
      .def_readonly("gripper", &Robot::gripper)
      .def_property_readonly(
          "home", [](const Robot& self) { return Eigen::VectorXd(self.home); },
          "(n,) [rad]; a copy.")
      .def_readonly("ignored_pairs", &Robot::ignored_pairs,
                    "Body indices never checked against each other, from the robot file.")
      .def(
          "with_jaws", &with_jaws, py::arg("max_opening"), py::arg("min_opening") = py::none(),
          R"(The same robot, whose jaws open or close to other distances; whether its fingers can is not asked.

Args:
    max_opening: greatest distance between the pads [m].
    min_opening: least distance between the pads [m]; None for that of this robot.)")
      .def("with_limit", &with_limit, py::arg("joint"), py::arg("lower"), py::arg("upper"),
           R"(The same robot with other limits of an arm joint.

Args:
    joint: its index, from the base.
    lower, upper: of the joint [rad].)")
      .def("__repr__", [](const Robot& self) {
        return "<Robot '" + self.name + "' with " + std::to_string(self.joints.size()) + " joints>";
      });
  m.def(
      "body_poses",
      [](const Robot& robot, const Configuration& configuration) {
        return pose_array(body_poses(robot, configuration));
      },
      py::arg("robot"), py::arg("configuration"), R"(Pose of every body in the robot frame.

Returns:
    Array of shape (bodies, 4, 4).)");
  m.def(
      "hand_pose",
      [](const Robot& robot, const py::object& q) {
        return matrix(hand_pose(robot, joint_vector(q, "q")));
      },
      py::arg("robot"), py::arg("q"), R"(Grasp frame in the robot frame, X_RH, shape (4, 4).

Args:
    q: arm joints, shape (n,) [rad].)");
  m.def(
      "limit_violation",
      [](const Robot& robot, const py::object& q) {
        return limit_violation(robot, joint_vector(q, "q"));
      },
      py::arg("robot"), py::arg("q"),
      "Empty if q (n,) [rad] is within the limits (to 1e-9), else what is wrong.");
}

void bind_urdf(py::module_& m) {
  const RobotDescription d;
  py::class_<RobotDescription>(m, "RobotDescription", R"(What a URDF does not say: the robot file.

Args:
    name: of the robot; "" takes the URDF's.
    arm: revolute joints, base to flange.
    home: (n,) [rad].
    acceleration: (n,) [rad/s2]; empty for 5 at every joint.
    gripper_link: the link that carries the grasp frame.
    X_LH: grasp frame in that link, (4, 4).
    fingers: two prismatic joints.
    min_opening, max_opening: between the pads [m].
    pad_width, pad_length: of the flat inner face of a finger [m].
    ignore_collisions: pairs of link names.
    packages: folders by package name, for package:// paths.)")
      .def(py::init([](std::string name, std::vector<std::string> arm, const py::object& home,
                       const py::object& acceleration, std::string gripper_link,
                       const py::object& X_LH, std::array<std::string, 2> fingers,
                       const py::object& min_opening, const py::object& max_opening,
                       const py::object& pad_width, const py::object& pad_length,
                       std::vector<std::pair<std::string, std::string>> ignore_collisions,
                       std::map<std::string, std::string> packages) {
             const auto list = [](const py::object& values, const char* place) {
               const Eigen::VectorXd v = joint_vector(values, place);
               return std::vector<double>(v.data(), v.data() + v.size());
             };
             RobotDescription result;
             result.name = std::move(name);
             result.arm = std::move(arm);
             result.home = list(home, "home");
             result.acceleration = list(acceleration, "acceleration");
             result.gripper_link = std::move(gripper_link);
             if (!X_LH.is_none()) result.X_LH = real_pose(X_LH, "X_LH");
             result.fingers = std::move(fingers);
             result.min_opening = real_number(min_opening, "min_opening");
             result.max_opening = real_number(max_opening, "max_opening");
             result.pad_width = real_number(pad_width, "pad_width");
             result.pad_length = real_number(pad_length, "pad_length");
             result.ignore_collisions = std::move(ignore_collisions);
             result.packages = std::move(packages);
             return result;
           }),
           py::kw_only(), py::arg("name") = d.name, py::arg("arm"), py::arg("home"),
           py::arg("acceleration") = d.acceleration, py::arg("gripper_link"),
           py::arg("X_LH") = py::none(), py::arg("fingers"), py::arg("min_opening") = d.min_opening,
           py::arg("max_opening") = d.max_opening, py::arg("pad_width") = d.pad_width,
           py::arg("pad_length") = d.pad_length, py::arg("ignore_collisions") = d.ignore_collisions,
           py::arg("packages") = d.packages)
      .def_readonly("name", &RobotDescription::name)
      .def_readonly("arm", &RobotDescription::arm)
      .def_readonly("home", &RobotDescription::home, "[rad]")
      .def_readonly("acceleration", &RobotDescription::acceleration, "[rad/s2]")
      .def_readonly("gripper_link", &RobotDescription::gripper_link)
      .def_property_readonly("X_LH", [](const RobotDescription& self) { return matrix(self.X_LH); })
      .def_readonly("fingers", &RobotDescription::fingers)
      .def_readonly("min_opening", &RobotDescription::min_opening, "[m]")
      .def_readonly("max_opening", &RobotDescription::max_opening, "[m]")
      .def_readonly("pad_width", &RobotDescription::pad_width, "[m]")
      .def_readonly("pad_length", &RobotDescription::pad_length, "[m]")
      .def_readonly("ignore_collisions", &RobotDescription::ignore_collisions)
      .def_readonly("packages", &RobotDescription::packages);
  py::class_<LoadedRobot>(m, "LoadedRobot",
                          "A robot as it was read, with what is odd about its file.")
      .def_property_readonly(
          "robot", [](const LoadedRobot& self) { return std::make_shared<Robot>(self.robot); },
          "A copy.")
      .def_readonly("warnings", &LoadedRobot::warnings, "What was taken otherwise than written.");
  m.def("load_robot", &load_robot, py::arg("urdf_path"), py::arg("description"), Unlocked(),
        R"(Reads a URDF strictly.

Raises:
    InvalidInput: with every fault of the file and of the description's names and numbers.)");
}

void bind_inverse(py::module_& m) {
  py::enum_<InverseStatus>(m, "InverseStatus")
      .value("Solved", InverseStatus::Solved)
      .value("InsideShoulderCylinder", InverseStatus::InsideShoulderCylinder)
      .value("TooFar", InverseStatus::TooFar)
      .value("TooClose", InverseStatus::TooClose)
      .value("OutsideLimits", InverseStatus::OutsideLimits);
  py::class_<SingularityMargin>(m, "SingularityMargin",
                                "How far from a singularity: 0 at it, at most 1.")
      .def_readonly("shoulder", &SingularityMargin::shoulder)
      .def_readonly("elbow", &SingularityMargin::elbow)
      .def_readonly("wrist", &SingularityMargin::wrist);
  py::class_<InverseSolution>(m, "InverseSolution",
                              "One configuration that puts the hand where it was asked to be.")
      .def_property_readonly(
          "q", [](const InverseSolution& self) { return Eigen::VectorXd(self.q); },
          "Arm joints within their limits, (6,) [rad]; a copy.")
      .def_readonly("branch", &InverseSolution::branch, "0..7: shoulder + 2 * elbow + 4 * wrist.")
      .def_readonly("margin", &InverseSolution::margin);
  py::class_<InverseResult>(m, "InverseResult", "All solutions, or why there is none.")
      .def_readonly("status", &InverseResult::status)
      .def_readonly("solutions", &InverseResult::solutions,
                    "Ordered by branch, then wraps ascending.")
      .def_readonly("excess", &InverseResult::excess, "Out of reach [m], or past a limit [rad].")
      .def_readonly("joint", &InverseResult::joint, "Index of the joint past its limit, or -1.")
      .def_readonly("reason", &InverseResult::reason, "For people; empty when solved.");
  py::class_<SphericalWristSolver>(m, "SphericalWristSolver",
                                   R"(Closed-form inverse kinematics of six-joint arms with parallel
axes 2 and 3 and a spherical wrist.

Raises:
    InvalidInput: E_KINEMATICS if the arm is of another kind.)")
      .def(py::init<const Robot&>(), py::arg("robot"))
      .def_static("is_supported", &SphericalWristSolver::is_supported, py::arg("robot"))
      .def(
          "solve",
          [](const SphericalWristSolver& self, const py::object& X_RH,
             const py::object& reference) {
            const Pose pose = real_pose(X_RH, "X_RH");
            if (reference.is_none()) return self.solve(pose);
            const Eigen::VectorXd q = joint_vector(reference, "reference");
            return self.solve(pose, &q);
          },
          py::arg("X_RH"), py::arg("reference") = py::none(),
          R"(All configurations that put the grasp frame at X_RH.

Args:
    X_RH: hand pose in the robot frame, (4, 4).
    reference: (6,) [rad]; gives joint 4 at a wrist singularity and the turn of continuous joints.)");
}

void bind_path(py::module_& m) {
  const HandPathOptions defaults;
  py::class_<HandPathOptions>(m, "HandPathOptions", "Options of follow_hand_path.")
      .def(py::init([](const py::object& largest_jump) {
             return HandPathOptions{real_number(largest_jump, "largest_jump")};
           }),
           py::kw_only(), py::arg("largest_jump") = defaults.largest_jump)
      .def_readwrite("largest_jump", &HandPathOptions::largest_jump,
                     "Most a joint may turn from one pose to the next [rad].");
  py::class_<HandPathResult>(m, "HandPathResult",
                             "Configurations along a path of hand poses, as far as they go.")
      .def_property_readonly(
          "path",
          [](const HandPathResult& self) {
            Eigen::MatrixXd rows(static_cast<Eigen::Index>(self.path.size()), 6);
            for (std::size_t i = 0; i < self.path.size(); ++i) {
              rows.row(static_cast<Eigen::Index>(i)) = self.path[i].transpose();
            }
            return rows;
          },
          "One configuration per pose, as far as it went, (n, 6) [rad]; a copy.")
      .def_readonly("complete", &HandPathResult::complete)
      .def_readonly("reason", &HandPathResult::reason, "Why it stopped.");
  m.def(
      "follow_hand_path",
      [](const SphericalWristSolver& solver, const py::sequence& X_RH_path,
         const py::object& q_start, const HandPathOptions& options) {
        std::vector<Pose> poses;
        for (const py::handle& each : X_RH_path) {
          poses.push_back(real_pose(each, "X_RH_path[" + std::to_string(poses.size()) + "]"));
        }
        const Eigen::VectorXd q = joint_vector(q_start, "q_start");
        const Unlock unlock;
        return follow_hand_path(solver, poses, q, options);
      },
      py::arg("solver"), py::arg("X_RH_path"), py::arg("q_start"), py::arg("options") = defaults,
      R"(Joint configurations along hand poses, each nearest to the one before.

Args:
    X_RH_path: poses in the robot frame, (n, 4, 4).
    q_start: (6,) [rad].)");
}

}  // namespace

void bind_kinematics(py::module_& m) {
  bind_configuration(m);
  bind_robot_parts(m);
  bind_robot(m);
  bind_urdf(m);
  bind_inverse(m);
  bind_path(m);
}

}  // namespace handey::bindings
