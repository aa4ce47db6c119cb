// Gross motion of the whole arm, hand empty or part in hand: the straight edge if it is free, else
// sampling; then shortened, every edge certified again. Not guaranteed: a way that exists is found
// within the sampling's budget. Article: "Global planning", steps 5 and 6.
#pragma once

#include "handey/motion/sampling.hpp"
#include "handey/motion/shortcut.hpp"

namespace handey {

struct GrossOptions {
  SamplingOptions sampling;
  ShortcutOptions shortcut;
};

/// The goal nearest by travel time is tried first. Goals in collision are left out while another is
/// free.
/// @param goals same opening as the start
/// @throws InvalidInput as plan_by_sampling and shorten_path do
MotionResult plan_gross_motion(CollisionChecker& checker, const Configuration& start,
                               const std::vector<Configuration>& goals,
                               const GrossOptions& options = {});

}  // namespace handey
