// A* from both ends at once over the boxes of the slices. The side with fewer open boxes goes on,
// so an end in a narrow place finds its way out before the other floods the open. It ends when no
// way through open boxes can be quicker than the best meeting found.
#include "handey/cspace/search.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "box_neighbours.hpp"
#include "handey/errors.hpp"
#include "handey/stop.hpp"
#include "search_sides.hpp"
#include "stance_samples.hpp"

namespace handey {
namespace {

using cspace::kInfinity;
using cspace::Label;
using cspace::Open;
using cspace::Side;

// Choice: a side leaps after so many proofs; a leap costs as much as ten.
constexpr int kLeapEvery = 30;
constexpr std::size_t kTurnEvery = 3;  // leaps to one turn of the wrist to its stance at home
// Choice: searches that take so many proofs look for other stances of the wrist; one for so many
// proofs on a side.
constexpr int kHard = 200;
constexpr int kStanceEvery = 5;

class Search {
 public:
  Search(FreeSpace& space, const SearchOptions& options)
      : space_(space),
        options_(options),
        clock_(space, *space.checker().cell().robot),
        stances_(space) {}

  SearchResult run() {
    const int windows = static_cast<int>(options_.windows.size());
    for (int i = 0; i < windows; ++i) {
      const double window = options_.windows[static_cast<std::size_t>(i)];
      tell_progress("window", i + 1, windows);
      space_.set_window(window);
      result_.window = window;
      if (!connect_ends()) {
        if (is_spent()) break;
        continue;
      }
      search();
      if (best_ < kInfinity) {
        result_.found = true;
        result_.goal = goal_;
        trace();
        break;
      }
      if (is_spent()) break;
    }
    result_.proofs = space_.proofs();
    if (!result_.found && result_.reason.empty()) explain();
    return std::move(result_);
  }

 private:
  bool is_spent() const { return space_.proofs() > options_.max_proofs; }

  // Open entries for the boxes from which each end can be reached. False, with a reason, if there
  // is none on a side.
  bool connect_ends() {
    result_.reason.clear();
    best_ = kInfinity;
    for (Side& side : sides_) side = Side{};
    sides_[0].ends = cspace::connect_end(space_, 0, space_.start_point(), options_.certificate,
                                         options_.max_proofs);
    if (sides_[0].ends.empty()) {
      result_.reason = "the start can be connected to no free box of its slice";
      return false;
    }
    for (int goal = 0; goal < static_cast<int>(space_.goals().size()); ++goal) {
      for (const cspace::EndConnection& end :
           cspace::connect_end(space_, 2 + 2 * goal, space_.goal_point(goal), options_.certificate,
                               options_.max_proofs)) {
        sides_[1].ends.push_back(end);
      }
    }
    if (sides_[1].ends.empty()) {
      result_.reason = space_.goals().size() == 1
                           ? "the goal can be connected to no free box of its slice"
                           : "none of the goals can be connected to a free box of its slice";
      return false;
    }
    for (int s = 0; s < 2; ++s) {
      const std::vector<cspace::EndConnection>& ends = sides_[s].ends;
      for (std::size_t i = 0; i < ends.size(); ++i) {
        const int slice = space_.box(ends[i].box).slice;
        const int goal = slice == 0 ? -1 : FreeSpace::goal_of(slice);
        push(s, ends[i].box, -2 - static_cast<int>(i), goal,
             clock_.time(ends[i].end, ends[i].point, goal), ends[i].point);
      }
    }
    return true;
  }

  // Least time from a point to the other side's ends, whatever is in the way.
  double estimate(int s, int slice, int goal, const SlicePoint& point) const {
    if (s == 1) return clock_.time(point, space_.start_point(), goal);
    if (slice > 0 && !space_.is_stance(slice)) {
      const int own = FreeSpace::goal_of(slice);
      return clock_.time(point, space_.goal_point(own), own);
    }
    double least = kInfinity;
    for (int g = 0; g < static_cast<int>(space_.goals().size()); ++g) {
      least = std::min(least, clock_.time(point, space_.goal_point(g), g));
    }
    return least;
  }

  void push(int s, int box, int before, int goal, double cost, const SlicePoint& entry) {
    const double ahead = options_.detour * estimate(s, space_.box(box).slice, goal, entry);
    const Open open{cost + ahead, cost, order_++, box, before, goal, entry};
    sides_[s].open.push(open);
    double farthest = 0.0;
    const SlicePoint end = s == 0 ? space_.start_point() : space_.goal_point(goal);
    for (std::size_t j = 0; j < 3; ++j) farthest += (entry[j] - end[j]) * (entry[j] - end[j]);
    sides_[s].outward.push({farthest, open});
  }

  void search() {
    while (!sides_[0].open.empty() && !sides_[1].open.empty() && !is_spent()) {
      throw_if_stopped();
      const double bound = std::max(sides_[0].open.top().estimate, sides_[1].open.top().estimate);
      if (best_ <= bound || (best_ < kInfinity && options_.detour > 1.0)) return;
      expand(sides_[0].open.size() <= sides_[1].open.size() ? 0 : 1);
    }
  }

