// May a straight edge take the place of a stretch of a path? It must keep the clearance wanted,
// except where the path itself is nearer than that to something: there the edge must stay at least
// half as far away as the path. What "there" means: edge and stretch correspond to each other by
// their shares of the way.
#pragma once

#include <vector>

#include "edge_times.hpp"
#include "handey/motion/shortcut.hpp"

namespace handey::motion {

/// A point of a path that is being shortened, and the place on the path as it was given that it
/// stands for [s, travel time from its start].
struct Waypoint {
  Configuration configuration;
  double place = 0.0;
};

Configuration between(const Configuration& a, const Configuration& b, double share);

class ClearanceRule {
 public:
  /// @param waypoints the path as given, with its places; refers to its arguments
  ClearanceRule(CollisionChecker& checker, const std::vector<Waypoint>& waypoints,
                const Limits& limits, const ShortcutOptions& options);

  /// A cheap guess at what `allows` will say, from configurations along the edge. False is certain
  /// to be right.
  bool may_allow(const Waypoint& a, const Waypoint& b);
  /// The edge is proved free at the certificate's clearance, and keeps what the rule asks.
  bool allows(const Waypoint& a, const Waypoint& b);

 private:
  /// Where the path is nearer than the clearance wanted, and on to where an edge has to be back.
  struct Zone {
    double begin, end;  // places
    double clearance;   // asked of an edge
  };
  /// The zone that the place lies in; none where the path has the clearance wanted.
  const Zone* zone_at(double place);
  const Zone* find_zone(double place) const;
  void make_zone(int sample);
  /// Distance of the path from the nearest thing at a sample of it, at most the clearance wanted.
  double distance(int sample);
  Configuration configuration_at(double place) const;
  EdgeResult certify(const Configuration& a, const Configuration& b, double clearance);

  CollisionChecker& checker_;
  const std::vector<Waypoint>& waypoints_;
  const Limits& limits_;
  CertificateOptions certificate_;
  double wanted_;
  double spacing_;                 // of the samples, in place
  std::vector<double> distances_;  // per sample, -1: not yet known
  std::vector<Zone> zones_;
};

}  // namespace handey::motion
