// Candidate hand poses of one pair: targets x directions x pads drawn back from the target, so that
// a long finger tip or a palm finds room where the pad in full depth does not.
#include "candidates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "handey/stop.hpp"
#include "obstruction.hpp"

namespace handey::grasp {
namespace {

constexpr double kPi = 3.14159265358979323846;
// How far the pad is drawn back from the target, in pad lengths. Choice: to where a quarter of the
// pad is left on a target at the very edge.
constexpr double kDrawnBack[] = {0.0, 0.2, 0.4, 0.6};

double turn_between(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * kPi)); }

// Directions of the longest edges of the overlap (at most three different ones), in [0, pi).
std::vector<double> edge_directions(const Region& overlap) {
  struct Edge {
    double length, angle;
  };
  std::vector<Edge> edges;
  for (const Polygon& loop : overlap.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d edge = loop[(i + 1) % loop.size()] - loop[i];
      if (edge.norm() < 1e-6) continue;
      edges.push_back({edge.norm(), std::atan2(edge.y(), edge.x())});
    }
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const Edge& a, const Edge& b) { return a.length > b.length + 1e-9; });
  std::vector<double> directions;
  for (const Edge& edge : edges) {
    if (directions.size() == 3) break;
    const bool is_new = std::none_of(directions.begin(), directions.end(), [&](double known) {
      return std::abs(std::remainder(edge.angle - known, kPi)) < 0.02;
    });
    if (is_new) directions.push_back(edge.angle);
  }
  return directions;
}

// Along and normal to the edges first, then evenly spaced ones that are not nearly the same.
std::vector<double> approach_directions(const RankedPair& pair, int count) {
  std::vector<double> directions;
  const auto add = [&](double theta, double least_apart) {
    const bool is_new = std::none_of(directions.begin(), directions.end(), [&](double known) {
      return turn_between(theta, known) < least_apart;
    });
    if (is_new) directions.push_back(std::remainder(theta, 2.0 * kPi));
  };
  const std::vector<double> edges = edge_directions(pair.pair.overlap);
  for (const double edge : edges) {
    for (int quarter = 0; quarter < 4; ++quarter) add(edge + 0.5 * kPi * (quarter + 1), 0.02);
  }
  const double first = edges.empty() ? 0.0 : edges.front();
  const double spacing = 2.0 * kPi / std::max(1, count);
  for (int i = 0; i < count; ++i) add(first + i * spacing, 0.4 * spacing);
  return directions;
}

/// Over all of the unobstructed area and half a pad round it.
PoseLattice lattice_over(const RankedPair& pair, const Gripper& gripper, double spacing) {
  PoseLattice lattice;
  if (spacing <= 0.0 || pair.unobstructed.empty()) return lattice;
  Eigen::AlignedBox2d extent;
  for (const Polygon& loop : pair.unobstructed.loops) {
    for (const Eigen::Vector2d& corner : loop) extent.extend(corner);
  }
  const double round = 0.5 * std::max(gripper.pad_length, gripper.pad_width);
  const Eigen::Vector2d half = 0.5 * extent.sizes() + Eigen::Vector2d::Constant(round);
  lattice.centre = extent.center();
  lattice.spacing = spacing;
  lattice.columns = static_cast<int>(half.x() / spacing);
  lattice.rows = static_cast<int>(half.y() / spacing);
  return lattice;
}

/// The targets, and the places of the lattice that are near enough.
std::vector<Place> places_of(const RankedPair& pair, const Gripper& gripper,
                             const PoseLattice& lattice) {
  std::vector<Place> places;
  for (const Eigen::Vector2d& target : pair.targets) places.push_back({target, true});
  if (lattice.spacing <= 0.0) return places;
  const double round = 0.5 * std::max(gripper.pad_length, gripper.pad_width);
  for (int row = -lattice.rows; row <= lattice.rows; ++row) {
    throw_if_stopped();
    for (int column = -lattice.columns; column <= lattice.columns; ++column) {
      const Eigen::Vector2d point = lattice.centre + lattice.spacing * Eigen::Vector2d(column, row);
      if ((nearest_point(pair.unobstructed, point) - point).norm() > round) continue;
      places.push_back({point, false, column, row});
    }
  }
  return places;
}

