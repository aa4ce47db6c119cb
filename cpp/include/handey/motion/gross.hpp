// Gross motion of the whole arm, hand empty or part in hand: the straight edge if it is free, else
// through slices of configuration space, one with the wrist at its start values, one with it at the
// goal's, one with it anywhere between; then shortened, every edge certified. Where the slices give
// no way: a proof that there is none, or sampling. Not guaranteed: a way that exists is found
// within the budgets of search and sampling. "Infeasible" is proved. Article: "Global planning",
// steps 5 and 6, Figure 7.
#pragma once

#include "handey/cspace/search.hpp"
#include "handey/cspace/separation.hpp"
#include "handey/motion/sampling.hpp"
#include "handey/motion/shortcut.hpp"

namespace handey {

struct GrossOptions {
  FreeSpaceOptions free_space;
  SearchOptions search;  ///< max_proofs = 0: sampling at once where no straight edge is free
  SeparationOptions separation;  ///< most_cells = 0: no attempt to prove that there is no way
  SamplingOptions sampling;      ///< its certificate holds for straight edges and slices too
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
