// Halves rectangles of columns, the worst first, and joins neighbours that one solid covers as
// well.
#include "column_cover.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <queue>
#include <utility>

#include "nearest_column.hpp"

namespace handey::world {
namespace {

using Eigen::Vector3d;

constexpr double kExact = 1e-9;  // less stands out by rounding only [m]
// Choice: what lies behind the measured surface is met only by an arm that comes from behind.
constexpr double kBehind = 4.0;
constexpr int kMostExactSolids = 3000;  // Choice: of those that must be exact; beyond, none has to
constexpr int kJoinRounds = 4;
constexpr double kThinnest = 1e-6;  // part of w that must lie between the planes at each corner

struct Rectangle {
  int v0 = 0, v1 = 0, u0 = 0, u1 = 0;  // rows [v0, v1), columns [u0, u1)
  int size() const { return (v1 - v0) * (u1 - u0); }
};

/// w = at + a (u - u0) + b (v - v0)
struct Plane {
  double at = 0.0, a = 0.0, b = 0.0;
  double operator()(double u, double v) const { return at + a * u + b * v; }
  double step() const { return std::abs(a) + std::abs(b); }
};

struct Block {
  Rectangle rectangle;
  Plane upper, lower;  // about the rectangle's first cell
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

/// What of the columns' ends lies beyond a plane.
struct Spread {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

struct PlaceBox {
  Pose X_OD;  // map in the box's frame
  Vector3d half;
};

bool apart_along(const std::array<Vector3d, 8>& corners, const Vector3d& half) {
  for (int k = 0; k < 3; ++k) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Vector3d& corner : corners) {
      least = std::min(least, corner[k]);
      most = std::max(most, corner[k]);
    }
    if (least > half[k] || most < -half[k]) return true;
  }
  return false;
}

Eigen::AlignedBox3d extent(const Hexahedron& solid) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& corner : solid.corners) box.extend(corner);
  return box;
}

constexpr int kFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                              {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// Does a plane of the box or of the solid part them? If not they may still be apart.
bool may_meet(const Hexahedron& solid, const PlaceBox& box) {
  std::array<Vector3d, 8> local;
  Vector3d middle = Vector3d::Zero();
  for (std::size_t k = 0; k < 8; ++k) {
    local[k] = box.X_OD * solid.corners[k];
    middle += local[k] / 8.0;
  }
  if (apart_along(local, box.half)) return false;
  for (const int* face : kFaces) {
    const Vector3d& p = local[static_cast<std::size_t>(face[0])];
    const Vector3d across = local[static_cast<std::size_t>(face[2])] - p;
    const Vector3d other =
        local[static_cast<std::size_t>(face[3])] - local[static_cast<std::size_t>(face[1])];
    Vector3d normal = across.cross(other);
    if (normal.dot(middle - p) > 0.0) normal = -normal;
    double offset = -std::numeric_limits<double>::infinity();
    for (const Vector3d& corner : local) offset = std::max(offset, normal.dot(corner));
    if (-normal.cwiseAbs().dot(box.half) > offset) return false;
  }
  return true;
}

class Coverer {
 public:
  Coverer(const Columns& columns, const Pose& X_WD, const DepthMapOptions& options)
      : columns_(columns), options_(options), width_(columns.columns) {
    fill_empty();
    set_places(X_WD);
  }

  Cover run();

 private:
  void fill_empty();
  void set_places(const Pose& X_WD);
  std::optional<Block> fit(Rectangle rectangle) const;
  bool trim(Rectangle& rectangle) const;
  bool set_planes(Block& block, bool slanted) const;
  Plane regression(const Rectangle& r, const std::vector<double>& w) const;
  Spread spread(const Rectangle& r, const Plane& plane, const std::vector<double>& w,
                double& most_full, double& least_full) const;
  void judge(Block& block, double upper_out, double lower_out, double least_upper,
             double least_lower) const;
  Hexahedron solid_of(const Block& block) const;
  double tolerance(const Hexahedron& solid) const;
  bool within_reach(const Hexahedron& solid) const;
  bool is_near_place(const Hexahedron& solid) const;
  void split(const Block& block, std::vector<Block>& into) const;
  void join(std::vector<Block>& blocks) const;

  std::size_t index(int v, int u) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(u);
  }

  const Columns& columns_;
  const DepthMapOptions& options_;
  int width_;
  Rectangle all_;
  std::vector<char> full_;
  std::vector<double> upper_, lower_;  // of empty columns: those of a full one near them
  std::vector<float> distance_;        // to that one [cells]
  std::vector<PlaceBox> places_;
  std::vector<std::pair<Vector3d, double>> balls_;  // round the places, map frame
  Vector3d reach_centre_ = Vector3d::Zero();
};

