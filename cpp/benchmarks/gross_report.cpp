#include "gross_report.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace benchmark {
namespace {

using Outcomes = std::vector<Outcome>;

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

template <class Claim>
Outcomes those(const Outcomes& outcomes, const Claim& claim) {
  Outcomes result;
  std::copy_if(outcomes.begin(), outcomes.end(), std::back_inserter(result), claim);
  return result;
}

template <class Claim>
double percent(const Outcomes& outcomes, const Claim& claim) {
  const double count = static_cast<double>(those(outcomes, claim).size());
  return outcomes.empty() ? 0.0 : 100.0 * count / static_cast<double>(outcomes.size());
}

template <class Value>
double quantile_of(const Outcomes& outcomes, const Value& value, double share) {
  std::vector<double> values;
  for (const Outcome& outcome : outcomes) values.push_back(value(outcome));
  return quantile(std::move(values), share);
}

template <class Value>
std::string median_and_p95(const Outcomes& outcomes, const Value& value) {
  if (outcomes.empty()) return "";
  char text[64];
  std::snprintf(text, sizeof text, "%.2f / %.1f", quantile_of(outcomes, value, 0.5),
                quantile_of(outcomes, value, 0.95));
  return text;
}

bool is_solved(const Outcome& outcome) { return outcome.solved; }
bool is_valid(const Outcome& outcome) { return outcome.valid; }
bool is_detour(const Outcome& outcome) { return !outcome.direct; }
double scene(const Outcome& outcome) { return outcome.scene; }
double planning(const Outcome& outcome) { return outcome.planning; }
double all(const Outcome& outcome) { return outcome.all(); }
double length(const Outcome& outcome) { return outcome.length; }
double travel(const Outcome& outcome) { return outcome.travel; }

// Median over the queries that both solved.
template <class Value>
double median_ratio(const Measured& measured, const Value& value) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < measured.peer.size(); ++i) {
    if (!measured.handey[i].solved || !measured.peer[i].solved) continue;
    ratios.push_back(value(measured.handey[i]) / value(measured.peer[i]));
  }
  return quantile(std::move(ratios), 0.5);
}

void print_row(const std::string& name, const char* planner, const Outcomes& outcomes,
               const std::string& ratio, const std::string& shares) {
  const Outcomes solved = those(outcomes, is_solved);
  const std::string times = median_and_p95(outcomes, planning) + " | " +
                            median_and_p95(outcomes, all) + " | " +
                            median_and_p95(those(outcomes, is_detour), all);
  char quality[64] = " | | |";
  if (!solved.empty()) {
    std::snprintf(quality, sizeof quality, "%.0f %% | %.2f | %.2f |", percent(solved, is_valid),
                  quantile_of(solved, length, 0.5), quantile_of(solved, travel, 0.5));
  }
  std::printf("| %s | %s | %.0f %% | %s %.2f | %s | %s | %s |\n", name.c_str(), planner,
              percent(outcomes, is_solved), quality, quantile_of(outcomes, scene, 0.5),
              times.c_str(), ratio.c_str(), shares.c_str());
}

}  // namespace

void print_head() {
  const char* const columns[] = {"scene",           "planner",      "solved",
                                 "valid",           "length [rad]", "travel [s]",
                                 "making scene",    "planning",     "in all",
                                 "in all, detours", "to OMPL's",    "straight / slices / fallback"};
  std::string head = "|", line = "|";
  for (const char* column : columns) {
    head += std::string(" ") + column + " |";
    line += " --- |";
  }
  std::printf("\n%s\n%s\n", head.c_str(), line.c_str());
}

void print_rows(const std::string& name, const Measured& measured) {
  const auto share = [&](const char* planner) {
    return percent(measured.handey, [planner](const Outcome& outcome) {
      return outcome.solved && outcome.planner == planner;
    });
  };
  const double straight = share("straight"), slices = share("slices");
  const double fallback = percent(measured.handey, is_solved) - straight - slices;
  char shares[64], ratio[64] = "";
  std::snprintf(shares, sizeof shares, "%.0f / %.0f / %.0f %%", straight, slices, fallback);
  if (median_ratio(measured, length) > 0.0) {
    std::snprintf(ratio, sizeof ratio, "%.2f / %.2f", median_ratio(measured, length),
                  median_ratio(measured, travel));
  }
  print_row(name, "handey", measured.handey, ratio, shares);
  if (!measured.peer.empty()) print_row("", "OMPL + FCL", measured.peer, "", "");
  std::fflush(stdout);
}

void print_legend() {
  std::printf(
      "\nvalid: of the paths returned. Times are of the processor in ms, median / p95 over all "
      "queries, solved or not. Making scene: its collision geometry (median). Planning: handey's "
      "with shortening and certificate, OMPL's before simplification. In all: scene, planning, "
      "simplification. Detours: the queries whose straight edge is blocked. Length in joint space "
      "and least travel time: medians of the paths; to OMPL's: medians of the ratios of these "
      "where "
      "both gave a path.\n");
}

void print_depths(const std::vector<Setting>& settings) {
  std::vector<double> depths;
  for (const Setting& setting : settings) {
    for (const Query& query : setting.queries) depths.push_back(1e3 * query.inside);
  }
  std::printf(
      "\nIn the shelf the finger tips are %.0f to %.0f mm inside the pigeonhole, median %.0f.\n",
      quantile(depths, 0.0), quantile(depths, 1.0), quantile(depths, 0.5));
}

void print_query(const std::string& name, std::size_t number, const Query& query,
                 const Outcome& outcome) {
  const char* const verdict = !outcome.solved ? "UNSOLVED" : (outcome.valid ? "valid" : "INVALID");
  std::printf("%s %zu: %s %s, %.2f + %.2f + %.2f ms, %.2f rad, %.2f s", name.c_str(), number,
              outcome.planner.c_str(), verdict, outcome.scene, outcome.planning,
              outcome.simplifying, outcome.length, outcome.travel);
  if (outcome.direct) std::printf(", direct");
  if (query.inside > 0.0) std::printf(", %.0f mm inside", 1e3 * query.inside);
  std::printf("%s%s\n", outcome.reason.empty() ? "" : ": ", outcome.reason.c_str());
  std::fflush(stdout);
}

}  // namespace benchmark
