// How OMPL is kept repeatable: its random generators are seeded by the clock once per process, so
// none of them is used. States come from a sampler of our own; nearest neighbours from the linear
// search, which draws nothing (the default structure picks pivots at random); goals are given in
// order. Exceptions do not pass through OMPL, whose planners hold raw pointers meanwhile: they are
// kept, the search is stopped, and they are thrown again outside.
#include "handey/motion/sampling.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "ends.hpp"
#include "handey/errors.hpp"
#include "random.hpp"

namespace handey {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Eigen::VectorXd;

// OMPL reports to one process-wide handler; it is silent while any of our searches runs, then as it
// was.
class Silence {
 public:
  Silence() {
    const std::lock_guard<std::mutex> lock(mutex());
    if (count()++ == 0) ompl::msg::noOutputHandler();
  }
  ~Silence() {
    const std::lock_guard<std::mutex> lock(mutex());
    if (--count() == 0) ompl::msg::restorePreviousOutputHandler();
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  static int& count() {
    static int instance = 0;
    return instance;
  }
};

// What the callbacks share during one search.
struct Search {
  CollisionChecker& checker;
  const SamplingOptions& options;
  double opening;
  std::mt19937_64 generator;
  int sampled = 0;
  std::exception_ptr error;

  bool must_stop() const { return error || sampled >= options.max_iterations; }

  Configuration configuration(const ob::State* state) const {
    const double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
    const Eigen::Index joints = static_cast<Eigen::Index>(checker.cell().robot->joints.size());
    return {Eigen::Map<const VectorXd>(values, joints), opening};
  }

  // False once anything was thrown, so that the search runs out quickly.
  template <class Question>
  bool ask(const Question& question) {
    if (error) return false;
    try {
      return question();
    } catch (...) {
      error = std::current_exception();
      return false;
    }
  }
};

// Distances weighted by how far a joint moves the hand.
class JointSpace : public ob::RealVectorStateSpace {
 public:
  explicit JointSpace(const VectorXd& weights)
      : ob::RealVectorStateSpace(static_cast<unsigned>(weights.size())), weights_(weights) {}

  double distance(const ob::State* a, const ob::State* b) const override {
    const double* p = a->as<StateType>()->values;
    const double* q = b->as<StateType>()->values;
    double sum = 0.0;
    for (Eigen::Index j = 0; j < weights_.size(); ++j) {
      const double step = weights_(j) * (p[j] - q[j]);
      sum += step * step;
    }
    return std::sqrt(sum);
  }
  // The default ones draw a hundred states to find their cell sizes; RRT-Connect projects nothing.
  void registerProjections() override {}

 private:
  VectorXd weights_;
};

class UniformSampler : public ob::StateSampler {
 public:
  UniformSampler(const ob::StateSpace* space, Search& search)
      : ob::StateSampler(space), search_(search) {}

  void sampleUniform(ob::State* state) override {
    ++search_.sampled;
    const ob::RealVectorBounds& bounds = space_->as<ob::RealVectorStateSpace>()->getBounds();
    double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
    for (std::size_t j = 0; j < bounds.low.size(); ++j) {
      const double share = motion::uniform(search_.generator);
      values[j] = bounds.low[j] + (bounds.high[j] - bounds.low[j]) * share;
    }
  }
  // RRT-Connect asks for neither of these.
  void sampleUniformNear(ob::State*, const ob::State*, double) override { refuse(); }
  void sampleGaussian(ob::State*, const ob::State*, double) override { refuse(); }

 private:
  [[noreturn]] static void refuse() { throw std::logic_error("only uniform states are sampled"); }
  Search& search_;
};

class FreeState : public ob::StateValidityChecker {
 public:
  FreeState(const ob::SpaceInformationPtr& space, Search& search)
      : ob::StateValidityChecker(space), search_(search) {}
  bool isValid(const ob::State* state) const override {
    return search_.ask([&] {
      return search_.checker.is_free(search_.configuration(state),
                                     search_.options.certificate.clearance);
    });
  }

 private:
  Search& search_;
};

class CertifiedMotion : public ob::MotionValidator {
 public:
  CertifiedMotion(const ob::SpaceInformationPtr& space, Search& search)
      : ob::MotionValidator(space), search_(search) {}
  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    return search_.ask([&] {
      return certify_edge(search_.checker, search_.configuration(a), search_.configuration(b),
                          search_.options.certificate)
          .is_free();
    });
  }
  // For planners that keep the free beginning of an edge; none is kept here.
  bool checkMotion(const ob::State* a, const ob::State* b,
                   std::pair<ob::State*, double>& last_valid) const override {
    last_valid.second = 0.0;
    if (last_valid.first) si_->copyState(last_valid.first, a);
    return checkMotion(a, b);
  }