// A fine lattice has a million candidates: between two looks whether to stop.
constexpr std::size_t kComparedAtOnce = 10000;

}  // namespace

FingerRoom::FingerRoom(const RankedPair& pair, const Robot& robot) {
  const FingerExtent finger = finger_extent(robot);
  const double back = std::max(finger.back, -1.5 * robot.gripper.pad_length);
  footprint_ = robot.gripper;
  footprint_.pad_width = 2.0 * finger.half_width;
  footprint_.pad_length = finger.tip - back;
  forward_ = 0.5 * (finger.tip + back);
  const std::vector<Polygon>& loops = pair.blocked.loops;
  const bool has_holes = std::any_of(loops.begin(), loops.end(),
                                     [](const Polygon& loop) { return signed_area(loop) < 0.0; });
  if (has_holes) {
    add(pair.blocked);
  } else {
    for (const Polygon& loop : loops) add(Region{{loop}});
  }
}

void FingerRoom::add(Region region) {
  Eigen::AlignedBox2d box;
  for (const Polygon& loop : region.loops) {
    for (const Eigen::Vector2d& point : loop) box.extend(point);
  }
  blocks_.push_back({std::move(region), box.center(), 0.5 * box.diagonal().norm()});
}

bool FingerRoom::is_blocked(const PlanarPose& pose) const {
  const Eigen::Vector2d along(std::cos(pose.theta), std::sin(pose.theta));
  const PlanarPose middle{pose.x + forward_ * along.x(), pose.y + forward_ * along.y(), pose.theta};
  const Eigen::Vector2d half(0.5 * footprint_.pad_length, 0.5 * footprint_.pad_width);
  double area = 0.0;
  for (const Block& block : blocks_) {
    const Eigen::Vector2d offset = block.centre - Eigen::Vector2d(middle.x, middle.y);
    const double across = along.x() * offset.y() - along.y() * offset.x();
    if (std::abs(along.dot(offset)) > half.x() + block.radius) continue;
    if (std::abs(across) > half.y() + block.radius) continue;
    area += pad_contact_area(block.region, middle, footprint_);
    if (area > 1e-9) return true;
  }
  return false;
}

ContactDemand contact_demand(const RankedPair& pair, const Gripper& gripper,
                             const LegalityOptions& options) {
  const double pad_area = gripper.pad_width * gripper.pad_length;
  ContactDemand demand;
  for (const Eigen::Vector2d& target : pair.targets) {
    for (const double theta : approach_directions(pair, 8)) {
      throw_if_stopped();
      demand.best =
          std::max(demand.best,
                   pad_contact_area(pair.unobstructed, {target.x(), target.y(), theta}, gripper));
    }
  }
  const bool is_line =
      pair.pair.kind == PairKind::FaceEdge || pair.pair.kind == PairKind::ParallelEdges;
  if (pair.pair.kind == PairKind::FaceFace) {
    demand.required = std::max(std::min(options.least_contact_share * pad_area, 0.8 * demand.best),
                               std::min(0.15 * pad_area, 30e-6));
  } else if (is_line) {
    const double full = gripper.pad_length * pair.pair.strip;
    demand.required = std::min(options.least_contact_share * full, 0.8 * demand.best);
  } else {
    demand.required = 0.99 * pair.pair.area;  // a point is inside the pad or not
  }
  return demand;
}

bool is_along_edge(const RankedPair& pair, double theta) {
  for (const double edge : edge_directions(pair.pair.overlap)) {
    if (std::abs(std::remainder(theta - edge, 0.5 * kPi)) < 0.01) return true;
  }
  return false;
}

double planar_merit(const RankedPair& pair, const Gripper& gripper, const PlanarPose& pose,
                    double contact_area, bool along_edge, const Eigen::Vector2d& down_in_G,
                    const ContactDemand& demand) {
  const double contact = demand.best > 0.0 ? std::min(1.0, contact_area / demand.best) : 0.0;
  const double lever = (Eigen::Vector2d(pose.x, pose.y) - pair.centre_of_mass).norm();
  const Eigen::Vector2d direction(std::cos(pose.theta), std::sin(pose.theta));
  const double from_above = 0.5 * (1.0 + direction.dot(down_in_G));
  return 0.35 * contact + 0.25 / (1.0 + lever / gripper.pad_length) + 0.10 * from_above +
         (along_edge ? 0.10 : 0.0);
}

