// Forward and inverse kinematics: where the hand is at a configuration, and all configurations that
// bring it there. Usage: 01_forward_inverse_kinematics MODELS
#include <cstdio>

#include "puma560.hpp"

int main(int argc, char** argv) {
  using namespace handey;
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::shared_ptr<const Robot> robot = example::load_puma560(models);

  Eigen::VectorXd q(6);
  q << 0.3, 0.6, -0.4, 0.5, 0.7, -0.2;
  const Pose X_RH = hand_pose(*robot, q);
  const Eigen::Vector3d p = X_RH.translation();
  std::printf("hand at (%.4f, %.4f, %.4f) m in the robot frame\n", p.x(), p.y(), p.z());

  const SphericalWristSolver solver(*robot);
  const InverseResult inverse = solver.solve(X_RH);
  std::printf("%zu configurations bring it there:\n", inverse.solutions.size());
  bool found_q = false;
  double worst = 0.0;
  for (const InverseSolution& solution : inverse.solutions) {
    const Eigen::VectorXd& s = solution.q;
    std::printf("  branch %d: %7.3f %7.3f %7.3f %7.3f %7.3f %7.3f rad\n", solution.branch, s(0),
                s(1), s(2), s(3), s(4), s(5));
    const Eigen::Matrix4d error = hand_pose(*robot, s).matrix() - X_RH.matrix();
    worst = std::max(worst, error.cwiseAbs().maxCoeff());
    found_q = found_q || (s - q).cwiseAbs().maxCoeff() < 1e-6;
  }
  std::printf("largest error of any of them: %.1e\n", worst);

  const InverseResult far = solver.solve(example::at(2.0, 0.0, 0.5));
  std::printf("2 m away there is none: %s\n", far.reason.c_str());
  return found_q && worst < 1e-9 && far.solutions.empty() ? 0 : 1;
}
