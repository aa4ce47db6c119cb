// Sums over tiles answer for any rectangle of tiles at once; small rectangles get a table of their
// own.
#include "column_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nearest_column.hpp"

namespace handey::world {
namespace {

using Eigen::Vector2d;

constexpr int kMostTiles = 40'000;   // of the table for the whole grid
constexpr int kSmall = 1600;         // a rectangle of fewer columns gets a table of its own
constexpr int kMostCuts = 24;        // places where a cut is tried, along each side
constexpr int kMostSamples = 4000;   // of a regression
constexpr std::size_t kCorners = 8;  // Choice: of an outline
constexpr double kLittle = 0.3;      // a corner that takes up no more is cut off at once [cells^2]

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Where the sides before and after side i meet, if they do within the box; the side then goes.
bool meet(const std::vector<Vector2d>& polygon, std::size_t i, const Vector2d& box, Vector2d& at,
          double& area) {
  const std::size_t n = polygon.size();
  const Vector2d &p = polygon[(i + n - 1) % n], &a = polygon[i], &b = polygon[(i + 1) % n],
                 &q = polygon[(i + 2) % n];
  const Vector2d before = a - p, after = b - q;
  const double turn = cross(before, after);
  if (turn > -1e-12) return false;
  const double along = cross(b - a, after) / turn;
  if (along < 0.0) return false;
  at = a + along * before;
  area = 0.5 * std::abs(cross(at - a, b - a));
  return at.x() >= -0.5 - 1e-9 && at.y() >= -0.5 - 1e-9 && at.x() <= box.x() - 0.5 + 1e-9 &&
         at.y() <= box.y() - 0.5 + 1e-9;
}

/// Leaves out sides whose neighbours meet not far outside, those that add least first.
void simplify(std::vector<Vector2d>& polygon, const Vector2d& box) {
  while (polygon.size() > 4) {
    std::size_t best = polygon.size();
    Vector2d best_at = Vector2d::Zero();
    double least = polygon.size() > kCorners ? std::numeric_limits<double>::infinity() : kLittle;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      Vector2d at = Vector2d::Zero();
      double area = 0.0;
      if (meet(polygon, i, box, at, area) && area < least) {
        least = area;
        best = i;
        best_at = at;
      }
    }
    if (best == polygon.size()) return;
    polygon[best] = best_at;
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>((best + 1) % polygon.size()));
  }
}

/// Adds a point to a chain that turns left only.
void extend(std::vector<Vector2d>& chain, std::size_t first, const Vector2d& point) {
  while (chain.size() >= first + 2 &&
         cross(chain.back() - chain[chain.size() - 2], point - chain.back()) <= 1e-12) {
    chain.pop_back();
  }
  chain.push_back(point);
}

}  // namespace

double Plane::step() const { return std::abs(a) + std::abs(b); }

void ColumnGrid::Sums::add(double x, double y, double z) {
  n += 1;
  u += x;
  v += y;
  w += z;
  uu += x * x;
  uv += x * y;
  vv += y * y;
  uw += x * z;
  vw += y * z;
  ww += z * z;
}

void ColumnGrid::Sums::add(const Sums& o, double sign) {
  n += sign * o.n;
  u += sign * o.u;
  v += sign * o.v;
  w += sign * o.w;
  uu += sign * o.uu;
  uv += sign * o.uv;
  vv += sign * o.vv;
  uw += sign * o.uw;
  vw += sign * o.vw;
  ww += sign * o.ww;
}

Plane ColumnGrid::Sums::plane() const {
  Plane plane;
  if (n < 0.5) return plane;
  const double cuu = uu - u * u / n, cuv = uv - u * v / n, cvv = vv - v * v / n;
  const double cuw = uw - u * w / n, cvw = vw - v * w / n;
  const double determinant = cuu * cvv - cuv * cuv;
  if (determinant > 1e-6 * (1.0 + cuu * cvv)) {
    plane.a = (cuw * cvv - cvw * cuv) / determinant;
    plane.b = (cvw * cuu - cuw * cuv) / determinant;
  } else if (cuu > 0.25 && cuu >= cvv) {
    plane.a = cuw / cuu;
  } else if (cvv > 0.25) {
    plane.b = cvw / cvv;
  }
  plane.at = (w - plane.a * u - plane.b * v) / n;
  return plane;
}

