// Cuts rectangles of columns in two, the worst first, and joins neighbours that one solid covers as
// well.
#include "column_cover.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <utility>

#include "column_grid.hpp"

namespace handey::world {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kExact = 1e-9;  // less stands out by rounding only [m]
// Choice: what lies behind the measured surface is met only by an arm that comes from behind.
constexpr double kBehind = 4.0;
constexpr int kMostExactSolids = 3000;  // Choice: of those that must be exact; beyond, none has to
constexpr int kJoinRounds = 4;
constexpr int kMany = 8000;            // columns: more have parts that are farther aside
constexpr double kDiagonal = 1.41422;  // of a square, a little more
constexpr double kThinnest = 1e-6;     // part of w that must lie between the planes at each corner
constexpr double kLevel = 1e-12;       // a slope that changes w by less, as a part of it, is none
constexpr double kRounding = 1e-13;    // of w

/// A rectangle of columns and the solid that covers them.
struct Block {
  Rectangle rectangle;
  std::vector<Vector2d> outline;  // from the rectangle's first cell, as the planes
  Plane upper, lower;
  double excess = 0.0;
  double ratio = 0.0;  // excess over what is tolerated there
  bool near_place = false;
  bool must_split() const { return near_place && excess > kExact && rectangle.size() > 1; }
};

struct Worse {
  bool operator()(const Block& a, const Block& b) const {
    if (a.must_split() != b.must_split()) return b.must_split();
    if (a.ratio != b.ratio) return a.ratio < b.ratio;
    return std::make_pair(a.rectangle.v0, a.rectangle.u0) >
           std::make_pair(b.rectangle.v0, b.rectangle.u0);
  }
};

struct Spread {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

/// How the columns' ends lie above two planes, and how far empty ones are from full ones.
struct Fit {
  Spread upper, lower;                  // of all columns
  double highest = 0.0, deepest = 0.0;  // of full ones: highest upper end, deepest lower end
  double aside = 0.0;                   // [cells]
};

/// Columns [first, last] of a row whose squares the outline meets.
std::pair<int, int> row_of(const std::vector<Vector2d>& outline, int v, int columns) {
  Spread across;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double low = std::max(std::min(a.y(), b.y()), v - 0.5),
                 high = std::min(std::max(a.y(), b.y()), v + 0.5);
    if (low > high) continue;
    if (std::abs(b.y() - a.y()) < 1e-12) {
      across.add(a.x());
      across.add(b.x());
      continue;
    }
    for (const double y : {low, high}) {
      across.add(a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()));
    }
  }
  const int first = static_cast<int>(std::floor(across.least + 0.5 + 1e-9)),
            last = static_cast<int>(std::ceil(across.most - 0.5 - 1e-9));
  return {std::max(first, 0), std::min(last, columns - 1)};
}

class Coverer {
 public:
  Coverer(Columns columns, const Pose& X_WD, const DepthMapOptions& options)
      : space_(columns.space),
        options_(options),
        cost_(empty_cost(columns, options)),
        grid_(std::move(columns), cost_) {
    set_places(X_WD);
  }

  Cover run() const;

 private:
  static double empty_cost(const Columns& columns, const DepthMapOptions& options);
  void set_places(const Pose& X_WD);
  std::optional<Block> fit(Rectangle rectangle) const;
  Fit measure(const Block& block, std::size_t spread) const;
  bool set_planes(Block& block, const Plane& upper) const;
  Plane behind(const Block& block, const Plane& upper) const;
  void judge(Block& block, double cells, double upper_out, double lower_out, double allowed) const;
  Prism solid_of(const Block& block) const;
  double tolerance(const Prism& solid) const;
  bool within_reach(const Prism& solid) const;
  bool is_near_place(const Prism& solid) const;
  std::optional<Block> joined(const Block& a, const Block& b) const;
  void join(std::vector<Block>& blocks) const;
  std::vector<Block> cut() const;

  ColumnSpace space_;
  const DepthMapOptions& options_;
  double cost_;
  ColumnGrid grid_;
  std::vector<PlaceBox> places_;
  std::vector<std::pair<Vector3d, double>> balls_;  // round the places, map frame
  Vector3d reach_centre_ = Vector3d::Zero();
};

