// For each cell of theta3 the lower link sweeps a narrow sector about the elbow; cut into parts,
// each part's hull is rasterised into rings, and its spans mark the rows of theta2 exactly. The
// upper link needs no sweep at all.
#include "handey/cspace/arm_table.hpp"

#include <algorithm>
#include <cmath>

#include "arm_table_impl.hpp"
#include "handey/errors.hpp"
#include "handey/stop.hpp"
#include "map_union.hpp"

namespace handey {
namespace {

using cspace::GroupMaps;
using cspace::LinkGroup;
using cspace::PolarRaster;
using cspace::RingMaps;
using cspace::RingSpan;
using Eigen::Vector2d;

// Choice: the hull of a sweep of 2 degrees at 8 stands out of it by a fifth of a millimetre.
constexpr int kSweepParts = 4;
constexpr double kRounding = 1e-7;  // outlines are grown by this [m]

double farthest(const std::vector<LinkGroup>& groups) {
  double reach = 0.0;
  for (const LinkGroup& group : groups) {
    for (const Polygon& outline : group.outlines) {
      for (const Vector2d& point : outline) reach = std::max(reach, point.norm());
    }
  }
  return reach;
}

/// How far any link or the wrist comes from axis 2.
double reach_of(const cspace::ArmLinks& links) {
  const double beyond =
      std::max({farthest(links.lower), farthest(links.turning), links.wrist.norm()});
  return std::max(farthest(links.upper), links.plane.elbow.norm() + beyond) + 1e-3;
}

/// Rasterises the links of one table and marks their maps.
class Builder {
 public:
  explicit Builder(ArmTable::Impl& table)
      : table_(table), raster_(table.grid.width, table.grid.rings) {}

  void lay_out() {
    std::size_t size = 0;
    const std::size_t row = table_.row_bytes();
    for (const LinkGroup& group : table_.links.upper) {
      table_.upper.push_back({group.slab, place(upper_extent(group), 1, size)});
    }
    for (const LinkGroup& group : table_.links.lower) {
      table_.lower.push_back({group.slab, place(lower_extent(group.outlines), row, size)});
    }
    for (const LinkGroup& group : table_.links.turning) {
      table_.turning.push_back({group.slab, place(lower_extent(group.outlines), row, size)});
    }
    table_.wrist = cspace::WristColumns(table_.grid, table_.lattice, table_.level,
                                        table_.links.plane, table_.links.wrist);
    size_ = size + cspace::kMapBlock;
  }

  std::size_t size() const { return size_; }

  void fill() {
    table_.bytes.assign(size_, 0);
    for (std::size_t g = 0; g < table_.upper.size(); ++g) {
      for (const Polygon& outline : table_.links.upper[g].outlines) {
        Polygon grown;
        cspace::grow(outline, kRounding, 1.6, grown);
        mark(grown, table_.upper[g].maps, 0);
      }
      table_.upper[g].maps.fill_runs(table_.grid, table_.bytes.data());
    }
    for (std::size_t g = 0; g < table_.lower.size(); ++g) {
      fill_lower(table_.links.lower[g].outlines, table_.lower[g].maps);
    }
    for (std::size_t g = 0; g < table_.turning.size(); ++g) {
      fill_lower(table_.links.turning[g].outlines, table_.turning[g].maps);
    }
  }

 private:
  struct Extent {
    int first, last;
  };

  int columns() const { return table_.lattice.cells(table_.level, 2); }

  Extent extent_of(const std::vector<RingSpan>& spans) const {
    Extent extent{table_.grid.rings, 0};
    for (const RingSpan& span : spans) {
      extent.first = std::min(extent.first, span.ring);
      extent.last = std::max(extent.last, span.ring + 1);
    }
    extent.first = std::min(extent.first, extent.last);
    return extent;
  }

  Extent upper_extent(const LinkGroup& group) {
    spans_.clear();
    for (const Polygon& outline : group.outlines) {
      Polygon grown;
      cspace::grow(outline, kRounding, 1.6, grown);
      raster_.add_spans(grown, spans_);
    }
    return extent_of(spans_);
  }