double ColumnGrid::Sums::residual() const {
  if (n < 0.5) return 0.0;
  const Plane p = plane();
  const double cuw = uw - u * w / n, cvw = vw - v * w / n;
  return std::max(0.0, ww - w * w / n - p.a * cuw - p.b * cvw);
}

ColumnGrid::Sums ColumnGrid::SumTable::of(int v0, int v1, int u0, int u1) const {
  const auto at = [&](int v, int u) -> const Sums& {
    return sums[static_cast<std::size_t>(v * (columns + 1) + u)];
  };
  Sums result = at(v1, u1);
  result.add(at(v0, u1), -1.0);
  result.add(at(v1, u0), -1.0);
  result.add(at(v0, u0), 1.0);
  return result;
}

ColumnGrid::ColumnGrid(Columns columns, double empty_cost)
    : rows_(columns.rows), width_(columns.columns), empty_cost_(empty_cost) {
  upper_ = std::move(columns.upper);
  lower_ = std::move(columns.lower);
  full_.resize(upper_.size());
  for (std::size_t i = 0; i < full_.size(); ++i) full_[i] = !std::isnan(upper_[i]);
  count();
  spread(upper_, lower_, wide_upper_[0], wide_lower_[0]);
  for (std::size_t k = 1; k < kSpreads; ++k) {
    spread(wide_upper_[k - 1], wide_lower_[k - 1], wide_upper_[k], wide_lower_[k]);
  }
  fill_empty();
  int tile = 1;
  while (rows_ * (width_ / tile) / tile > kMostTiles) ++tile;
  tiles_ = table_of(all(), tile);
}

void ColumnGrid::fill_empty() {
  source_ = nearest_columns(rows_, width_, full_);
  for (std::size_t i = 0; i < full_.size(); ++i) {
    if (full_[i] != 0 || source_[i] < 0) continue;
    const std::size_t source = static_cast<std::size_t>(source_[i]);
    upper_[i] = upper_[source];
    lower_[i] = lower_[source];
    for (std::size_t k = 0; k < kSpreads; ++k) {
      wide_upper_[k][i] = static_cast<float>(upper_[i]);
      wide_lower_[k][i] = static_cast<float>(lower_[i]);
    }
  }
}

double ColumnGrid::distance(std::size_t i) const {
  if (source_[i] < 0) return std::numeric_limits<double>::infinity();
  const std::size_t source = static_cast<std::size_t>(source_[i]),
                    width = static_cast<std::size_t>(width_);
  const double du = static_cast<double>(i % width) - static_cast<double>(source % width),
               dv = static_cast<double>(i / width) - static_cast<double>(source / width);
  return std::sqrt(du * du + dv * dv);
}

/// One more column aside: first along each row, then across the rows. Empty columns have NaN ends
/// and so do not take part.
template <class From>
void ColumnGrid::spread(const std::vector<From>& upper, const std::vector<From>& lower,
                        std::vector<float>& wide_upper, std::vector<float>& wide_lower) const {
  wide_upper.resize(upper.size());
  wide_lower.resize(lower.size());
  const std::size_t width = static_cast<std::size_t>(width_);
  const auto reach = [](auto own_upper, auto own_lower, auto other_upper, auto other_lower,
                        auto& most, auto& least) {
    most = other_lower <= own_upper ? std::max(most, other_upper) : most;
    least = other_upper >= own_lower ? std::min(least, other_lower) : least;
  };
  // Rows that are spread along themselves: the one before, this one, the one after.
  std::array<std::vector<float>, 3> uppers, lowers;
  const auto along = [&](int v, std::size_t slot) {
    const From *up = upper.data() + index(v, 0), *low = lower.data() + index(v, 0);
    uppers[slot].resize(width);
    lowers[slot].resize(width);
    for (std::size_t u = 0; u < width; ++u) {
      From most = up[u], least = low[u];
      const std::size_t before = u > 0 ? u - 1 : u, after = u + 1 < width ? u + 1 : u;
      reach(up[u], low[u], up[before], low[before], most, least);
      reach(up[u], low[u], up[after], low[after], most, least);
      uppers[slot][u] = static_cast<float>(most);
      lowers[slot][u] = static_cast<float>(least);
    }
  };
  along(0, 1);
  for (int v = 0; v < rows_; ++v) {
    const std::size_t own = static_cast<std::size_t>(v + 1) % 3,
                      after = static_cast<std::size_t>(v + 2) % 3,
                      before = static_cast<std::size_t>(v) % 3;
    if (v + 1 < rows_) along(v + 1, after);
    const std::size_t over = v > 0 ? before : own, under = v + 1 < rows_ ? after : own;
    const float *up = uppers[own].data(), *low = lowers[own].data();
    const float *over_up = uppers[over].data(), *over_low = lowers[over].data();
    const float *under_up = uppers[under].data(), *under_low = lowers[under].data();
    float *most_out = wide_upper.data() + index(v, 0), *least_out = wide_lower.data() + index(v, 0);
    for (std::size_t u = 0; u < width; ++u) {
      float most = up[u], least = low[u];
      reach(up[u], low[u], over_up[u], over_low[u], most, least);
      reach(up[u], low[u], under_up[u], under_low[u], most, least);
      most_out[u] = most;
      least_out[u] = least;
    }
  }
}