  Label& label(int s, int box) {
    std::vector<Label>& labels = sides_[s].labels;
    if (box >= static_cast<int>(labels.size())) {
      labels.resize(static_cast<std::size_t>(space_.size()) + 64);
    }
    return labels[static_cast<std::size_t>(box)];
  }

  void expand(int s) {
    Side& side = sides_[s];
    const bool outward = side.turn++ % 2 == 1 && !side.outward.empty();
    const Open next = outward ? side.outward.top().second : side.open.top();
    if (outward) {
      side.outward.pop();
    } else {
      side.open.pop();
    }
    if (next.estimate >= best_) return;
    if (label(s, next.box).cost < kInfinity) return;
    if (space_.prove(next.box) != SliceBox::State::Free) {
      if (space_.split(next.box)) {
        cspace::visit_parts(space_, next.before, next.box,
                            [&](int part) { reach(s, next.before, part); });
      }
      return;
    }
    label(s, next.box) = {next.cost, next.before, next.goal, next.entry};
    meet(s, next.box);
    if (side.beacons.empty() || space_.proofs() >= side.next_leap) {
      leap(s, next.box);
      if (side.beacons.size() % kTurnEvery == 0) turn_home(s, next.box);
      side.beacons.push_back(next.box);
      side.next_leap = space_.proofs() + kLeapEvery;
    }
    cspace::visit_neighbours(space_, next.box, [&](int other) { reach(s, next.box, other); });
    if (space_.proofs() > kHard && space_.proofs() >= side.next_stance) {
      take_stance(s);
      side.next_stance = space_.proofs() + kStanceEvery;
    }
  }

  // Opens `to`, entered from `from`, where the two touch.
  void reach(int s, int from, int to) {
    if (label(s, to).cost < kInfinity) return;
    const Label& here = label(s, from);
    const int slice = space_.box(to).slice;
    const int goal = slice > 0 && !space_.is_stance(slice) ? FreeSpace::goal_of(slice) : here.goal;
    // In the start's slice the wrist stands still, so ways to all goals meet there.
    const SlicePoint aim = s == 0 && goal >= 0 ? space_.goal_point(goal) : target(s, here.entry);
    const SlicePoint entry = cspace::crossing(space_, from, to, here.entry, aim);
    const double cost = here.cost + clock_.time(here.entry, entry, goal);
    if (cost < best_) push(s, to, from, goal, cost, entry);
  }

  SlicePoint target(int s, const SlicePoint& point) const {
    if (s == 1) return space_.start_point();
    int nearest = 0;
    double least = kInfinity;
    for (int g = 0; g < static_cast<int>(space_.goals().size()); ++g) {
      const double time = clock_.time(point, space_.goal_point(g), g);
      if (time < least) {
        least = time;
        nearest = g;
      }
    }
    return space_.goal_point(nearest);
  }

  void meet(int s, int box) {
    const Label& mine = label(s, box);
    const Label& other = label(1 - s, box);
    if (other.cost == kInfinity) return;
    const int goal = s == 1 ? mine.goal : other.goal;
    const double cost = mine.cost + other.cost + clock_.time(mine.entry, other.entry, goal);
    if (cost >= best_) return;
    best_ = cost;
    meeting_ = {box, box};
    goal_ = goal;
  }

  // Tries the straight edge, all joints at once, to a box of the other side: by turns the one
  // through which the whole way would be quickest, the nearest one, and one of the newest (those
  // are out of a narrow place).
  void leap(int s, int box) {
    const Label mine = label(s, box);
    const std::vector<int>& all = sides_[1 - s].beacons;
    const int rule = sides_[s].leaps++ % 3;
    int best = -1, goal = -1;
    double least = kInfinity, way = 0.0;
    for (std::size_t i = rule == 2 && all.size() > 2 ? all.size() - 2 : 0; i < all.size(); ++i) {
      const Label& other = label(1 - s, all[i]);
      const int towards = s == 1 ? mine.goal : other.goal;
      const double edge = leap_time(s, box, all[i], towards);
      const double whole = mine.cost + other.cost + edge;
      const double value = rule == 1 ? edge : whole;
      if (value >= least || whole >= best_) continue;
      least = value;
      way = whole;
      best = all[i];
      goal = towards;
    }
    if (best < 0) return;
    if (!is_edge_free(at(s, box), at(1 - s, best))) return;
    best_ = way;
    meeting_ = s == 0 ? std::array<int, 2>{box, best} : std::array<int, 2>{best, box};
    goal_ = goal;
  }

  // Turns the wrist to where it is at home, the arm standing still. That slice is common to both
  // sides and to all goals, and the hand is slim there.
  void turn_home(int s, int box) {
    const int home = space_.home_slice();
    if (space_.box(box).slice == home) return;
    SlicePoint point = label(s, box).entry;
    const int there = space_.box_at(home, point);
    if (there < 0 || space_.box(there).state != SliceBox::State::Free) return;
    if (label(s, there).cost < kInfinity) return;
    const Configuration from = space_.configuration(space_.box(box).slice, point);
    if (!is_edge_free(from, space_.configuration(home, point))) return;
    const Label& mine = label(s, box);
    point[3] = 0.5;
    push(s, there, box, mine.goal, mine.cost + clock_.time(mine.entry, point, mine.goal), point);
  }

