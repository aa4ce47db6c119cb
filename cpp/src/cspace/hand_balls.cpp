// Pieces start as a ball each; the two balls whose common ball is least larger than they are become
// one, until few are left and joining more would waste much room.
#include "hand_balls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "handey/stop.hpp"
#include "swept_points.hpp"

namespace handey::cspace {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMost = 200;  // Choice: a point that becomes more counts as ball at the wrist
constexpr std::size_t kBalls = 2;   // Choice: each costs as much as a link
constexpr double kWaste = 1.5;      // Choice: of volume, up to which two balls are joined anyway

struct Ball {
  Vector3d centre = Vector3d::Zero();
  double radius = 0.0;

  double reach(const std::vector<Vector3d>& points) const {
    double farthest = 0.0;
    for (const Vector3d& point : points) {
      farthest = std::max(farthest, (point - centre).squaredNorm());
    }
    return std::sqrt(farthest);
  }
};

/// A small ball round points: the centre goes towards the farthest point by shorter and shorter
/// steps (Badoiu and Clarkson).
Ball ball_round(const std::vector<Vector3d>& points) {
  Ball ball{points.front(), 0.0};
  for (int step = 1; step <= 16; ++step) {
    const Vector3d* farthest = &points.front();
    double most = -1.0;
    for (const Vector3d& point : points) {
      const double squared = (point - ball.centre).squaredNorm();
      if (squared > most) {
        most = squared;
        farthest = &point;
      }
    }
    ball.centre += (*farthest - ball.centre) / (step + 1.0);
  }
  ball.radius = ball.reach(points);
  return ball;
}

/// The least ball round two.
Ball joined(const Ball& a, const Ball& b) {
  const double apart = (b.centre - a.centre).norm();
  if (apart + b.radius <= a.radius) return a;
  if (apart + a.radius <= b.radius) return b;
  const double radius = 0.5 * (apart + a.radius + b.radius);
  return {a.centre + (radius - a.radius) / apart * (b.centre - a.centre), radius};
}

double volume(const Ball& ball) { return ball.radius * ball.radius * ball.radius; }

/// A piece over the range: its points in the forearm, or none where they would be too many.
struct Swept {
  const HandPiece* piece = nullptr;
  std::vector<Vector3d> points;
  double wrist_radius = 0.0;  ///< of the ball about the wrist that holds it at all values
};

struct Cluster {
  Ball ball;
  std::vector<const Swept*> members;
};

void join_nearest(std::vector<Cluster>& clusters) {
  while (clusters.size() > 1) {
    std::size_t first = 0, second = 1;
    double least = std::numeric_limits<double>::infinity(), waste = 0.0;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      throw_if_stopped();
      for (std::size_t j = i + 1; j < clusters.size(); ++j) {
        const Ball both = joined(clusters[i].ball, clusters[j].ball);
        const double apart = volume(clusters[i].ball) + volume(clusters[j].ball);
        if (volume(both) - apart >= least) continue;
        least = volume(both) - apart;
        waste = volume(both) / apart;
        first = i;
        second = j;
      }
    }
    if (clusters.size() <= kBalls && waste > kWaste) return;
    Cluster& into = clusters[first];
    into.ball = joined(into.ball, clusters[second].ball);
    into.members.insert(into.members.end(), clusters[second].members.begin(),
                        clusters[second].members.end());
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(second));
  }
}

HandBall settle(const Cluster& cluster, const Vector3d& wrist) {
  // The points themselves may let the ball be smaller than the joined balls.
  std::vector<Vector3d> points;
  double about_wrist = 0.0;
  bool all_points = true;
  for (const Swept* member : cluster.members) {
    points.insert(points.end(), member->points.begin(), member->points.end());
    about_wrist = std::max(about_wrist, member->wrist_radius);
    all_points = all_points && !member->points.empty();
  }
  Ball ball = cluster.ball;
  if (all_points) ball = ball_round(points);
  HandBall result;
  result.at_wrist = ball.radius >= about_wrist;
  result.centre = result.at_wrist ? wrist : ball.centre;
  ball.centre = result.centre;
  for (const Swept* member : cluster.members) {
    const double radius = result.at_wrist ? member->wrist_radius
                          : member->points.empty()
                              ? (ball.centre - wrist).norm() + member->wrist_radius
                              : ball.reach(member->points);
    result.radii.emplace_back(member->piece->mover, radius);
  }
  return result;
}

}  // namespace

std::vector<HandBall> hand_balls(const Robot& robot, const Vector3d& wrist_in_body,
                                 const std::vector<HandPiece>& pieces, const Eigen::VectorXd& lower,
                                 const Eigen::VectorXd& upper) {
  std::vector<Swept> sweeps;
  for (const HandPiece& piece : pieces) {
    throw_if_stopped();
    Swept sweep;
    sweep.piece = &piece;
    sweep.wrist_radius = hand_radius(robot, wrist_in_body, piece.depth, piece.points);
    if (sweep_growth(3, piece.depth, lower, upper) <= kMost) {
      sweep.points = sweep_points(robot, 3, piece.depth, lower, upper, piece.points);
    }
    sweeps.push_back(std::move(sweep));
  }
  std::vector<Cluster> clusters;
  for (const Swept& sweep : sweeps) {
    Ball ball{wrist_in_body, sweep.wrist_radius};
    if (!sweep.points.empty()) {
      const Ball tight = ball_round(sweep.points);
      if (tight.radius < ball.radius) ball = tight;
    }
    clusters.push_back({ball, {&sweep}});
  }
  join_nearest(clusters);
  std::vector<HandBall> balls;
  for (const Cluster& cluster : clusters) balls.push_back(settle(cluster, wrist_in_body));
  return balls;
}

}  // namespace handey::cspace