void ColumnGrid::count() {
  const std::size_t wide = static_cast<std::size_t>(width_) + 1;
  counts_.assign(wide * (static_cast<std::size_t>(rows_) + 1), 0);
  for (int v = 0; v < rows_; ++v) {
    const std::size_t above = static_cast<std::size_t>(v) * wide;
    std::int32_t row = 0;
    for (int u = 0; u < width_; ++u) {
      row += full_[index(v, u)] != 0 ? 1 : 0;
      const std::size_t i = above + static_cast<std::size_t>(u) + 1;
      counts_[i + wide] = counts_[i] + row;
    }
  }
}

int ColumnGrid::count_in(const Rectangle& r) const {
  const std::size_t wide = static_cast<std::size_t>(width_) + 1;
  const auto at = [&](int v, int u) {
    return counts_[static_cast<std::size_t>(v) * wide + static_cast<std::size_t>(u)];
  };
  return at(r.v1, r.u1) - at(r.v0, r.u1) - at(r.v1, r.u0) + at(r.v0, r.u0);
}

ColumnGrid::SumTable ColumnGrid::table_of(const Rectangle& r, int tile) const {
  SumTable table;
  table.tile = tile;
  table.rows = (r.v1 - r.v0 + tile - 1) / tile;
  table.columns = (r.u1 - r.u0 + tile - 1) / tile;
  const std::size_t wide = static_cast<std::size_t>(table.columns) + 1;
  table.sums.resize(wide * (static_cast<std::size_t>(table.rows) + 1));
  for (int v = r.v0; v < r.v1; ++v) {
    Sums* row = table.sums.data() + static_cast<std::size_t>((v - r.v0) / tile + 1) * wide + 1;
    int left = tile;
    for (int u = r.u0; u < r.u1; ++u) {
      const std::size_t i = index(v, u);
      if (full_[i] != 0) row->add(u - r.u0, v - r.v0, upper_[i]);
      if (--left == 0) {
        left = tile;
        ++row;
      }
    }
  }
  for (std::size_t i = wide; i < table.sums.size(); ++i) {
    if (i % wide == 0) continue;
    table.sums[i].add(table.sums[i - 1], 1.0);
    table.sums[i].add(table.sums[i - wide], 1.0);
    table.sums[i].add(table.sums[i - wide - 1], -1.0);
  }
  return table;
}

bool ColumnGrid::trim(Rectangle& r) const {
  const int total = count_in(r);
  if (total == 0) return false;
  // The last place to which a side can be moved without losing a full column, by halving.
  const auto move = [&](int Rectangle::*side, int to) {
    int keeps = r.*side, loses = to;
    while (std::abs(loses - keeps) > 1) {
      const int middle = (keeps + loses) / 2;
      Rectangle tried = r;
      tried.*side = middle;
      (count_in(tried) == total ? keeps : loses) = middle;
    }
    r.*side = keeps;
  };
  move(&Rectangle::v0, r.v1);
  move(&Rectangle::v1, r.v0);
  move(&Rectangle::u0, r.u1);
  move(&Rectangle::u1, r.u0);
  return true;
}

