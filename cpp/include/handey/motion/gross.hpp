// Gross motion of the whole arm, hand empty or part in hand (article, "Global planning", steps 5 and 6): the straight edge if
// it is free, else sampling; then shortened, every edge certified again.
#pragma once

#include "handey/motion/sampling.hpp"
#include "handey/motion/shortcut.hpp"

namespace handey {

struct GrossOptions {
  SamplingOptions sampling;
  ShortcutOptions shortcut;
};

/// The goal nearest by travel time is tried first.
MotionResult plan_gross_motion(CollisionChecker& checker, const Configuration& start,
                               const std::vector<Configuration>& goals, const GrossOptions& options = {});

}  // namespace handey
