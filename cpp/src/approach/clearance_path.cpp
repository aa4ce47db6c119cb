// The search begins at the border, so every stretch from there to a point of the way is as wide as
// can be, not only as wide as the narrowest place, which often is the target itself.
#include "handey/approach/clearance_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>
#include <tuple>

#include "hand_mask.hpp"
#include "handey/errors.hpp"
#include "handey/stop.hpp"

namespace handey {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
// Choice: the target may share cells with what it stands on, this far round it [cells].
constexpr int kRoundTarget = 3;
constexpr double kBlockedLength = 4.0;  // so much longer a step counts there over what is not free

void require(bool good, const std::string& message) {
  if (!good) throw InvalidInput("E_RANGE", "clearance path", message);
}

/// Lower envelope of the parabolas (x - i)^2 + f[i]: squared distances along one line.
void transform_line(std::vector<double>& f, std::vector<double>& scratch, std::vector<int>& roots,
                    std::vector<double>& borders) {
  const int n = static_cast<int>(f.size());
  int count = 0;
  const auto meet = [&](int a, int b) {  // where the parabola of b goes below that of a
    const double fa = f[static_cast<std::size_t>(a)], fb = f[static_cast<std::size_t>(b)];
    return (fb - fa + static_cast<double>(b) * b - static_cast<double>(a) * a) / (2.0 * (b - a));
  };
  for (int i = 0; i < n; ++i) {
    if (f[static_cast<std::size_t>(i)] == kFar) continue;
    double from = -kFar;
    while (count > 0) {
      from = meet(roots[static_cast<std::size_t>(count - 1)], i);
      if (from > borders[static_cast<std::size_t>(count - 1)]) break;
      --count;
    }
    roots[static_cast<std::size_t>(count)] = i;
    borders[static_cast<std::size_t>(count)] = count == 0 ? -kFar : from;
    ++count;
  }
  if (count == 0) return;
  for (int i = 0, k = 0; i < n; ++i) {
    while (k + 1 < count && borders[static_cast<std::size_t>(k + 1)] < i) ++k;
    const int root = roots[static_cast<std::size_t>(k)];
    scratch[static_cast<std::size_t>(i)] =
        static_cast<double>(i - root) * (i - root) + f[static_cast<std::size_t>(root)];
  }
  f = scratch;
}

/// The lattice about the target and how much clearance each point of it has.
class Widest {
 public:
  Widest(const MotionGrid& grid, const GripperOutline& outline, const PlanarPose& target,
         double exit, double enough)
      : target_(target.x, target.y),
        cell_(grid.cell()),
        exit_(exit),
        half_(static_cast<int>(std::ceil(exit / cell_ - 1e-9)) + 1),
        side_(2 * half_ + 1) {
    const PointMask mask = HandMasks(grid, outline, target_, half_, false).at(target.theta);
    std::vector<char> blocked(static_cast<std::size_t>(side_ * side_));
    for (int j = -half_; j <= half_; ++j) {
      for (int i = -half_; i <= half_; ++i) blocked[at(i, j)] = mask.is_set(i, j) ? 1 : 0;
    }
    room_ = distance_transform(blocked, side_);
    for (double& room : room_) room = std::min(room, enough / cell_);
  }

  ClearancePath search();

 private:
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>((j + half_) * side_ + i + half_);
  }
  bool is_exit(int i, int j) const { return cell_ * std::sqrt(i * i + j * j) >= exit_ - 1e-9; }
  bool is_near_target(int i, int j) const {
    return std::max(std::abs(i), std::abs(j)) <= kRoundTarget;
  }
  ClearancePath trace(const std::vector<int>& from) const;

  const Eigen::Vector2d target_;
  const double cell_, exit_;
  const int half_, side_;
  std::vector<double> room_;  // [cells]
};