Plane ColumnGrid::regression(const Rectangle& r) const {
  int stride = 1;
  while (r.size() / stride > kMostSamples) ++stride;
  Sums sums;
  const double middle_u = 0.5 * (r.u1 - r.u0), middle_v = 0.5 * (r.v1 - r.v0);
  int next = 0;  // shifts from row to row, so that no column is passed over
  for (int v = r.v0; v < r.v1; ++v) {
    int k = next;
    for (; k < r.u1 - r.u0; k += stride) {
      const std::size_t i = index(v, r.u0 + k);
      if (full_[i] != 0) sums.add(k - middle_u, v - r.v0 - middle_v, upper_[i]);
    }
    next = k - (r.u1 - r.u0);
  }
  Plane plane = sums.plane();
  plane.at -= plane.a * middle_u + plane.b * middle_v;
  return plane;
}

double ColumnGrid::cost(const SumTable& table, const Rectangle& r, const Rectangle& origin) const {
  const int t = table.tile;
  const Sums sums = table.of((r.v0 - origin.v0) / t, (r.v1 - origin.v0 + t - 1) / t,
                             (r.u0 - origin.u0) / t, (r.u1 - origin.u0 + t - 1) / t);
  Rectangle trimmed = r;
  if (!trim(trimmed)) return 0.0;
  return sums.residual() + empty_cost_ * (trimmed.size() - count_in(r));
}

void ColumnGrid::cut(const Rectangle& r, Rectangle& one, Rectangle& two) const {
  const bool small = r.size() <= kSmall;
  const SumTable own = small ? table_of(r, 1) : SumTable{};
  const SumTable& table = small ? own : tiles_;
  const Rectangle origin = small ? r : all();
  double least = std::numeric_limits<double>::infinity();
  const auto attempt = [&](int Rectangle::*first, int Rectangle::*last) {
    const int length = r.*last - r.*first;
    const int step = std::max(1, length / kMostCuts);
    for (int at = r.*first + std::max(1, step / 2); at < r.*last; at += step) {
      Rectangle a = r, b = r;
      a.*last = b.*first = at;
      const double both = cost(table, a, origin) + cost(table, b, origin);
      // Of equals, the cut nearest to the middle of the longer side.
      const double off = std::abs(2.0 * at - r.*first - r.*last) / length;
      const double longest = std::max(r.v1 - r.v0, r.u1 - r.u0);
      const double weighed = both * (1.0 + 0.02 * off + 0.02 * (1.0 - length / longest)) +
                             1e-15 * (1.0 + off - length / longest);
      if (weighed < least) {
        least = weighed;
        one = a;
        two = b;
      }
    }
  };
  attempt(&Rectangle::u0, &Rectangle::u1);
  attempt(&Rectangle::v0, &Rectangle::v1);
}

std::vector<Vector2d> ColumnGrid::outline(const Rectangle& r) const {
  std::vector<std::pair<int, int>> ends;  // per row: first and last full column, or none
  for (int v = r.v0; v < r.v1; ++v) {
    const char* row = full_.data() + index(v, 0);
    int first = r.u0, last = r.u1 - 1;
    while (first <= last && row[first] == 0) ++first;
    while (last > first && row[last] == 0) --last;
    ends.emplace_back(first - r.u0, last - r.u0);
  }
  std::vector<Vector2d> polygon;
  const auto is_empty = [&](std::size_t k) { return ends[k].first > ends[k].second; };
  for (std::size_t k = 0; k < ends.size(); ++k) {  // the right side, upwards
    if (is_empty(k)) continue;
    for (const double v : {static_cast<double>(k) - 0.5, static_cast<double>(k) + 0.5}) {
      extend(polygon, 0, {ends[k].second + 0.5, v});
    }
  }
  const std::size_t top = polygon.size();
  for (std::size_t k = ends.size(); k-- > 0;) {  // the left side, downwards
    if (is_empty(k)) continue;
    for (const double v : {static_cast<double>(k) + 0.5, static_cast<double>(k) - 0.5}) {
      extend(polygon, top, {ends[k].first - 0.5, v});
    }
  }
  simplify(polygon, {static_cast<double>(r.u1 - r.u0), static_cast<double>(r.v1 - r.v0)});
  return polygon;
}

}  // namespace handey::world
