// The search in the grasp plane with the arm behind the hand: a way out of the grasp is searched
// for the hand, the arm follows point by point, the joint path is certified; an edge that is not
// proved free is forbidden and the search goes on, a bounded number of times.
#pragma once

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "hand_reach.hpp"
#include "handey/approach/plane_search.hpp"
#include "handey/collision/certificate.hpp"

namespace handey {

/// May a way end with the arm there?
using EndTest = std::function<bool(const Eigen::VectorXd&)>;

/// A certified way in, or why there is none.
struct SearchedWay {
  bool found = false;
  std::vector<Configuration> path;    ///< from the start to the grasp
  std::vector<PlanarPose> poses;      ///< of the hand in G, likewise; before the path was shortened
  std::vector<Configuration> points;  ///< one for each pose
  std::string reason;
};

class HandSearch {
 public:
  /// @param plane  in the frame of the aim: the grasp plane, x along the approach from the aim
  HandSearch(PlaneSearch plane, HandReach& reach, const PlanarPose& aim,
             const CertificateOptions& certificate);

  /// @param q  the arm at the start, free
  /// @param may_end  asked of the arm where a way would end; may be left out
  SearchedWay way_from(const LatticePoint& start, const Eigen::VectorXd& q,
                       const EndTest& may_end = {});

  const PlaneSearch& plane() const { return plane_; }
  /// Of the hand in G.
  PlanarPose pose(const LatticePoint& point) const;

 private:
  struct Stand {
    bool is_free;
    Eigen::VectorXd q;
  };
  StepAnswer step(const LatticePoint& from, const LatticePoint& to, const EndTest& may_end);
  int key(const LatticePoint& point) const;
  /// @return false if an edge was refused, which is then forbidden
  bool certify(const PlaneSearchResult& found, SearchedWay& way);
  std::string explain(const PlaneSearchResult& found) const;

  HandReach& reach_;
  const PlanarPose aim_;
  const CertificateOptions certificate_;
  PlaneSearch plane_;
  std::unordered_map<int, Stand> stands_;  // where the arm was asked to be
  std::string refusal_;                    // the last
};

}  // namespace handey