  Extent lower_extent(const std::vector<Polygon>& outlines) {
    spans_.clear();
    visit_sweeps(outlines,
                 [this](const Polygon& polygon, int) { raster_.add_spans(polygon, spans_); });
    return extent_of(spans_);
  }

  template <class Visit>
  void visit_sweeps(const std::vector<Polygon>& outlines, const Visit& visit) const {
    const double part = table_.lattice.cell_width(table_.level, 2) / kSweepParts;
    const ArmPlane& plane = table_.links.plane;
    for (int column = 0; column < columns(); ++column) {
      throw_if_stopped();
      for (int i = 0; i < kSweepParts; ++i) {
        const double theta3 = table_.lattice.lower[2] + (column * kSweepParts + i + 0.5) * part;
        for (const Polygon& outline : outlines) {
          visit(cspace::swept(outline, plane.elbow_sense * theta3, 0.5 * part, plane.elbow),
                column);
        }
      }
    }
  }

  RingMaps place(const Extent& extent, std::size_t row_bytes, std::size_t& size) const {
    RingMaps maps;
    maps.first_ring = extent.first;
    maps.last_ring = extent.last;
    size += maps.lay_out(table_.grid, row_bytes, size);
    return maps;
  }

  void mark(const Polygon& polygon, const RingMaps& maps, int column) {
    spans_.clear();
    raster_.add_spans(polygon, spans_);
    for (const RingSpan& span : spans_) maps.mark(table_.grid, table_.bytes.data(), span, column);
  }

  void fill_lower(const std::vector<Polygon>& outlines, const RingMaps& maps) {
    visit_sweeps(outlines,
                 [&](const Polygon& polygon, int column) { mark(polygon, maps, column); });
    maps.fill_runs(table_.grid, table_.bytes.data());
  }

  ArmTable::Impl& table_;
  PolarRaster raster_;
  std::vector<RingSpan> spans_;
  std::size_t size_ = 0;
};

void require_valid(const ArmTableOptions& options) {
  if (options.level < 0 || options.level >= Lattice::kLevels) {
    throw InvalidInput("E_RANGE", "level",
                       "found " + std::to_string(options.level) + ", expected 0 to " +
                           std::to_string(Lattice::kLevels - 1));
  }
  if (!(options.square >= 0.002 && options.square <= 0.2)) {
    throw InvalidInput("E_RANGE", "square",
                       "found " + std::to_string(options.square) + ", expected 0.002 to 0.2 [m]");
  }
}

}  // namespace

std::shared_ptr<const ArmTable> make_arm_table(const Robot& robot, const ArmTableOptions& options,
                                               std::string* reason) {
  require_valid(options);
  const std::optional<cspace::ArmLinks> links = cspace::arm_links(robot, reason);
  if (!links) return nullptr;
  std::unique_ptr<ArmTable::Impl> table = std::make_unique<ArmTable::Impl>();
  table->level = options.level;
  table->lattice = make_lattice(robot);
  table->links = *links;
  table->grid =
      cspace::PolarGrid(table->lattice, options.level,
                        std::ldexp(options.square, -std::min(options.level, 2)), reach_of(*links));
  table->robot = cspace::content_key(robot);
  table->key = cspace::table_key(*table);
  Builder builder(*table);
  builder.lay_out();
  const bool kept = !options.directory.empty();
  if (!kept || !cspace::read_table(options.directory, table->key, builder.size(), table->bytes)) {
    builder.fill();
    if (kept) cspace::write_table(options.directory, table->key, table->bytes);
  }
  return std::make_shared<const ArmTable>(std::move(table));
}

ArmTable::ArmTable(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
ArmTable::~ArmTable() = default;
const Lattice& ArmTable::lattice() const { return impl_->lattice; }
int ArmTable::level() const { return impl_->level; }

}  // namespace handey