  // Moves all joints at once from where this side is to a stance of the wrist that is neither the
  // start's nor the goal's nor between, and leaps from there: the way out of places that can only
  // be left so.
  void take_stance(int s) {
    Side& side = sides_[s];
    const Eigen::VectorXd aim = stances_.next();
    int from = -1;
    double least = kInfinity;
    for (const int box : side.beacons) {
      const double distance = stances_.distance(at(s, box).q, aim);
      if (distance >= least) continue;
      least = distance;
      from = box;
    }
    if (from < 0) return;
    const Configuration here = at(s, from);
    const Configuration there{stances_.towards(here.q, aim), here.opening};
    if (!is_edge_free(here, there)) return;
    const int slice = space_.add_stance(there.q);
    const SlicePoint point{there.q(0), there.q(1), there.q(2), 0.5};
    int box = space_.box_at(slice, point);
    const bool boxed = box >= 0 && space_.box(box).state == SliceBox::State::Free;
    if (!boxed) box = space_.add_point(slice);
    const Label mine = label(s, from);
    label(s, box) = {mine.cost + clock_.time(mine.entry, point, mine.goal), from, mine.goal, point};
    leap(s, box);
    side.beacons.push_back(box);
    if (boxed) {
      cspace::visit_neighbours(space_, box, [&](int other) { reach(s, box, other); });
    }
  }

  /// Where this side entered a box.
  Configuration at(int s, int box) {
    return space_.configuration(space_.box(box).slice, label(s, box).entry);
  }

  // Most edges that are tried are not free, and a look at three configurations tells it of most.
  bool is_edge_free(const Configuration& a, const Configuration& b) {
    for (const double share : {0.5, 0.25, 0.75}) {
      const Configuration between{a.q + share * (b.q - a.q), a.opening};
      if (!space_.checker().is_free(between, options_.certificate.clearance)) return false;
    }
    return certify_edge(space_.checker(), a, b, options_.certificate).is_free();
  }

  double leap_time(int s, int box, int other, int goal) {
    return clock_.time(label(s, box).entry, label(1 - s, other).entry, goal);
  }

  // The way from the meeting back to one side's end, the end included.
  std::vector<std::pair<int, SlicePoint>> way(int s) {
    std::vector<std::pair<int, SlicePoint>> way;
    int box = meeting_[static_cast<std::size_t>(s)];
    while (box >= 0) {
      const Label& here = label(s, box);
      way.emplace_back(space_.box(box).slice, here.entry);
      box = here.before;
    }
    const cspace::EndConnection& end = sides_[s].ends[static_cast<std::size_t>(-2 - box)];
    way.emplace_back(space_.box(end.box).slice, end.end);
    return way;
  }

  void trace() {
    std::vector<std::pair<int, SlicePoint>> points = way(0);
    std::reverse(points.begin(), points.end());
    for (const auto& point : way(1)) points.push_back(point);
    int last = -1;
    for (const auto& [slice, point] : points) {
      if (slice > space_.home_slice() && slice != last) ++result_.stances;
      last = slice;
    }
    std::vector<Configuration>& path = result_.path;
    path.push_back(space_.start());
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const Configuration next = space_.configuration(points[i].first, points[i].second);
      if ((next.q - path.back().q).cwiseAbs().maxCoeff() > 1e-9) path.push_back(next);
    }
    const Configuration& goal = space_.goals()[static_cast<std::size_t>(goal_)];
    if (path.size() > 1 && (goal.q - path.back().q).cwiseAbs().maxCoeff() <= 1e-9) path.pop_back();
    path.push_back(goal);
  }

  void explain() {
    char text[160];
    if (is_spent()) {
      std::snprintf(text, sizeof text,
                    "no way among %d boxes of the slices, the most that are looked at",
                    space_.proofs());
    } else {
      std::snprintf(text, sizeof text,
                    "the free boxes of the slices do not join start and goal (%d looked at)",
                    space_.proofs());
    }
    result_.reason = text;
  }

  FreeSpace& space_;
  const SearchOptions& options_;
  cspace::Clock clock_;
  cspace::StanceSamples stances_;
  std::array<Side, 2> sides_;
  SearchResult result_;
  double best_ = kInfinity;
  std::array<int, 2> meeting_{-1, -1};  ///< the same box, or two with a certified edge between
  int goal_ = -1;
  long order_ = 0;
};

}  // namespace

SearchResult search_free_space(FreeSpace& space, const SearchOptions& options) {
  if (options.windows.empty()) throw InvalidInput("E_EMPTY", "windows", "expected at least one");
  if (!(options.detour >= 1.0)) throw InvalidInput("E_RANGE", "detour", "expected 1 or more");
  return Search(space, options).run();
}

}  // namespace handey
