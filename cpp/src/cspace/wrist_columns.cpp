#include "wrist_columns.hpp"

#include <algorithm>
#include <cmath>

namespace handey::cspace {
namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;
constexpr double kPad = 1e-6;     // of directions [rad]
constexpr double kAtAxis = 1e-3;  // nearer to axis 2 directions are not told apart [m]

/// Sets the bits first .. last.
void set_bits(std::uint64_t* words, int first, int last) {
  if (last < 64) {
    words[0] |= (~std::uint64_t{0} << first) & (~std::uint64_t{0} >> (63 - last));
    return;
  }
  for (int word = first / 64; word <= last / 64; ++word) {
    const int from = std::max(0, first - 64 * word), to = std::min(63, last - 64 * word);
    words[word] |= (~std::uint64_t{0} << from) & (~std::uint64_t{0} >> (63 - to));
  }
}

/// The point as the elbow turns: phi is its angle there, from the direction away from axis 2.
struct Orbit {
  double elbow = 0.0, radius = 0.0;  ///< elbow from axis 2, point from the elbow [m]

  double distance(double phi) const {
    return std::sqrt(
        std::max(0.0, elbow * elbow + radius * radius + 2.0 * elbow * radius * std::cos(phi)));
  }
  double direction(double phi) const {
    return std::atan2(radius * std::sin(phi), elbow + radius * std::cos(phi));
  }
};

/// The angles from 0 to pi at which the point passes from ring to ring, or its distance from axis 2
/// or its direction turns back.
std::vector<double> turning_points(const Orbit& orbit, double ring_width) {
  std::vector<double> angles{0.0, 0.5 * kTurn};
  const double product = orbit.elbow * orbit.radius;
  if (orbit.radius < orbit.elbow) angles.push_back(std::acos(-orbit.radius / orbit.elbow));
  for (int ring = 1; product > 1e-12 && ring * ring_width < orbit.elbow + orbit.radius; ++ring) {
    const double distance = ring * ring_width;
    const double cosine =
        (distance * distance - orbit.elbow * orbit.elbow - orbit.radius * orbit.radius) /
        (2.0 * product);
    if (cosine > -1.0 && cosine < 1.0) angles.push_back(std::acos(cosine));
  }
  return angles;
}

/// Those between two angles, on both sides and at every turn, and the two, in order.
std::vector<double> breaks(const std::vector<double>& turning, double from, double to) {
  std::vector<double> angles{from, to};
  for (const double angle : turning) {
    for (const double side : {angle, -angle}) {
      for (double at = side + kTurn * std::ceil((from - side) / kTurn); at < to; at += kTurn) {
        angles.push_back(at);
      }
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

}  // namespace

void WristColumns::add(int ring, const Stay& stay) {
  first_ring_ = std::min(first_ring_, ring);
  last_ring_ = std::max(last_ring_, ring + 1);
  std::vector<Stay>& stays = rings_[static_cast<std::size_t>(ring)];
  // What goes on from the one before is one stay with it.
  if (!stays.empty() && stays.back().column == stay.column && stay.lower <= stays.back().upper &&
      stay.upper >= stays.back().lower) {
    stays.back().lower = std::min(stays.back().lower, stay.lower);
    stays.back().upper = std::max(stays.back().upper, stay.upper);
  } else {
    stays.push_back(stay);
  }
}

WristColumns::WristColumns(const PolarGrid& grid, const Lattice& lattice, int level,
                           const ArmPlane& plane, const Eigen::Vector2d& point)
    : words_((grid.row_count + 63) / 64) {
  const Orbit orbit{plane.elbow.norm(), point.norm()};
  rings_.resize(static_cast<std::size_t>((orbit.elbow + orbit.radius) / grid.width) + 2);
  first_ring_ = static_cast<int>(rings_.size());
  const double away = std::atan2(plane.elbow.y(), plane.elbow.x());
  const double start = std::atan2(point.y(), point.x()) - away;
  const int columns = lattice.cells(level, 2);
  const double width = lattice.cell_width(level, 2);
  const std::vector<double> turning = turning_points(orbit, grid.width);
  for (int column = 0; column < columns; ++column) {
    const double one = start + plane.elbow_sense * (lattice.lower[2] + column * width);
    const double two = one + plane.elbow_sense * width;
    const std::vector<double> angles = breaks(turning, std::min(one, two), std::max(one, two));
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
      const double middle = 0.5 * (angles[i] + angles[i + 1]);
      const int ring = static_cast<int>(orbit.distance(middle) / grid.width);
      // Directions at the ends, near that in the middle; anything next to axis 2.
      const double direction = orbit.direction(middle);
      const double before = std::remainder(orbit.direction(angles[i]) - direction, kTurn);
      const double after = std::remainder(orbit.direction(angles[i + 1]) - direction, kTurn);
      const bool at_axis =
          std::min(orbit.distance(angles[i]), orbit.distance(angles[i + 1])) < kAtAxis;
      const double lower = at_axis ? -0.5 * kTurn : std::min({before, after, 0.0}) - kPad;
      const double upper = at_axis ? 0.5 * kTurn : std::max({before, after, 0.0}) + kPad;
      add(ring,
          {column, (away + direction + lower) / grid.row, (away + direction + upper) / grid.row});
    }
  }
  first_ring_ = std::min(first_ring_, last_ring_);
}

void WristColumns::mark(const PolarGrid& grid, const RingSpan& span,
                        std::vector<std::uint64_t>& columns) const {
  if (span.ring < first_ring_ || span.ring >= last_ring_) return;
  // In cells of theta2, counted from its lower limit.
  const double per_row = 1.0 / grid.row, turn = kTurn * per_row;
  const double from = (span.lower - grid.lower) * per_row;
  const double to = (span.upper - grid.lower) * per_row;
  const double range = grid.row_count;
  for (const Stay& stay : rings_[static_cast<std::size_t>(span.ring)]) {
    // theta2 carries the stay into the span between these two, and a turn on, and so forth.
    double lower = from - stay.upper, upper = to - stay.lower;
    while (upper < 0.0) lower += turn, upper += turn;
    while (upper >= turn) lower -= turn, upper -= turn;
    std::uint64_t* words = columns.data() + stay.column * words_;
    for (; lower <= range; lower += turn, upper += turn) {
      const int first = static_cast<int>(std::max(0.0, lower));
      const int last = static_cast<int>(std::min(range, upper));
      set_bits(words, std::min(first, grid.row_count - 1), std::min(last, grid.row_count - 1));
    }
  }
}

}  // namespace handey::cspace