/// What stands out over an empty column weighs as much as twice the tolerance.
double Coverer::empty_cost(const Columns& columns, const DepthMapOptions& options) {
  double scale = 1.0;
  if (columns.space.perspective) {
    double sum = 0.0, count = 1e-9;
    for (const double w : columns.upper) {
      if (std::isnan(w)) continue;
      sum += w;
      count += 1.0;
    }
    scale = (sum / count) * (sum / count);
  }
  return 4.0 * options.excess * options.excess * scale * scale;
}

void Coverer::set_places(const Pose& X_WD) {
  const Pose X_DW = X_WD.inverse();
  reach_centre_ = X_DW * options_.reach_centre;
  for (const Body& place : options_.places) {
    Eigen::AlignedBox3d all;
    for (const Shape& shape : place.shapes) {
      // The box of the shape in its own frame: small for boxes and cylinders in any direction.
      Shape own = shape;
      own.X_BS = Pose::Identity();
      Eigen::AlignedBox3d box;
      for (const Vector3d& vertex : tessellate(own).vertices) box.extend(vertex);
      const Pose X_DS = X_DW * place.X_WB * shape.X_BS;
      const Pose X_DO = X_DS * Eigen::Translation3d(box.center());
      places_.push_back(
          {X_DO.inverse(), Vector3d(0.5 * box.sizes().array() + options_.exact_within)});
      for (int k = 0; k < 8; ++k) {
        all.extend(X_DS * Vector3d(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k))));
      }
    }
    if (!all.isEmpty()) balls_.emplace_back(all.center(), 0.5 * all.diagonal().norm());
  }
}

Fit Coverer::measure(const Block& block, std::size_t spread) const {
  const Rectangle& r = block.rectangle;
  Fit fit;
  fit.aside = spread > 0 ? kDiagonal * static_cast<double>(spread) : 0.0;
  Spread upper, lower;  // of full columns
  for (int v = 0; v < r.v1 - r.v0; ++v) {
    const auto [first, last] = row_of(block.outline, v, r.u1 - r.u0);
    const std::size_t row = grid_.index(r.v0 + v, r.u0);
    const double upper_base = block.upper(0.0, v), lower_base = block.lower(0.0, v);
    for (int k = first; k <= last; ++k) {
      const std::size_t i = row + static_cast<std::size_t>(k);
      const double above = grid_.upper(i, spread) - upper_base - block.upper.a * k,
                   below = grid_.lower(i, spread) - lower_base - block.lower.a * k;
      fit.upper.add(above);
      fit.lower.add(below);
      if (grid_.is_full(i)) {
        upper.add(above);
        lower.add(below);
      } else {
        fit.aside = std::max(fit.aside, grid_.distance(i));
      }
    }
  }
  fit.highest = upper.most;
  fit.deepest = lower.least;
  return fit;
}

/// About the plane of the lower ends where the upper ends lie on a plane.
Plane Coverer::behind(const Block& block, const Plane& upper) const {
  if (!space_.perspective || upper.step() == 0.0) return {};
  // Both ends of the first full columns found tell how far apart they are: the same for all.
  const Rectangle& r = block.rectangle;
  std::size_t i = grid_.index(r.v0, r.u0);
  while (!grid_.is_full(i)) ++i;
  const double far = 1.0 / grid_.lower(i, 0) - 1.0 / grid_.upper(i, 0);
  const double width = r.u1 - r.u0 - 1, height = r.v1 - r.v0 - 1;
  const auto lower = [&](double u, double v) {
    const double w = upper(u, v);
    return w > 0.0 ? 1.0 / (1.0 / w + far) : 0.0;
  };
  Plane plane;
  const double at[4] = {lower(0, 0), lower(width, 0), lower(0, height), lower(width, height)};
  if (width > 0) plane.a = 0.5 * (at[1] - at[0] + at[3] - at[2]) / width;
  if (height > 0) plane.b = 0.5 * (at[2] - at[0] + at[3] - at[1]) / height;
  plane.at = at[0];
  return plane;
}

