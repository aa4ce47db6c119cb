#include "clearance.hpp"

#include <algorithm>
#include <cmath>

namespace handey::motion {
namespace {

// Choice: the path is looked at this often [s of travel time], about 5 degrees of a joint's motion,
// but not at more places than that.
constexpr double kSpacing = 0.05;
constexpr double kMostSamples = 1000.0;
// Choice: an edge that passes more near places than this is not worth the proofs.
constexpr int kMostPieces = 8;
constexpr double kShortest = 1e-9;  // share of an edge that is not worth a proof of its own
// Choice: a guess looks at an edge this often [s of its travel time], with no step smaller than
// that share of it.
constexpr double kGuessSpacing = 0.12;
constexpr double kLeastShare = 1.0 / 128.0;

}  // namespace

Configuration between(const Configuration& a, const Configuration& b, double share) {
  return {a.q + share * (b.q - a.q), a.opening + share * (b.opening - a.opening)};
}

ClearanceRule::ClearanceRule(CollisionChecker& checker, const std::vector<Waypoint>& waypoints,
                             const Limits& limits, const ShortcutOptions& options)
    : checker_(checker),
      waypoints_(waypoints),
      limits_(limits),
      certificate_(options.certificate),
      wanted_(std::max(options.clearance, options.certificate.clearance)),
      spacing_(std::max(kSpacing, waypoints.back().place / kMostSamples)),
      distances_(static_cast<std::size_t>(std::ceil(waypoints.back().place / spacing_)) + 1, -1.0) {
  // The ends are often near: something has just been let go, or is about to be gripped.
  zone_at(waypoints.front().place);
  zone_at(waypoints.back().place);
}

bool ClearanceRule::may_allow(const Waypoint& a, const Waypoint& b) {
  const double travel = edge_time(a.configuration, b.configuration, limits_).travel;
  // Halves, quarters, eighths ...: an obstacle in the way is mostly wide.
  for (double step = 1.0; step * travel > kGuessSpacing && step > kLeastShare; step *= 0.5) {
    for (double share = 0.5 * step; share < 1.0; share += step) {
      const Configuration middle = between(a.configuration, b.configuration, share);
      if (checker_.is_free(middle, wanted_)) continue;
      const Zone* zone = zone_at(a.place + share * (b.place - a.place));
      if (zone == nullptr || !checker_.is_free(middle, zone->clearance)) return false;
    }
  }
  return true;
}

bool ClearanceRule::allows(const Waypoint& a, const Waypoint& b) {
  struct Piece {
    double begin, end;  // shares of the edge
  };
  std::vector<Piece> open{{0.0, 1.0}};
  const double least = certificate_.clearance;
  const double span = b.place - a.place;
  const auto at = [&](double share) {
    if (share <= 0.0) return a.configuration;
    if (share >= 1.0) return b.configuration;
    return between(a.configuration, b.configuration, share);
  };
  bool prove_whole = false;
  for (int pieces = 1; !open.empty(); ++pieces) {
    const Piece piece = open.back();
    open.pop_back();
    const EdgeResult edge = certify(at(piece.begin), at(piece.end), wanted_);
    if (edge.is_free()) continue;
    if (pieces >= kMostPieces) return false;
    const double failed = piece.begin + edge.at * (piece.end - piece.begin);
    const Zone* zone = zone_at(a.place + failed * span);
    if (zone == nullptr) return false;
    const bool is_all = span <= 0.0;
    const double begin = is_all ? 0.0 : std::max(piece.begin, (zone->begin - a.place) / span);
    const double end = is_all ? 1.0 : std::min(piece.end, (zone->end - a.place) / span);
    if (!certify(at(begin), at(end), zone->clearance).is_free()) return false;
    // Pieces proved with half a resolution to spare are proved together, wherever a proof of the
    // whole edge splits it.
    prove_whole = prove_whole || zone->clearance < least + 0.5 * certificate_.resolution;
    if (begin - piece.begin > kShortest) open.push_back({piece.begin, begin});
    if (piece.end - end > kShortest) open.push_back({end, piece.end});
  }
  return !prove_whole || certify(a.configuration, b.configuration, least).is_free();
}

const ClearanceRule::Zone* ClearanceRule::zone_at(double place) {
  if (wanted_ <= certificate_.clearance) return nullptr;
  if (const Zone* zone = find_zone(place)) return zone;
  const int last = static_cast<int>(distances_.size()) - 1;
  const int sample = std::clamp(static_cast<int>(std::lround(place / spacing_)), 0, last);
  for (const int k : {sample, sample - 1, sample + 1}) {
    if (k >= 0 && k <= last && distance(k) < wanted_) make_zone(k);
  }
  return find_zone(place);
}

const ClearanceRule::Zone* ClearanceRule::find_zone(double place) const {
  for (const Zone& zone : zones_) {
    if (place >= zone.begin && place <= zone.end) return &zone;
  }
  return nullptr;
}

void ClearanceRule::make_zone(int sample) {
  const int last = static_cast<int>(distances_.size()) - 1;
  int begin = sample, end = sample;
  double least = distance(sample);
  while (begin > 0 && distance(begin - 1) < wanted_) least = std::min(least, distance(--begin));
  while (end < last && distance(end + 1) < wanted_) least = std::min(least, distance(++end));
  // Choice: as long again to either side, for the distance to grow back.
  const double margin = spacing_ * (end - begin + 1);
  zones_.push_back({begin * spacing_ - margin, end * spacing_ + margin,
                    std::max(certificate_.clearance, 0.5 * least)});
}

double ClearanceRule::distance(int sample) {
  double& known = distances_[static_cast<std::size_t>(sample)];
  if (known < 0.0) {
    known = checker_.closest(configuration_at(sample * spacing_), wanted_).distance;
  }
  return known;
}

Configuration ClearanceRule::configuration_at(double place) const {
  const auto after = std::lower_bound(
      waypoints_.begin(), waypoints_.end(), place,
      [](const Waypoint& waypoint, double value) { return waypoint.place < value; });
  if (after == waypoints_.begin()) return waypoints_.front().configuration;
  if (after == waypoints_.end()) return waypoints_.back().configuration;
  const Waypoint& before = *(after - 1);
  const double share = (place - before.place) / (after->place - before.place);
  return between(before.configuration, after->configuration, share);
}

EdgeResult ClearanceRule::certify(const Configuration& a, const Configuration& b,
                                  double clearance) {
  CertificateOptions options = certificate_;
  options.clearance = clearance;
  return certify_edge(checker_, a, b, options);
}

}  // namespace handey::motion
