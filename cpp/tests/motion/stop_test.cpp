// Claims about stopping: tokens and scopes by hand; then every stage that can take long, on one
// scene. A stage looks often; told to stop at any of its looks it ends at the next one; and after
// that it gives, with the same objects, what it gave before. Looks are counted, not time.
#include "handey/stop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "../approach/puma_scene.hpp"
#include "handey/approach/approach.hpp"
#include "handey/approach/retreat.hpp"
#include "handey/collision/all_hits.hpp"
#include "handey/collision/scene.hpp"
#include "handey/cspace/arm_table.hpp"
#include "handey/cspace/separation.hpp"
#include "handey/cspace/slice.hpp"
#include "handey/errors.hpp"
#include "handey/geometry/convex_pieces.hpp"
#include "handey/grasp/features.hpp"
#include "handey/grasp/legality.hpp"
#include "handey/motion/gross.hpp"
#include "handey/motion/sampling.hpp"
#include "handey/motion/shortcut.hpp"
#include "handey/world/resting.hpp"
#include "handey/world/support_faces.hpp"

namespace handey {
namespace {

StopHooks at_every_look(std::function<void()> poll) {
  StopHooks hooks;
  hooks.poll = std::move(poll);
  hooks.between_polls = std::chrono::milliseconds(0);
  return hooks;
}

TEST(CancelToken, IsSharedByItsCopies) {
  CancelToken token;
  const CancelToken copy = token;
  EXPECT_FALSE(copy.is_stop_requested());
  token.cancel();
  EXPECT_TRUE(copy.is_cancelled());
  EXPECT_TRUE(copy.is_stop_requested());
  EXPECT_FALSE(CancelToken().is_cancelled());
}

TEST(CancelToken, StopsByItselfAtItsDeadline) {
  const CancelToken past = CancelToken::after(0.0), later = CancelToken::after(3600.0);
  EXPECT_TRUE(past.is_stop_requested());
  EXPECT_FALSE(past.is_cancelled());
  EXPECT_LE(past.remaining().value(), 0.0);
  EXPECT_FALSE(later.is_stop_requested());
  EXPECT_GT(later.remaining().value(), 3000.0);
  EXPECT_FALSE(CancelToken().remaining().has_value());
  EXPECT_FALSE(CancelToken::after(1e300).is_stop_requested());
}

TEST(CancelToken, RefusesWhatIsNoTime) {
  for (const double seconds :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(CancelToken::after(seconds), InvalidInput) << seconds;
  }
}

TEST(StopScope, StopsNothingWhereThereIsNone) { EXPECT_NO_THROW(throw_if_stopped()); }

TEST(StopScope, TellsTheCause) {
  const StopScope scope(CancelToken::after(0.0));
  try {
    throw_if_stopped();
    FAIL() << "went on";
  } catch (const Stopped& stopped) {
    EXPECT_EQ(stopped.cause(), Stopped::Cause::Deadline);
  }
}

TEST(StopScope, StopsWhatIsWithinItAndNothingAfter) {
  CancelToken outer;
  {
    const StopScope scope(outer);
    {
      const StopScope inner{CancelToken()};
      outer.cancel();
      EXPECT_THROW(throw_if_stopped(), Stopped);
    }
    EXPECT_THROW(throw_if_stopped(), Stopped);
  }
  EXPECT_NO_THROW(throw_if_stopped());
}

TEST(StopScope, IsOfOneThread) {
  CancelToken token;
  token.cancel();
  const StopScope scope(token);
  bool went_on = false;
  std::thread([&went_on] {
    throw_if_stopped();
    went_on = true;
  }).join();
  EXPECT_TRUE(went_on);
}

TEST(StopScope, LetsOutWhatThePollThrows) {
  const StopScope scope(CancelToken(), at_every_look([] { throw std::runtime_error("a signal"); }));
  EXPECT_THROW(throw_if_stopped(), std::runtime_error);
}

TEST(StopScope, PollsNoMoreOftenThanAsked) {
  int polls = 0;
  StopHooks hooks;
  hooks.poll = [&polls] { ++polls; };
  hooks.between_polls = std::chrono::hours(1);
  const StopScope scope(CancelToken(), hooks);
  for (int i = 0; i < 1000; ++i) throw_if_stopped();
  EXPECT_EQ(polls, 0);
}

// Written out to the last digit.
class Print {
 public:
  Print() { text_.precision(17); }
  template <class Value>
  Print& operator<<(const Value& value) {
    text_ << value << ' ';
    return *this;
  }
  Print& operator<<(const std::vector<Configuration>& path) {
    for (const Configuration& c : path) *this << c.q.transpose() << c.opening;
    return *this;
  }
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

// The Puma, a block between it and a wall, and all that the stages need.
struct Bench {
  Cell cell = test::block_on_table({test::box("wall", {0.6, 0.02, 0.7}, test::at(0.65, 0.0, 0.35)),
                                    test::box("post", {0.04, 0.04, 0.4}, test::at(0.6, 0.1, 0.2))});
  GraspScene scene = test::scene_of(cell, test::at(0.5, -0.25, 0.025));
  SphericalWristSolver solver{*cell.robot};
  CollisionChecker checker{scene.model, cell};
  Ranking ranking = rank_grasps(cell, 0, scene.X_WP_goal);
  Configuration start, goal;
  std::shared_ptr<const ArmTable> table = make_arm_table(*cell.robot);
  std::unique_ptr<Slice> slice;
  std::vector<Configuration> sampled;

