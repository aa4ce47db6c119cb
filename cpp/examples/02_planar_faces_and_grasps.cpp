// Grasp planning, steps 1 to 3: the planar faces of a part, which pairs of them the jaws can take,
// and which pair stays free of what stands near the part, here and where it is to go. Usage:
// 02_planar_faces_and_grasps MODELS
#include <cstdio>

#include "puma560.hpp"

int main(int argc, char** argv) {
  using namespace handey;
  const std::string models = argc > 1 ? argv[1] : "models";
  Cell cell = example::table_cell(models);

  MeshFileOptions millimetres;
  millimetres.scale.setConstant(0.001);
  millimetres.must_be_closed = true;
  const LoadedMesh loaded = load_mesh(models + "/parts/bracket.stl", millimetres);
  Body bracket;
  bracket.name = "bracket";
  bracket.shapes = {Shape{MeshShape{std::make_shared<TriangleMesh>(loaded.mesh), true}}};
  bracket.X_WB = example::at(0.48, 0.2, 0.0, 0.3);
  cell.parts = {bracket};
  // A wall close beside the place where the bracket is to go.
  cell.fixtures.push_back(example::box("wall", {0.3, 0.02, 0.12}, example::at(0.45, -0.30, 0.06)));
  require_valid(cell);

  const FeaturePairs features = find_feature_pairs(bracket, cell.robot->gripper);
  std::printf("%zu planar faces, %zu pairs that the jaws can take\n", features.faces.size(),
              features.pairs.size());
  for (const FeaturePair& pair : features.pairs) {
    std::printf("  %s: %.1f mm apart, overlap %.0f mm2\n", to_string(pair).c_str(),
                1e3 * pair.width, 1e6 * pair.area);
  }
  if (!features.rejected.empty()) {
    std::printf("not these, for example: %s\n", features.rejected.front().reason.c_str());
  }

  const Pose X_WP_goal = example::at(0.45, -0.25, 0.0);
  const Ranking ranking = rank_grasps(cell, 0, X_WP_goal);
  std::printf("ranked by the area that stays unobstructed at both ends:\n");
  for (const RankedPair& ranked : ranking.ranked) {
    std::printf("  %s: %3.0f %% (at the origin alone %3.0f %%)", to_string(ranked.pair).c_str(),
                100.0 * ranked.share, 100.0 * ranked.share_at_origin);
    for (const std::string& name : ranked.obstructing) std::printf(", %s", name.c_str());
    std::printf("\n");
  }
  for (const RankedPair& dropped : ranking.obstructed) {
    std::printf("  %s: dropped, %3.0f %% at the origin, %3.0f %% in all\n",
                to_string(dropped.pair).c_str(), 100.0 * dropped.share_at_origin,
                100.0 * dropped.share);
  }
  bool in_order = !ranking.ranked.empty();
  for (const RankedPair& ranked : ranking.ranked) {
    in_order = in_order && ranked.share > 0.0 && ranked.share <= ranked.share_at_origin + 1e-9;
  }
  return in_order && !features.pairs.empty() ? 0 : 1;
}
