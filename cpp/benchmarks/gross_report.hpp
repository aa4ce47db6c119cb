// What is kept of every query, and the table made of it, in Markdown.
#pragma once

#include <string>
#include <vector>

#include "gross_scenes.hpp"

namespace benchmark {

struct Outcome {
  bool solved = false, valid = false;
  bool direct = false;  ///< the straight edge from start to goal is proved free
  std::string planner;
  std::string reason;                                     ///< why it is not solved or not valid
  double scene = 0.0, planning = 0.0, simplifying = 0.0;  ///< CPU [ms]; the last: the peer's alone
  double length = 0.0;                                    ///< of the path in joint space [rad]
  double travel = 0.0;                                    ///< at the velocity limits [s]
  double all() const { return scene + planning + simplifying; }
};

/// By query; the peer may have been asked the first ones only.
struct Measured {
  std::vector<Outcome> handey, peer;
};

void print_head();
void print_rows(const std::string& name, const Measured& measured);
void print_legend();
/// How far inside the pigeonholes the hand is.
void print_depths(const std::vector<Setting>& settings);
/// One line.
void print_query(const std::string& name, std::size_t number, const Query& query,
                 const Outcome& outcome);

}  // namespace benchmark