ClearancePath Widest::search() {
  // Widest first, then shortest, then by index.
  using Entry = std::tuple<double, double, int, int>;  // minus the clearance, length, point, from
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
  std::vector<int> from(room_.size(), -2);
  for (int j = -half_; j <= half_; ++j) {
    for (int i = -half_; i <= half_; ++i) {
      const double room = room_[at(i, j)];
      if (is_exit(i, j) && room > 0.0) open.emplace(-room, 0.0, static_cast<int>(at(i, j)), -1);
    }
  }
  const int goal = static_cast<int>(at(0, 0));
  while (!open.empty() && from[static_cast<std::size_t>(goal)] == -2) {
    throw_if_stopped();
    const auto [narrow, length, point, before] = open.top();
    open.pop();
    if (from[static_cast<std::size_t>(point)] != -2) continue;
    from[static_cast<std::size_t>(point)] = before;
    const int i = point % side_ - half_, j = point / side_ - half_;
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        const int ni = i + di, nj = j + dj;
        if (std::max(std::abs(ni), std::abs(nj)) > half_ || from[at(ni, nj)] != -2) continue;
        const double room = room_[at(ni, nj)];
        const bool near = is_near_target(ni, nj);
        if (room <= 0.0 && !near) continue;
        const double step = std::sqrt(di * di + dj * dj) * (room <= 0.0 ? kBlockedLength : 1.0);
        open.emplace(near ? narrow : std::max(narrow, -room), length + step,
                     static_cast<int>(at(ni, nj)), point);
      }
    }
  }
  return trace(from);
}

ClearancePath Widest::trace(const std::vector<int>& from) const {
  ClearancePath path;
  int point = static_cast<int>(at(0, 0));
  if (from[static_cast<std::size_t>(point)] == -2) return path;
  path.clearance = kFar;
  for (; point >= 0; point = from[static_cast<std::size_t>(point)]) {
    const int i = point % side_ - half_, j = point / side_ - half_;
    path.points.push_back(target_ + cell_ * Eigen::Vector2d(i, j));
    if (!is_near_target(i, j)) {
      path.clearance = std::min(path.clearance, cell_ * room_[static_cast<std::size_t>(point)]);
    }
  }
  std::reverse(path.points.begin(), path.points.end());
  return path;
}

}  // namespace

std::vector<double> distance_transform(const std::vector<char>& marked, int side) {
  require(
      side >= 1 && marked.size() == static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
      "a mask must have side x side cells");
  const std::size_t n = static_cast<std::size_t>(side);
  std::vector<double> squared(marked.size());
  for (std::size_t c = 0; c < marked.size(); ++c) squared[c] = marked[c] != 0 ? 0.0 : kFar;
  std::vector<double> line(n), scratch(n), borders(n);
  std::vector<int> roots(n);
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t along = pass == 0 ? 1 : n, across = pass == 0 ? n : 1;
    for (std::size_t l = 0; l < n; ++l) {
      for (std::size_t i = 0; i < n; ++i) line[i] = squared[l * across + i * along];
      transform_line(line, scratch, roots, borders);
      for (std::size_t i = 0; i < n; ++i) squared[l * across + i * along] = line[i];
    }
  }
  for (double& value : squared) value = std::sqrt(value);
  return squared;
}

GripperOutline finger_tips(const GripperOutline& outline) {
  GripperOutline tips = outline;
  tips.radius = 0.0;
  for (OutlinePiece& piece : tips.pieces) {
    double low = kFar, high = -kFar, ahead = -kFar;
    for (const Eigen::Vector2d& point : piece.polygon) {
      low = std::min(low, point.y());
      high = std::max(high, point.y());
      ahead = std::max(ahead, point.x());
    }
    piece.polygon.clear();
    if (ahead <= 0.0 || low >= 0.0 || high <= 0.0) continue;
    const double radius = std::min(-low, high) / std::cos(std::acos(-1.0) / 8.0);
    for (int corner = 0; corner < 8; ++corner) {
      const double angle = (corner + 0.5) * std::acos(-1.0) / 4.0;
      piece.polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    tips.radius = std::max(tips.radius, radius);
  }
  return tips;
}

ClearancePath clearance_path(const MotionGrid& grid, const GripperOutline& outline,
                             const PlanarPose& target, double exit, double enough) {
  if (!std::isfinite(target.x) || !std::isfinite(target.y) || !std::isfinite(target.theta) ||
      !std::isfinite(exit) || !std::isfinite(enough)) {
    throw InvalidInput("E_NUMBER", "clearance path", "target and lengths must be finite numbers");
  }
  require(static_cast<std::size_t>(grid.layers()) == outline.pieces.size(),
          "there must be one layer for each piece of the gripper");
  require(grid.is_inside({target.x, target.y}), "the target lies outside the grid");
  require(exit > 0.0 && exit <= 2.0 && enough > 0.0 && enough <= 2.0,
          "exit and enough must be in (0, 2] m");
  require(exit / grid.cell() <= 2048.0, "exit is more than 2048 cells");
  ClearancePath path = Widest(grid, outline, target, exit, enough).search();
  if (path.found()) return path;
  path = Widest(grid, finger_tips(outline), target, exit, enough).search();
  path.whole_hand = false;
  return path;
}

}  // namespace handey