CandidateMaker::CandidateMaker(const RankedPair& pair, const Robot& robot,
                               const Eigen::Vector2d& down_in_G, const ContactDemand& demand,
                               const Hold& hold, const LegalityOptions& options)
    : pair_(pair),
      gripper_(robot.gripper),
      down_in_G_(down_in_G),
      demand_(demand),
      hold_(hold),
      room_(pair, robot),
      directions_(approach_directions(pair, options.directions)) {
  throw_if_stopped();
  for (const double theta : directions_) along_edge_.push_back(is_along_edge(pair, theta) ? 1 : 0);
  lattice_ = lattice_over(pair, gripper_, options.spacing);
  places_ = places_of(pair, gripper_, lattice_);
  lattice_.directions = directions_;
  std::sort(lattice_.directions.begin(), lattice_.directions.end());
  for (const double theta : directions_) {
    const auto at = std::lower_bound(lattice_.directions.begin(), lattice_.directions.end(), theta);
    turns_.push_back(static_cast<int>(at - lattice_.directions.begin()));
  }
}

void CandidateMaker::make(std::size_t slot, CandidateList& list) {
  throw_if_stopped();
  const std::size_t place = slot / directions_.size(), turn = slot % directions_.size();
  const Place& target = places_[place];
  const double theta = directions_[turn];
  for (const double share : kDrawnBack) {
    if (share > 0.0 && !target.is_target) break;  // the lattice has these poses
    const double back = share * gripper_.pad_length;
    Candidate candidate;
    candidate.pose = {target.point.x() - back * std::cos(theta),
                      target.point.y() - back * std::sin(theta), theta};
    if (!target.is_target) candidate.point = {target.column, target.row, turns_[turn]};
    candidate.along_edge = along_edge_[turn] != 0;
    candidate.group = static_cast<int>(slot);
    if (!add(candidate, share == 0.0, list) && share > 0.0) break;
  }
}

bool CandidateMaker::add(const Candidate& drawn_back, bool is_first, CandidateList& list) {
  Candidate candidate = drawn_back;
  const PadContact contact = pad_contact(pair_, candidate.pose, gripper_);
  candidate.contact_area = contact.area;
  if (!demand_.is_met(contact)) {
    // Drawn back until the contact is gone: not one more way that failed.
    if (!is_first) return false;
    ++list.too_little_contact;
    if (contact.area > list.most_contact) {
      list.most_contact = contact.area;
      list.little_contact = candidate.pose;
    }
    return false;
  }
  const double excess = hold_.excess(pair_, contact);
  if (excess > 0.0) {
    if (list.would_turn++ == 0 || excess < list.least_excess) {
      list.least_excess = excess;
      list.turning = candidate.pose;
      list.turn_reason = hold_.reason(pair_, contact);
    }
    return true;
  }
  candidate.promise = planar_merit(pair_, gripper_, candidate.pose, candidate.contact_area,
                                   candidate.along_edge, down_in_G_, demand_);
  // Choice: a pose whose fingers seem blocked is kept (the blocked region errs on the large
  // side) but comes after all the others.
  if (room_.is_blocked(candidate.pose)) candidate.promise -= 1.0;
  list.candidates.push_back(candidate);
  return true;
}

CandidateList make_candidates(const RankedPair& pair, const Robot& robot,
                              const Eigen::Vector2d& down_in_G, const ContactDemand& demand,
                              const Hold& hold, const LegalityOptions& options) {
  CandidateList list;
  CandidateMaker maker(pair, robot, down_in_G, demand, hold, options);
  for (std::size_t slot = 0; slot < maker.slots(); ++slot) maker.make(slot, list);
  std::size_t compared = 0;
  std::stable_sort(list.candidates.begin(), list.candidates.end(),
                   [&compared](const Candidate& a, const Candidate& b) {
                     if (++compared % kComparedAtOnce == 0) throw_if_stopped();
                     return a.promise > b.promise + 1e-12;
                   });
  return list;
}

}  // namespace handey::grasp
