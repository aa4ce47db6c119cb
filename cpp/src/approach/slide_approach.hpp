// The article's planner: slide after slide from different starts, each led out of the grasp so that
// the arm is in the grasp's branch. Where a slide ends short of the aim, the pose is tested as a
// grasp of its own.
#pragma once

#include <string>
#include <vector>

#include "approach_task.hpp"
#include "hand_slide.hpp"
#include "slide_starts.hpp"

namespace handey {

class SlideApproach {
 public:
  SlideApproach(const ApproachTask& task, HandReach& reach);

  /// The first slide that comes in, or the one that came nearest.
  ApproachResult run();

 private:
  bool slide_in(const SlideStart& start);
  ApproachResult slide_from(const SlideStart& start, const Eigen::VectorXd& q_start);
  bool settle_grasp(HandSlide& way, ApproachResult& result);
  bool test_stop(const HandSlide& way, ApproachResult& result);
  void certify(const HandSlide& way, ApproachResult& result);

  const ApproachTask& task_;
  const ObstacleLayers obstacles_;
  HandReach& reach_;
  HandSlider slider_;
  // Of the slides so far:
  ApproachResult nearest_;
  double least_distance_;
  int slides_ = 0, blocked_ = 0;
  std::string blocked_by_;
};

/// The configuration of the list that is `q` to rounding, exactly as it is listed; null if none.
const Eigen::VectorXd* same_configuration(const std::vector<Eigen::VectorXd>& legal,
                                          const Eigen::VectorXd& q);

}  // namespace handey