  Bench() {
    // To either side of the wall.
    start = {Eigen::VectorXd::Zero(6), 0.1};
    start.q << 1.1, 0.557, -3.1, 0.0, -0.595, 0.0;
    goal = start;
    goal.q(0) = -0.7;
    EXPECT_TRUE(checker.is_free(start));
    EXPECT_TRUE(checker.is_free(goal));
    EXPECT_FALSE(certify_edge(checker, start, goal).is_free());
  }
};

Bench& bench() {
  static Bench instance;
  return instance;
}

struct Stage {
  std::string name;
  std::function<void(Bench&, Print&)> run;
  int least_looks;
};

void print(const MotionResult& motion, Print& out) {
  out << static_cast<int>(motion.status) << motion.reason << motion.iterations << motion.path;
}

// A torus about the z axis, so finely meshed that each step of making it ready takes long.
MeshShape fine_ring(int around, int across) {
  constexpr double kTurn = 6.283185307179586;
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = kTurn * i / around, v = kTurn * j / across;
      const double out = 0.05 + 0.01 * std::cos(v);
      mesh.vertices.emplace_back(out * std::cos(u), out * std::sin(u), 0.01 * std::sin(v));
      const int next = (i + 1) % around, up = (j + 1) % across;
      mesh.triangles.emplace_back(i * across + j, next * across + j, next * across + up);
      mesh.triangles.emplace_back(i * across + j, next * across + up, i * across + up);
    }
  }
  return MeshShape{std::make_shared<const TriangleMesh>(std::move(mesh)), true};
}

Body ring_at(const std::string& name, const Pose& X_WB) {
  Body body = test::box(name, {0.1, 0.1, 0.1}, X_WB);
  body.shapes.front().geometry = fine_ring(80, 40);
  return body;
}

const std::vector<Stage>& stages() {
  static const std::vector<Stage> all = {
      {"Hull",
       [](Bench&, Print& out) {
         // A golden spiral: no four points in a plane, whose facets qhull would merge in any order.
         std::vector<Eigen::Vector3d> points;
         for (int i = 0; i < 3000; ++i) {
           const double z = (i + 0.5) / 1500.0 - 1.0, round = std::sqrt(1.0 - z * z),
                        turn = 2.4 * i;
           points.emplace_back(round * std::cos(turn), round * std::sin(turn), z);
         }
         const ConvexPolyhedron hull = convex_hull(points);
         out << hull.vertices.size() << hull.faces.size() << is_convex(triangulate(hull));
       },
       2000},
      {"Rests",
       [](Bench&, Print& out) {
         for (const RestingPose& rest : resting_poses(ring_at("ring", Pose::Identity()))) {
           out << rest.width << rest.tip_angle;
         }
       },
       2000},
      {"Features",
       [](Bench& b, Print& out) {
         const Body ring = ring_at("ring", Pose::Identity());
         const FeaturePairs found = find_feature_pairs(ring, b.cell.robot->gripper);
         out << found.faces.size() << found.pairs.size() << support_faces(ring).size();
       },
       2000},
      {"Meshes",
       [](Bench& b, Print& out) {
         Cell cell = b.cell;
         cell.fixtures.push_back(ring_at("ring", test::at(0.5, 0.25, 0.2)));
         cell.parts.push_back(ring_at("other", test::at(0.52, 0.25, 0.235)));
         const std::shared_ptr<const CollisionModel> model = make_collision_model(cell);
         out << find_overlaps(*model, cell).size();
         CollisionChecker among_rings(model, cell);
         out << find_all_hits(among_rings, b.start).size();
       },
       2000},
      {"CollisionModel",
       [](Bench& b, Print& out) {
         out << find_overlaps(*make_collision_model(b.cell), b.cell).size();
       },
       500},
      {"Ranking",
       [](Bench& b, Print& out) {
         for (const RankedPair& pair : rank_grasps(b.cell, 0, b.scene.X_WP_goal).ranked) {
           out << pair.score << pair.share;
         }
       },
       30},
      {"Legality",
       [](Bench& b, Print& out) {
         LegalityOptions options;
         options.spacing = 0.01;
         const LegalGrasps found =
             find_legal_grasps(b.scene, b.solver, b.ranking.ranked.front(), options);
         out << found.tried << found.worst_reason;
         for (const GraspPose& pose : found.poses) out << pose.merit;
       },
       200},
      {"Approach",
       [](Bench& b, Print& out) {
         const RankedPair& pair = b.ranking.ranked.front();
         for (const GraspPose& aim : find_legal_grasps(b.scene, b.solver, pair).poses) {
           const ApproachResult approach =
               plan_approach(b.scene, b.solver, pair, aim, aim.q_pick.front());
           out << approach.reason << approach.path;
         }
       },
       500},
      {"Retreat",
       [](Bench& b, Print& out) {
         const RetreatResult retreat =
             plan_retreat(b.checker, b.checker, b.solver, b.start, Eigen::Vector3d::UnitZ());
         out << retreat.reason << retreat.path;
       },
       10},
      {"ArmTable",
       [](Bench& b, Print& out) { out << make_arm_table(*b.cell.robot)->lattice().cells(0, 0); },
       50},
      {"Slice",
       [](Bench& b, Print& out) {
         // Kept from run to run: what is built of it must be whole, or not there.
         if (b.slice == nullptr) {
           Eigen::VectorXd lower = Eigen::VectorXd::Constant(3, -0.2), upper = -lower;
           b.slice = std::make_unique<Slice>(b.checker, b.table, WristRange{lower, upper}, 0.1);
         }
         std::uint64_t sum = 0;
         for (int waist = 0; waist < b.slice->lattice().cells(0, 0); ++waist) {
           for (const std::uint64_t word : b.slice->blocked(waist)) sum = sum * 31 + word;
         }
         out << sum;
       },
       20},
      {"Slices",
       [](Bench& b, Print& out) {
         GrossOptions options;
         options.free_space.table = b.table;
         options.sampling.max_iterations = 1;
         print(plan_gross_motion(b.checker, b.start, {b.goal}, options), out);
       },
       500},
      {"Separation",
       [](Bench& b, Print& out) {
         SeparationOptions options;
         options.most_cells = 8000;
         const Separation separation = prove_apart(b.checker, b.start, {b.goal}, options);
         out << separation.reason << separation.cells_looked_at;
       },
       200},
      {"Sampling",
       [](Bench& b, Print& out) {
         const MotionResult motion = plan_by_sampling(b.checker, b.start, {b.goal});
         if (b.sampled.empty()) b.sampled = motion.path;
         print(motion, out);
       },
       100},
      {"Shortcut",
       [](Bench& b, Print& out) {
         if (b.sampled.empty()) b.sampled = plan_by_sampling(b.checker, b.start, {b.goal}).path;
         out << shorten_path(b.checker, b.sampled);
       },
       100},
  };
  return all;
}

class EveryStage : public ::testing::TestWithParam<Stage> {
 protected:
  static std::string run() {
    Print out;
    GetParam().run(bench(), out);
    return out.text();
  }
};

TEST_P(EveryStage, EndsAtTheNextLookAndCanBeRunAgain) {
  // The last look of all is not known beforehand: a first run may make what later ones find made.
  run();
  if (GetParam().name == "Slice") bench().slice.reset();
  const std::string expected = run();
  if (GetParam().name == "Slice") bench().slice.reset();
  int looks = 0;
  {
    const StopScope scope(CancelToken(), at_every_look([&looks] { ++looks; }));
    EXPECT_EQ(run(), expected);
  }
  EXPECT_GE(looks, GetParam().least_looks);
  for (const double share : {0.0, 0.3, 0.6, 0.95}) {
    if (GetParam().name == "Slice") bench().slice.reset();
    const int last = 1 + static_cast<int>(share * (looks - 2));
    CancelToken token;
    int so_far = 0;
    {
      const StopScope scope(token, at_every_look([&] {
                              if (++so_far == last) token.cancel();
                            }));
      EXPECT_THROW(run(), Stopped) << "at look " << last << " of " << looks;
    }
    EXPECT_EQ(so_far, last);
    EXPECT_EQ(run(), expected) << "after a stop at look " << last << " of " << looks;
  }
}

INSTANTIATE_TEST_SUITE_P(Stop, EveryStage, ::testing::ValuesIn(stages()),
                         [](const auto& stage) { return stage.param.name; });

TEST(Progress, TellsTheWindowsOfTheSlices) {
  Bench& b = bench();
  std::vector<std::string> told;
  StopHooks hooks;
  hooks.progress = [&told](const std::string& text) { told.push_back(text); };
  const StopScope scope(CancelToken(), hooks);
  GrossOptions options;
  const MotionResult motion = plan_gross_motion(b.checker, b.start, {b.goal}, options);
  ASSERT_FALSE(told.empty()) << motion.planner;
  const std::string count = std::to_string(options.search.windows.size());
  EXPECT_EQ(told.front(), "window 1 of " + count);
  EXPECT_LE(told.size(), options.search.windows.size());
}

}  // namespace
}  // namespace handey