 private:
  Search& search_;
};

// Longest chain of links from each joint to the hand, relative to the longest of all.
VectorXd joint_weights(const Robot& robot) {
  const std::vector<Pose> poses = body_poses(robot, {robot.home, robot.gripper.min_opening});
  Eigen::Vector3d next = hand_pose(robot, robot.home).translation();
  VectorXd reach(static_cast<Eigen::Index>(robot.joints.size()));
  double chain = 0.0;
  for (std::size_t j = robot.joints.size(); j-- > 0;) {
    const ArmJoint& joint = robot.joints[j];
    const Pose X_RJ = poses[static_cast<std::size_t>(joint.parent)] * joint.X_PJ;
    chain += (X_RJ.translation() - next).norm();
    next = X_RJ.translation();
    reach(static_cast<Eigen::Index>(j)) = chain;
  }
  // Choice: no joint counts less than a tenth, or a twist of the hand in place would be free.
  return (reach / std::max(chain, 1e-9)).cwiseMax(0.1);
}

ob::RealVectorBounds bounds(const Robot& robot, const Configuration& start,
                            const std::vector<Configuration>& goals) {
  constexpr double kTwoTurns = 12.566370614359172;  // Choice: range of a continuous joint [rad]
  ob::RealVectorBounds result(static_cast<unsigned>(robot.joints.size()));
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const JointLimit& limit = robot.joints[j].limit;
    const Eigen::Index row = static_cast<Eigen::Index>(j);
    // The ends may lie outside the limits by their tolerance.
    double lower = std::min(std::max(limit.lower, -kTwoTurns), start.q(row));
    double upper = std::max(std::min(limit.upper, kTwoTurns), start.q(row));
    for (const Configuration& goal : goals) {
      lower = std::min(lower, goal.q(row));
      upper = std::max(upper, goal.q(row));
    }
    result.setLow(static_cast<unsigned>(j), lower);
    result.setHigh(static_cast<unsigned>(j), upper);
  }
  return result;
}

// The states of an exact solution; empty if there is none.
std::vector<Configuration> run_rrt_connect(Search& search, const Configuration& start,
                                           const std::vector<Configuration>& goals) {
  const Robot& robot = *search.checker.cell().robot;
  const auto space = std::make_shared<JointSpace>(joint_weights(robot));
  space->setBounds(bounds(robot, start, goals));
  space->setStateSamplerAllocator([&search](const ob::StateSpace* of) -> ob::StateSamplerPtr {
    return std::make_shared<UniformSampler>(of, search);
  });
  const auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityChecker(std::make_shared<FreeState>(information, search));
  information->setMotionValidator(std::make_shared<CertifiedMotion>(information, search));
  information->setup();

  const auto state_of = [&space](const Configuration& configuration) {
    ob::ScopedState<> state(space);
    for (Eigen::Index j = 0; j < configuration.q.size(); ++j) {
      state[static_cast<unsigned>(j)] = configuration.q(j);
    }
    return state;
  };
  const auto problem = std::make_shared<ob::ProblemDefinition>(information);
  problem->addStartState(state_of(start));
  const auto targets = std::make_shared<ob::GoalStates>(information);
  for (const Configuration& goal : goals) targets->addState(state_of(goal));
  problem->setGoal(targets);

  og::RRTConnect planner(information);
  planner.setProblemDefinition(problem);
  planner.setRange(search.options.range);
  planner.setNearestNeighbors<ompl::NearestNeighborsLinear>();
  planner.setup();
  const ob::PlannerTerminationCondition stop([&search] { return search.must_stop(); });
  const ob::PlannerStatus status = planner.solve(stop);
  if (search.error) std::rethrow_exception(search.error);

  std::vector<Configuration> path;
  if (status != ob::PlannerStatus::EXACT_SOLUTION) return path;
  for (const ob::State* state : problem->getSolutionPath()->as<og::PathGeometric>()->getStates()) {
    path.push_back(search.configuration(state));
  }
  return path;
}

}  // namespace

MotionResult plan_by_sampling(CollisionChecker& checker, const Configuration& start,
                              const std::vector<Configuration>& goals,
                              const SamplingOptions& options) {
  motion::require_options(options);
  motion::require_ends(*checker.cell().robot, start, goals);
  MotionResult result;
  result.planner = "RRT-Connect";
  const motion::FreeEnds ends =
      motion::free_ends(checker, start, goals, options.certificate.clearance);
  if (ends.status != MotionStatus::Found) {
    result.status = ends.status;
    result.reason = ends.reason;
    return result;
  }
  std::vector<Configuration> free_goals;
  for (int goal : ends.goals) free_goals.push_back(goals[static_cast<std::size_t>(goal)]);

  const Silence silence;
  Search search{checker, options, start.opening, std::mt19937_64(options.seed), 0, nullptr};
  std::vector<Configuration> path = run_rrt_connect(search, start, free_goals);
  result.iterations = search.sampled;
  const auto is_end = [](const Configuration& a, const Configuration& b) { return a.q == b.q; };
  for (std::size_t k = 0; k < free_goals.size() && !path.empty(); ++k) {
    if (is_end(path.front(), start) && is_end(path.back(), free_goals[k])) {
      result.goal = ends.goals[k];
      break;
    }
  }
  // What leaves this room is proved as it leaves it, whatever the planner joined together.
  if (result.goal >= 0 && certify_path(checker, path, options.certificate).is_free()) {
    path.back() = goals[static_cast<std::size_t>(result.goal)];
    result.status = MotionStatus::Found;
    result.path = std::move(path);
    return result;
  }
  result.goal = -1;
  result.status = MotionStatus::IterationLimit;
  result.reason = "RRT-Connect: no way in " + std::to_string(result.iterations) + " states sampled";
  return result;
}

}  // namespace handey