/// Moves the planes outward until they cover all columns, and sees how much stands out.
bool Coverer::set_planes(Block& block, const Plane& upper) const {
  block.upper = upper;
  block.lower = behind(block, upper);
  const Fit fit = measure(block, 0);
  const bool slanted = upper.step() > 0.0;
  const double rounding = slanted ? kRounding * (std::abs(upper.at) + upper.step()) : 0.0;
  const double upper_shift = fit.highest + 0.5 * block.upper.step() + rounding;
  const double lower_shift = fit.deepest - 0.5 * block.lower.step() - rounding;
  block.upper.at += upper_shift;
  block.lower.at += lower_shift;
  for (const Vector2d& corner : block.outline) {
    const double above = block.upper(corner.x(), corner.y()),
                 below = block.lower(corner.x(), corner.y());
    if (above - below <= kThinnest * std::abs(above)) return false;
    if (space_.perspective && !(below > 0.0)) return false;
  }
  const Prism solid = solid_of(block);
  block.near_place = is_near_place(solid);
  const double allowed = tolerance(solid);
  // Measured against the planes as they are now.
  const auto consider = [&](const Fit& seen, double shifted_upper, double shifted_lower) {
    const double upper_out = shifted_upper + 0.5 * block.upper.step() - seen.upper.least,
                 lower_out = seen.lower.most - shifted_lower + 0.5 * block.lower.step();
    judge(block, seen.aside, std::max(0.0, upper_out), std::max(0.0, lower_out), allowed);
  };
  block.ratio = std::numeric_limits<double>::infinity();
  consider(fit, upper_shift, lower_shift);
  const bool many = block.rectangle.size() > kMany;
  for (std::size_t spread = 1; spread <= kSpreads && block.ratio > 1.0 && !many; ++spread) {
    // Wide ends are rounded to single precision.
    const double slack = 2e-7 * std::abs(block.upper.at);
    consider(measure(block, spread), slack, -slack);
  }
  return true;
}

/// Lowers excess and ratio of a block whose planes stand out by no more than these amounts of w of
/// what is at most `cells` columns aside of something solid.
void Coverer::judge(Block& block, double cells, double upper_out, double lower_out,
                    double allowed) const {
  const Rectangle& r = block.rectangle;
  double before = upper_out, behind = lower_out, aside = cells * space_.cell;
  if (space_.perspective) {
    double ray = 1.0, least_upper = std::numeric_limits<double>::infinity(),
           least_lower = least_upper;
    for (const Vector2d& corner : block.outline) {
      const Vector3d along((r.u0 + corner.x() - space_.cx) / space_.fx,
                           (r.v0 + corner.y() - space_.cy) / space_.fy, 1.0);
      ray = std::max(ray, along.norm());
      least_upper = std::min(least_upper, block.upper(corner.x(), corner.y()));
      least_lower = std::min(least_lower, block.lower(corner.x(), corner.y()));
    }
    // From w to depth: most where the plane is farthest.
    const double least_end = std::max(least_upper - upper_out, least_lower);
    before = ray * upper_out / (least_end * least_upper);
    behind = ray * lower_out / (least_lower * least_lower);
    aside = cells / (std::min(space_.fx, space_.fy) * least_lower);
  }
  const double ratio = std::max(before + aside, behind / kBehind) / allowed;
  if (ratio >= block.ratio) return;
  block.ratio = ratio;
  block.excess = std::max(before, behind) + aside;
}

std::optional<Block> Coverer::fit(Rectangle rectangle) const {
  if (!grid_.trim(rectangle)) return std::nullopt;
  Block level;
  level.rectangle = rectangle;
  level.outline = grid_.outline(rectangle);
  Plane slope = grid_.regression(rectangle);
  if (slope.step() * (rectangle.v1 - rectangle.v0 + rectangle.u1 - rectangle.u0) <=
      kLevel * std::abs(slope.at)) {
    slope = {};
  }
  Block slanted = level;
  const bool is_slanted = slope.step() > 0.0 && set_planes(slanted, slope);
  // A level plane is exact where all ends are at one level, and may be better for a few columns.
  if (!is_slanted || rectangle.size() < 64) {
    set_planes(level, {});
    if (!is_slanted || level.ratio <= slanted.ratio || level.excess <= kExact) slanted = level;
  }
  if (!within_reach(solid_of(slanted))) return std::nullopt;
  return slanted;
}

Prism Coverer::solid_of(const Block& block) const {
  Prism solid;
  for (const Vector2d& corner : block.outline) {
    const double u = block.rectangle.u0 + corner.x(), v = block.rectangle.v0 + corner.y();
    solid.lower.push_back(space_.point(u, v, block.lower(corner.x(), corner.y())));
    solid.upper.push_back(space_.point(u, v, block.upper(corner.x(), corner.y())));
  }
  return solid;
}