void Coverer::fill_empty() {
  full_.resize(columns_.upper.size());
  for (std::size_t i = 0; i < full_.size(); ++i) full_[i] = !std::isnan(columns_.upper[i]);
  all_ = {0, columns_.rows, 0, columns_.columns};
  if (!trim(all_)) return;
  const NearestColumns nearest = nearest_columns(columns_.rows, columns_.columns, full_);
  upper_ = columns_.upper;
  lower_ = columns_.lower;
  distance_ = nearest.distance;
  for (std::size_t i = 0; i < full_.size(); ++i) {
    if (full_[i] != 0 || nearest.source[i] < 0) continue;
    upper_[i] = columns_.upper[static_cast<std::size_t>(nearest.source[i])];
    lower_[i] = columns_.lower[static_cast<std::size_t>(nearest.source[i])];
  }
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

bool Coverer::trim(Rectangle& r) const {
  Rectangle found{r.v1, r.v0, r.u1, r.u0};
  for (int v = r.v0; v < r.v1; ++v) {
    const char* row = full_.data() + index(v, 0);
    int first = r.u0, last = r.u1;
    while (first < last && row[first] == 0) ++first;
    if (first == last) continue;
    while (row[last - 1] == 0) --last;
    found = {std::min(found.v0, v), v + 1, std::min(found.u0, first), std::max(found.u1, last)};
  }
  r = found;
  return r.v0 < r.v1;
}

/// The plane of least squares over the full columns.
Plane Coverer::regression(const Rectangle& r, const std::vector<double>& w) const {
  const double mid_u = 0.5 * (r.u1 - r.u0 - 1), mid_v = 0.5 * (r.v1 - r.v0 - 1);
  double n = 0, su = 0, sv = 0, sw = 0, suu = 0, suv = 0, svv = 0, suw = 0, svw = 0;
  for (int v = r.v0; v < r.v1; ++v) {
    const std::size_t row = index(v, r.u0);
    const double y = v - r.v0 - mid_v;
    double rn = 0, ru = 0, rw = 0, ruu = 0, ruw = 0;
    for (int k = 0; k < r.u1 - r.u0; ++k) {
      const std::size_t i = row + static_cast<std::size_t>(k);
      if (full_[i] == 0) continue;
      const double x = k - mid_u;
      rn += 1;
      ru += x;
      rw += w[i];
      ruu += x * x;
      ruw += x * w[i];
    }
    n += rn;
    su += ru;
    sv += rn * y;
    sw += rw;
    suu += ruu;
    suv += ru * y;
    svv += rn * y * y;
    suw += ruw;
    svw += rw * y;
  }
  const double uu = suu - su * su / n, uv = suv - su * sv / n, vv = svv - sv * sv / n;
  const double uw = suw - su * sw / n, vw = svw - sv * sw / n;
  const double determinant = uu * vv - uv * uv;
  Plane plane;
  if (determinant > 1e-9 * (1.0 + uu * vv)) {
    plane.a = (uw * vv - vw * uv) / determinant;
    plane.b = (vw * uu - uw * uv) / determinant;
  } else if (uu > 0.5 && uu >= vv) {
    plane.a = uw / uu;
  } else if (vv > 0.5) {
    plane.b = vw / vv;
  }
  plane.at = (sw - plane.a * su - plane.b * sv) / n - plane.a * mid_u - plane.b * mid_v;
  return plane;
}

/// How far the columns' ends lie above the plane, empty columns by the full one near them.
Spread Coverer::spread(const Rectangle& r, const Plane& plane, const std::vector<double>& w,
                       double& most_full, double& least_full) const {
  Spread all, full;
  for (int v = r.v0; v < r.v1; ++v) {
    const std::size_t row = index(v, r.u0);
    const double base = plane(0.0, v - r.v0);
    for (int k = 0; k < r.u1 - r.u0; ++k) {
      const std::size_t i = row + static_cast<std::size_t>(k);
      const double above = w[i] - base - plane.a * k;
      all.add(above);
      if (full_[i] != 0) full.add(above);
    }
  }
  most_full = full.most;
  least_full = full.least;
  return all;
}

/// Moves the planes outward until they cover all columns, and sees how much stands out.
bool Coverer::set_planes(Block& block, bool slanted) const {
  const Rectangle& r = block.rectangle;
  Plane upper, lower;
  if (slanted) {
    upper = regression(r, upper_);
    lower = columns_.space.perspective ? regression(r, lower_) : Plane{};
  }
  double most = 0.0, least = 0.0, unused = 0.0;
  const Spread above = spread(r, upper, upper_, most, unused);
  const Spread below = spread(r, lower, lower_, unused, least);
  const double rounding = 1e-13 * (std::abs(above.most) + std::abs(upper.at));
  const double upper_shift = most + 0.5 * upper.step() + rounding;
  const double lower_shift = least - 0.5 * lower.step() - (slanted ? rounding : 0.0);
  const double upper_out = std::max(0.0, upper_shift + 0.5 * upper.step() - above.least);
  const double lower_out = std::max(0.0, below.most - lower_shift + 0.5 * lower.step());
  upper.at += upper_shift;
  lower.at += lower_shift;
  const double width = r.u1 - r.u0, height = r.v1 - r.v0;
  double least_upper = std::numeric_limits<double>::infinity(), least_lower = least_upper;
  for (const double u : {-0.5, width - 0.5}) {
    for (const double v : {-0.5, height - 0.5}) {
      least_upper = std::min(least_upper, upper(u, v));
      least_lower = std::min(least_lower, lower(u, v));
      if (slanted && upper(u, v) - lower(u, v) <= kThinnest * upper.at) return false;
    }
  }
  if (columns_.space.perspective && !(least_lower > 0.0)) return false;
  block.upper = upper;
  block.lower = lower;
  judge(block, upper_out, lower_out, least_upper, least_lower);
  return true;
}

/// Sets excess and ratio of a block whose planes stand out by these amounts of w.
void Coverer::judge(Block& block, double upper_out, double lower_out, double least_upper,
                    double least_lower) const {
  const Rectangle& r = block.rectangle;
  float farthest = 0.0f;
  for (int v = r.v0; v < r.v1; ++v) {
    const std::size_t row = index(v, r.u0);
    for (int k = 0; k < r.u1 - r.u0; ++k) {
      farthest = std::max(farthest, distance_[row + static_cast<std::size_t>(k)]);
    }
  }
  const ColumnSpace& space = columns_.space;
  double before = upper_out, behind = lower_out, beside = farthest * space.cell;
  if (space.perspective) {
    double ray = 1.0;
    for (const double u : {r.u0 - 0.5, r.u1 - 0.5}) {
      for (const double v : {r.v0 - 0.5, r.v1 - 0.5}) {
        ray = std::max(ray,
                       Vector3d((u - space.cx) / space.fx, (v - space.cy) / space.fy, 1.0).norm());
      }
    }
    // From w to depth: least where the plane is farthest.
    const double least_end = std::max(least_upper - upper_out, least_lower);
    before = ray * upper_out / (least_end * least_upper);
    behind = ray * lower_out / (least_lower * least_lower);
    beside = farthest / (std::min(space.fx, space.fy) * least_lower);
  }
  block.excess = std::max(before, behind) + beside;
  const Hexahedron solid = solid_of(block);
  const double allowed = tolerance(solid);
  block.ratio = std::max(before + beside, behind / kBehind) / allowed;
  block.near_place = is_near_place(solid);
}

std::optional<Block> Coverer::fit(Rectangle rectangle) const {
  if (!trim(rectangle)) return std::nullopt;
  Block level;
  level.rectangle = rectangle;
  set_planes(level, false);
  if (!within_reach(solid_of(level))) return std::nullopt;
  if (level.excess <= kExact || rectangle.size() == 1) return level;
  Block slanted;
  slanted.rectangle = rectangle;
  if (set_planes(slanted, true) && slanted.ratio < level.ratio) return slanted;
  return level;
}

Hexahedron Coverer::solid_of(const Block& block) const {
  const Rectangle& r = block.rectangle;
  const double u[2] = {-0.5, r.u1 - r.u0 - 0.5}, v[2] = {-0.5, r.v1 - r.v0 - 0.5};
  constexpr int kTurn[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  Hexahedron solid;
  for (std::size_t k = 0; k < 8; ++k) {
    const double x = u[kTurn[k % 4][0]], y = v[kTurn[k % 4][1]];
    const double w = k < 4 ? block.lower(x, y) : block.upper(x, y);
    solid.corners[k] = columns_.space.point(r.u0 + x, r.v0 + y, w);
  }
  return solid;
}

double Coverer::tolerance(const Hexahedron& solid) const {
  if (balls_.empty()) return options_.excess;
  const Eigen::AlignedBox3d box = extent(solid);
  double distance = std::numeric_limits<double>::infinity();
  for (const auto& [centre, radius] : balls_) {
    distance = std::min(distance, std::max(0.0, box.exteriorDistance(centre) - radius));
  }
  const double grown = options_.excess + options_.growth * distance;
  return std::min(grown, std::max(options_.excess, options_.most_excess));
}

bool Coverer::within_reach(const Hexahedron& solid) const {
  return !options_.reach || extent(solid).exteriorDistance(reach_centre_) <= *options_.reach;
}

bool Coverer::is_near_place(const Hexahedron& solid) const {
  return std::any_of(places_.begin(), places_.end(),
                     [&](const PlaceBox& place) { return may_meet(solid, place); });
}

void Coverer::split(const Block& block, std::vector<Block>& into) const {
  Rectangle one = block.rectangle, two = block.rectangle;
  if (one.u1 - one.u0 >= one.v1 - one.v0) {
    one.u1 = two.u0 = (one.u0 + one.u1) / 2;
  } else {
    one.v1 = two.v0 = (one.v0 + one.v1) / 2;
  }
  for (const Rectangle& half : {one, two}) {
    if (std::optional<Block> fitted = fit(half)) into.push_back(std::move(*fitted));
  }
}

/// Joins neighbours whose common rectangle is covered within tolerance.
void Coverer::join(std::vector<Block>& blocks) const {
  for (int round = 0; round < kJoinRounds; ++round) {
    const std::size_t before = blocks.size();
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      for (std::size_t j = i + 1; j < blocks.size();) {
        const Rectangle &a = blocks[i].rectangle, &b = blocks[j].rectangle;
        const bool beside = a.v0 == b.v0 && a.v1 == b.v1 && (a.u1 == b.u0 || b.u1 == a.u0);
        const bool under = a.u0 == b.u0 && a.u1 == b.u1 && (a.v1 == b.v0 || b.v1 == a.v0);
        if (!beside && !under) {
          ++j;
          continue;
        }
        const double worst = std::max({1.0, blocks[i].ratio, blocks[j].ratio});
        const std::optional<Block> both = fit({std::min(a.v0, b.v0), std::max(a.v1, b.v1),
                                               std::min(a.u0, b.u0), std::max(a.u1, b.u1)});
        if (!both || both->ratio > worst || (both->near_place && both->excess > kExact)) {
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

Cover Coverer::run() {
  Cover cover;
  std::vector<Block> done, fresh;
  std::priority_queue<Block, std::vector<Block>, Worse> waiting;
  int near = 0;  // of those that wait or are done
  const auto add = [&](std::vector<Block>& blocks) {
    for (Block& block : blocks) {
      near += block.near_place ? 1 : 0;
      waiting.push(std::move(block));
    }
    blocks.clear();
  };
  if (all_.v0 < all_.v1) {
    if (std::optional<Block> whole = fit(all_)) fresh.push_back(*whole);
  }
  add(fresh);
  while (!waiting.empty()) {
    const Block block = waiting.top();
    waiting.pop();
    const int total = static_cast<int>(waiting.size() + done.size()) + 1;
    const bool must = block.must_split() && near < kMostExactSolids;
    const bool may = block.ratio > 1.0 && total - near < options_.most_solids;
    if (block.rectangle.size() == 1 || (!must && !may)) {
      done.push_back(block);
      continue;
    }
    near -= block.near_place ? 1 : 0;
    split(block, fresh);
    add(fresh);
  }
  join(done);
  for (const Block& block : done) {
    cover.solids.push_back(solid_of(block));
    cover.excess = std::max(cover.excess, block.excess);
    if (block.near_place && block.excess > kExact) cover.exact_at_places = false;
  }
  return cover;
}

}  // namespace

Cover cover_columns(const Columns& columns, const Pose& X_WD, const DepthMapOptions& options) {
  return Coverer(columns, X_WD, options).run();
}

Shape shape_of(const Hexahedron& solid) {
  const std::array<Vector3d, 8>& c = solid.corners;
  Shape shape;
  const Eigen::AlignedBox3d box = extent(solid);
  const bool upright = std::all_of(c.begin(), c.end(), [&](const Vector3d& corner) {
    return (corner - box.min()).cwiseMin(box.max() - corner).isZero(kExact);
  });
  if (upright) {
    shape.geometry = Box{box.sizes()};
    shape.X_BS.translation() = box.center();
    return shape;
  }
  TriangleMesh mesh;
  mesh.vertices.assign(c.begin(), c.end());
  // Seen from outside the lower end turns one way, and the other for a camera that looks along +z.
  const bool turned = (c[1] - c[0]).cross(c[3] - c[0]).dot(c[4] - c[0]) < 0.0;
  for (const int* face : kFaces) {
    mesh.triangles.emplace_back(face[0], face[turned ? 2 : 1], face[turned ? 1 : 2]);
    mesh.triangles.emplace_back(face[0], face[turned ? 3 : 2], face[turned ? 2 : 3]);
  }
  shape.geometry = MeshShape{std::make_shared<const TriangleMesh>(std::move(mesh)), true};
  return shape;
}

}  // namespace handey::world