double Coverer::tolerance(const Prism& solid) const {
  if (balls_.empty()) return options_.excess;
  const Eigen::AlignedBox3d box = extent(solid);
  double distance = std::numeric_limits<double>::infinity();
  for (const auto& [centre, radius] : balls_) {
    distance = std::min(distance, std::max(0.0, box.exteriorDistance(centre) - radius));
  }
  const double grown = options_.excess + options_.growth * distance;
  return std::min(grown, std::max(options_.excess, options_.most_excess));
}

bool Coverer::within_reach(const Prism& solid) const {
  return !options_.reach || extent(solid).exteriorDistance(reach_centre_) <= *options_.reach;
}

bool Coverer::is_near_place(const Prism& solid) const {
  return std::any_of(places_.begin(), places_.end(),
                     [&](const PlaceBox& place) { return may_meet(solid, place); });
}

/// The block of two neighbours' common rectangle, if they make one and it is within tolerance.
std::optional<Block> Coverer::joined(const Block& one, const Block& two) const {
  const Rectangle &a = one.rectangle, &b = two.rectangle;
  const bool beside = a.v0 == b.v0 && a.v1 == b.v1 && (a.u1 == b.u0 || b.u1 == a.u0);
  const bool under = a.u0 == b.u0 && a.u1 == b.u1 && (a.v1 == b.v0 || b.v1 == a.v0);
  if (!beside && !under) return std::nullopt;
  std::optional<Block> both =
      fit({std::min(a.v0, b.v0), std::max(a.v1, b.v1), std::min(a.u0, b.u0), std::max(a.u1, b.u1)});
  if (!both || both->must_split() || both->ratio > std::max({1.0, one.ratio, two.ratio})) {
    return std::nullopt;
  }
  return both;
}

void Coverer::join(std::vector<Block>& blocks) const {
  for (int round = 0; round < kJoinRounds; ++round) {
    const std::size_t before = blocks.size();
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      for (std::size_t j = i + 1; j < blocks.size();) {
        const std::optional<Block> both = joined(blocks[i], blocks[j]);
        if (!both) {
          ++j;
          continue;
        }
        blocks[i] = *both;
        blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(j));
      }
    }
    if (blocks.size() == before) return;
  }
}

/// Cuts until all is within tolerance or there are as many solids as may be.
std::vector<Block> Coverer::cut() const {
  std::vector<Block> done;
  std::priority_queue<Block, std::vector<Block>, Worse> waiting;
  int near = 0;  // of those that wait or are done
  const auto add = [&](const Rectangle& rectangle) {
    std::optional<Block> block = fit(rectangle);
    if (!block) return;
    near += block->near_place ? 1 : 0;
    waiting.push(std::move(*block));
  };
  add(grid_.all());
  while (!waiting.empty()) {
    const Block block = waiting.top();
    waiting.pop();
    const int others = static_cast<int>(waiting.size() + done.size()) + 1 - near;
    const bool must = block.must_split() && near < kMostExactSolids;
    const bool may = block.ratio > 1.0 && others < options_.most_solids;
    if (block.rectangle.size() == 1 || (!must && !may)) {
      done.push_back(block);
      continue;
    }
    near -= block.near_place ? 1 : 0;
    Rectangle one, two;
    grid_.cut(block.rectangle, one, two);
    add(one);
    add(two);
  }
  return done;
}

Cover Coverer::run() const {
  std::vector<Block> blocks = cut();
  join(blocks);
  Cover cover;
  for (const Block& block : blocks) {
    cover.solids.push_back(solid_of(block));
    cover.excess = std::max(cover.excess, block.excess);
    if (block.near_place && block.excess > kExact) cover.exact_at_places = false;
  }
  return cover;
}

}  // namespace

Cover cover_columns(Columns columns, const Pose& X_WD, const DepthMapOptions& options) {
  const bool any = std::any_of(columns.upper.begin(), columns.upper.end(),
                               [](double w) { return !std::isnan(w); });
  return any ? Coverer(std::move(columns), X_WD, options).run() : Cover{};
}

}  // namespace handey::world
