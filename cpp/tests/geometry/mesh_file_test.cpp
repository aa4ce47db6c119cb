#include "handey/geometry/mesh_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "handey/errors.hpp"
#include "handey/geometry/shape.hpp"

namespace handey {
namespace {

namespace fs = std::filesystem;

class MeshFile : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("handey_mesh_" + std::string(info->name()) + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& bytes) const {
    const fs::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path.string();
  }

  std::string code(const std::string& name, const std::string& bytes, bool must_be_closed = false,
                   double scale = 1.0) const {
    MeshFileOptions options;
    options.must_be_closed = must_be_closed;
    options.scale.setConstant(scale);
    return code_of([&] { load_mesh(write(name, bytes), options); });
  }

  static std::string code_of(const std::function<void()>& call) {
    try {
      call();
    } catch (const InvalidInput& error) {
      EXPECT_GT(error.faults().front().message.size(), 10u);
      EXPECT_FALSE(error.faults().front().place.empty());
      return error.faults().front().code;
    }
    return "loads";
  }

  fs::path folder_;
};

TriangleMesh cube(double size = 0.1) {
  Shape shape;
  shape.geometry = Box{Eigen::Vector3d::Constant(size)};
  return tessellate(shape);
}

void append_bytes(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

std::string binary_stl(const TriangleMesh& mesh, const std::string& title = "a solid") {
  std::string bytes = title;
  bytes.resize(80, ' ');
  const std::uint32_t count = static_cast<std::uint32_t>(mesh.triangles.size());
  append_bytes(bytes, &count, 4);
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    bytes.append(12, '\0');
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f p = mesh.vertices[static_cast<std::size_t>(triangle[k])].cast<float>();
      append_bytes(bytes, p.data(), 12);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string text_stl(const TriangleMesh& mesh) {
  std::string text = "solid a part\n";
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& p = mesh.vertices[static_cast<std::size_t>(triangle[k])];
      text += "      vertex " + number(p.x()) + " " + number(p.y()) + " " + number(p.z()) + "\n";
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid a part\n";
}

std::string obj(const TriangleMesh& mesh) {
  std::string text = "# a part\nmtllib ../../x\no part\n";
  for (const Eigen::Vector3d& p : mesh.vertices) {
    text += "v " + number(p.x()) + " " + number(p.y()) + " " + number(p.z()) + "\n";
  }
  for (const Eigen::Vector3i& t : mesh.triangles) {
    text += "f " + std::to_string(t[0] + 1) + "/1/1 " + std::to_string(t[1] + 1) + "//2 " +
            std::to_string(t[2] + 1) + "\n";
  }
  return text;
}

std::string reversed(std::string bytes) { return {bytes.rbegin(), bytes.rend()}; }

std::string ply(const TriangleMesh& mesh, const std::string& format) {
  std::string text =
      "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " +
      std::to_string(mesh.vertices.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nelement face " +
      std::to_string(mesh.triangles.size()) +
      "\nproperty list uchar int vertex_indices\nend_header\n";
  const bool big = format == "binary_big_endian";
  const auto put = [&](const void* data, std::size_t size) {
    std::string bytes(static_cast<const char*>(data), size);
    text += big ? reversed(bytes) : bytes;
  };
  for (const Eigen::Vector3d& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) {
      const float value = static_cast<float>(p[k]);
      if (format == "ascii") {
        text += number(static_cast<double>(value)) + " ";
      } else {
        put(&value, 4);
      }
    }
    text += format == "ascii" ? "255\n" : "\xff";
  }
  for (const Eigen::Vector3i& t : mesh.triangles) {
    text += format == "ascii" ? "3 " : "\x03";
    for (int k = 0; k < 3; ++k) {
      const std::int32_t index = t[k];
      if (format == "ascii") {
        text += std::to_string(index) + (k < 2 ? " " : "\n");
      } else {
        put(&index, 4);
      }
    }
  }
  return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_cube(const LoadedMesh& loaded) {
  EXPECT_TRUE(loaded.surface.closed && loaded.surface.manifold &&
              loaded.surface.consistently_oriented);
  EXPECT_EQ(loaded.mesh.vertices.size(), 8u);
  EXPECT_EQ(loaded.mesh.triangles.size(), 12u);
  EXPECT_NEAR(loaded.surface.volume, 1e-3, 1e-9);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST_F(MeshFile, EveryFormatGivesTheSameSolid) {
  MeshFileOptions closed;
  closed.must_be_closed = true;
  expect_cube(load_mesh(write("b.stl", binary_stl(cube())), closed));
  expect_cube(load_mesh(write("t.stl", text_stl(cube())), closed));
  expect_cube(load_mesh(write("c.obj", obj(cube())), closed));
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    expect_cube(load_mesh(write("c.ply", ply(cube(), format)), closed));
  }
}

TEST_F(MeshFile, ScaleMakesMetresPerAxis) {
  MeshFileOptions options;
  options.scale = {0.001, 0.002, 0.001};
  const LoadedMesh loaded = load_mesh(write("mm.stl", binary_stl(cube(100.0))), options);
  EXPECT_NEAR(loaded.surface.volume, 2e-3, 1e-8);
}

TEST_F(MeshFile, EmptyFilesAreEmpty) {  // 58, 59, 75
  EXPECT_EQ(code("a.stl", ""), "E_MESH_EMPTY");
  EXPECT_EQ(code("a.obj", " \n\n"), "E_MESH_EMPTY");
  EXPECT_EQ(code("b.stl", std::string(84, '\0')), "E_MESH_EMPTY");
  EXPECT_EQ(code("c.stl", "solid nothing\nendsolid nothing\n"), "E_MESH_EMPTY");
  EXPECT_EQ(code("d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "E_MESH_EMPTY");
  EXPECT_EQ(code("e.ply",
                 "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                 "property float z\nend_header\n"),
            "E_MESH_EMPTY");
}

TEST_F(MeshFile, CountsAreComparedWithTheSizeFirst) {  // 60, 61, 62
  std::string huge = binary_stl(cube());
  huge.replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_EQ(code("a.stl", huge), "E_MESH_TRUNCATED");
  const std::string whole = binary_stl(cube());
  EXPECT_EQ(code("b.stl", whole.substr(0, whole.size() - 7)), "E_MESH_TRUNCATED");
  EXPECT_EQ(code("b2.stl", whole.substr(0, 83)), "E_MESH_TRUNCATED");
  EXPECT_EQ(code("c.stl", whole + "junk"), "E_MESH_FORMAT");
  EXPECT_EQ(code("d.stl", text_stl(cube()) + "junk"), "E_MESH_FORMAT");
  const std::string text = text_stl(cube());
  EXPECT_EQ(code("e.stl", text.substr(0, text.size() / 2)), "E_MESH_TRUNCATED");
  const std::string binary_ply = ply(cube(), "binary_little_endian");
  EXPECT_EQ(code("f.ply", binary_ply.substr(0, binary_ply.size() - 1)), "E_MESH_TRUNCATED");
  EXPECT_EQ(code("g.ply", binary_ply + "x"), "E_MESH_FORMAT");
  EXPECT_EQ(code("h.ply", replaced(binary_ply, "vertex 8", "vertex 4000000000000")),
            "E_MESH_TRUNCATED");
  EXPECT_EQ(code("i.ply", replaced(ply(cube(), "ascii"), "face 12", "face 13")),
            "E_MESH_TRUNCATED");
  EXPECT_EQ(code("j.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"), "E_MESH_TRUNCATED");
}

TEST_F(MeshFile, ABinaryStlMayBeginWithSolid) {  // 63
  EXPECT_EQ(code("a.stl", binary_stl(cube(), "solid in spite of appearances"), true), "loads");
}

TEST_F(MeshFile, NumbersMustBeFiniteWithAPoint) {  // 64, 77
  TriangleMesh bad = cube();
  bad.vertices[3].x() = std::nan("");
  EXPECT_EQ(code("a.stl", binary_stl(bad)), "E_NUMBER");
  bad.vertices[3].x() = INFINITY;
  EXPECT_EQ(code("b.stl", binary_stl(bad)), "E_NUMBER");
  EXPECT_EQ(code("c.stl", text_stl(bad)), "E_NUMBER");
  EXPECT_EQ(code("d.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "E_NUMBER");
  EXPECT_EQ(code("e.obj", "v 1e400 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "E_NUMBER");
  EXPECT_EQ(code("f.obj", "v 0,5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "E_NUMBER");
  EXPECT_EQ(code("g.obj", "v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "E_NUMBER");
  EXPECT_EQ(code("h.ply", ply(bad, "binary_big_endian")), "E_NUMBER");
  EXPECT_EQ(code("i.obj", "v 1e-400 0 0\nv +1 0 0\nv 0 1.e0 0\nf 1 2 3\n"), "loads");
}

TEST_F(MeshFile, FaultsNameTheLine) {
  try {
    load_mesh(write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1,5 0\nf 1 2 3\n"));
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(error.faults().front().place.find("a.obj:3"), std::string::npos);
    EXPECT_NE(error.faults().front().message.find("comma"), std::string::npos);
  }
  try {
    load_mesh(write("a.ply", replaced(ply(cube(), "ascii"), "255", "25,5")));
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(error.faults().front().place.find("a.ply:12"), std::string::npos) << error.what();
  }
}

TEST_F(MeshFile, SizesMustBePlausible) {  // 65, 78, 79
  EXPECT_EQ(code("a.stl", binary_stl(cube(1e30))), "E_RANGE");
  EXPECT_EQ(code("b.stl", binary_stl(cube(500.0))), "E_UNITS");
  EXPECT_EQ(code("b.stl", binary_stl(cube(500.0)), true, 0.001), "loads");
  MeshFileOptions options;
  options.most_triangles = 11;
  for (const std::string& path :
       {write("c.stl", binary_stl(cube())), write("d.stl", text_stl(cube())),
        write("e.obj", obj(cube())), write("f.ply", ply(cube(), "ascii"))}) {
    EXPECT_EQ(code_of([&] { load_mesh(path, options); }), "E_TOO_BIG");
  }
  const std::string sparse = write("g.stl", "");
  fs::resize_file(sparse, 250'000'084);
  EXPECT_EQ(code_of([&] { load_mesh(sparse); }), "E_TOO_BIG");
}

TEST_F(MeshFile, TrianglesWithoutAreaAreNoSurface) {  // 66
  EXPECT_EQ(code("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n"), "E_MESH_DEGENERATE");
  const std::string sheet = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n";
  EXPECT_EQ(code("b.obj", sheet, true), "E_MESH_DEGENERATE");
  const LoadedMesh loaded = load_mesh(write("c.obj", obj(cube()) + "f 1 1 2\nf 3 3 3\n"));
  EXPECT_EQ(loaded.mesh.triangles.size(), 12u);
}

TEST_F(MeshFile, AFlatTriangleThatHoldsTheSurfaceTogetherStays) {
  // A tetrahedron whose edge 1-2 has a vertex in its middle on one side only; a flat triangle fills
  // the slit.
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0.5 0 0\n"
      "f 1 3 2\nf 1 5 4\nf 5 2 4\nf 2 3 4\nf 3 1 4\nf 1 2 5\n";
  EXPECT_EQ(code("a.obj", text, true), "loads");
}

TEST_F(MeshFile, OpenSurfacesAreForFixturesOnly) {  // 67
  TriangleMesh open = cube();
  open.triangles.pop_back();
  EXPECT_EQ(code("a.stl", binary_stl(open), true), "E_NOT_CLOSED");
  const LoadedMesh loaded = load_mesh(write("a.stl", binary_stl(open)));
  EXPECT_FALSE(loaded.surface.closed);
  EXPECT_FALSE(loaded.warnings.empty());
}

TEST_F(MeshFile, InsideOutSolidsAreFlipped) {  // 68
  TriangleMesh inverted = cube();
  for (Eigen::Vector3i& triangle : inverted.triangles) std::swap(triangle[0], triangle[1]);
  const LoadedMesh loaded = load_mesh(write("a.stl", binary_stl(inverted)));
  EXPECT_GT(loaded.surface.volume, 0.0);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("inside out"), std::string::npos);
  TriangleMesh mixed = cube();
  std::swap(mixed.triangles[4][0], mixed.triangles[4][1]);
  const LoadedMesh turned = load_mesh(write("b.stl", binary_stl(mixed)));
  EXPECT_TRUE(turned.surface.consistently_oriented);
  EXPECT_NEAR(turned.surface.volume, 1e-3, 1e-9);
}

TEST_F(MeshFile, AThirdTriangleAtAnEdgeIsNotManifold) {  // 69
  EXPECT_EQ(code("a.obj", obj(cube()) + "f 1 3 4\n", true), "E_NOT_MANIFOLD");
  // Two cubes that share an edge: a part must be one solid, a fixture need not.
  TriangleMesh two = cube();
  for (const Eigen::Vector3d& vertex : cube().vertices) {
    two.vertices.push_back(vertex + Eigen::Vector3d(0.1, 0.1, 0.0));
  }
  for (const Eigen::Vector3i& t : cube().triangles)
    two.triangles.push_back(t + Eigen::Vector3i::Constant(8));
  MeshFileOptions closed;
  closed.must_be_closed = true;
  EXPECT_EQ(code("b.stl", binary_stl(two), true), "E_NOT_MANIFOLD");
  const LoadedMesh loaded = load_mesh(write("b.stl", binary_stl(two)));
  EXPECT_EQ(loaded.surface.overfull_edges, 1);
  EXPECT_FALSE(loaded.warnings.empty());
}

TEST_F(MeshFile, ASurfaceThatCrossesItselfGetsAWarning) {  // 70
  TriangleMesh two = cube();
  for (const Eigen::Vector3d& vertex : cube().vertices) {
    two.vertices.push_back(vertex + Eigen::Vector3d(0.04, 0.03, 0.05));
  }
  for (const Eigen::Vector3i& t : cube().triangles)
    two.triangles.push_back(t + Eigen::Vector3i::Constant(8));
  MeshFileOptions closed;
  closed.must_be_closed = true;
  const LoadedMesh crossing = load_mesh(write("a.stl", binary_stl(two)), closed);
  ASSERT_EQ(crossing.warnings.size(), 1u);
  EXPECT_NE(crossing.warnings[0].find("crosses itself"), std::string::npos);
  EXPECT_TRUE(load_mesh(write("b.stl", binary_stl(cube())), closed).warnings.empty());
  // Apart, the two do not cross.
  for (std::size_t i = 8; i < 16; ++i) two.vertices[i].x() += 0.2;
  EXPECT_TRUE(load_mesh(write("c.stl", binary_stl(two)), closed).warnings.empty());
}

TEST_F(MeshFile, ObjIndicesCountFromOneOrBack) {  // 71, 72, 73, 76
  const std::string points = "mtllib ../../../etc/x\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(code("a.obj", points + "f 0 1 2\n"), "E_INDEX");
  EXPECT_EQ(code("b.obj", points + "f 1 2 4\n"), "E_INDEX");
  EXPECT_EQ(code("c.obj", points + "f -1 -2 -4\n"), "E_INDEX");
  EXPECT_EQ(code("d.obj", points + "f 1 2 99999999999999999999\n"), "E_INDEX");
  EXPECT_EQ(code("e.obj", points + "f 1 2 x\n"), "E_INDEX");
  EXPECT_EQ(code("f.obj", points + "f -3 -2 -1\n"), "loads");
  EXPECT_EQ(code("g.ply", replaced(ply(cube(), "ascii"), "\n3 0 ", "\n3 8 ")), "E_INDEX");
}

TEST_F(MeshFile, PolygonsBecomeTriangles) {  // 74
  // An L, concave at its fourth corner: a fan would leave it.
  const std::string text = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n";
  for (const std::string face :
       {"f 1 2 3 4 5 6\n", "f 3 4 5 6 1 2\n", "f 5 6 1 2 3 4\n", "f 1 2 3 \\\n 4 5 6\n"}) {
    const LoadedMesh loaded = load_mesh(write("a.obj", text + face));
    EXPECT_EQ(loaded.mesh.triangles.size(), 4u);
    const std::vector<PlanarFace> faces = planar_faces(loaded.mesh);
    ASSERT_EQ(faces.size(), 1u);
    EXPECT_NEAR(faces[0].area, 4.0, 1e-6);
    EXPECT_NEAR(faces[0].normal.z(), 1.0, 1e-12);
  }
  EXPECT_EQ(code("b.obj", text + "f 1 2\n"), "E_MESH_FORMAT");
}

TEST_F(MeshFile, ArchivesAndOtherFormatsAreRefused) {  // 80
  EXPECT_EQ(code("a.zip", "PK\x03\x04rest"), "E_UNSUPPORTED");
  EXPECT_EQ(code("a.3mf", "PK\x03\x04rest"), "E_UNSUPPORTED");
  EXPECT_EQ(code("a.stl", "BZh91AY"), "E_UNSUPPORTED");
  EXPECT_EQ(code("a.stl.gz", "\x1f\x8b\x08"), "E_UNSUPPORTED");
  EXPECT_EQ(code("a.dae", "<?xml version=\"1.0\"?><COLLADA/>"), "E_UNSUPPORTED");
}

TEST_F(MeshFile, ContentDecidesNotTheName) {  // 81
  EXPECT_EQ(code("a.obj", binary_stl(cube()), true), "loads");
  EXPECT_EQ(code("b.stl", obj(cube()), true), "loads");
  EXPECT_EQ(code("c.obj", ply(cube(), "ascii"), true), "loads");
  EXPECT_EQ(code("d.ply", text_stl(cube()), true), "loads");
  EXPECT_EQ(code("e.stl", "What I did in my holidays."), "E_MESH_FORMAT");
  EXPECT_EQ(code("f.txt", "What I did in my holidays."), "E_PATH");
  EXPECT_EQ(code("g.obj", "v 0 0 0\nvertex 1 2 3\n"), "E_MESH_FORMAT");
}

TEST_F(MeshFile, OnlyRegularFilesAreOpened) {  // 43, 44, 47, 48
  EXPECT_EQ(code_of([&] { load_mesh((folder_ / "none.stl").string()); }), "E_PATH");
  EXPECT_EQ(code_of([&] { load_mesh(folder_.string()); }), "E_PATH");
  EXPECT_EQ(code_of([&] { load_mesh("/dev/zero"); }), "E_PATH");
  const fs::path pipe = folder_ / "pipe.stl";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(code_of([&] { load_mesh(pipe.string()); }), "E_PATH");
  fs::create_symlink(folder_ / "loop_b.stl", folder_ / "loop_a.stl");
  fs::create_symlink(folder_ / "loop_a.stl", folder_ / "loop_b.stl");
  EXPECT_EQ(code_of([&] { load_mesh((folder_ / "loop_a.stl").string()); }), "E_PATH");
}

TEST_F(MeshFile, ScalesMustBePositive) {  // 49
  for (const double scale : {0.0, -1.0, std::nan(""), static_cast<double>(INFINITY)}) {
    EXPECT_EQ(code("a.stl", binary_stl(cube()), false, scale), "E_SCALE");
  }
}

TEST_F(MeshFile, AFileCutAnywhereIsRefusedOrLoadsButNeverCrashes) {
  for (const std::string& whole : {binary_stl(cube()), text_stl(cube()), obj(cube()),
                                   ply(cube(), "ascii"), ply(cube(), "binary_big_endian")}) {
    for (std::size_t length = 0; length < whole.size(); length += 37) {
      const std::string result = code("cut.stl", whole.substr(0, length), true);
      EXPECT_TRUE(result != "loads" || length + 16 > whole.size())
          << length << " of " << whole.size();
    }
  }
}

TEST_F(MeshFile, RealPartsHaveTheFacesThatTheyAreKnownFor) {
  const fs::path parts = fs::path(HANDEY_SOURCE_DIR) / ".." / "shared" / "data" / "parts";
  if (!fs::exists(parts)) GTEST_SKIP() << "no " << parts;
  struct Known {
    const char* file;
    double scale;
    std::size_t
        large_faces;  // over 1 % of the surface; coplanar patches are one face (a star's sides)
  };
  for (const Known& known :
       {Known{"box_40_60_50.stl", 1.0, 6}, Known{"ycb_cracker_box.stl", 1.0, 6},
        Known{"lshape.stl", 1.0, 8}, Known{"star_prism.stl", 1.0, 7},
        Known{"kit_pentagon.obj", 0.001, 7}, Known{"xyz_cube_20mm.stl", 0.001, 6}}) {
    MeshFileOptions options;
    options.scale.setConstant(known.scale);
    options.must_be_closed = true;
    const LoadedMesh loaded = load_mesh((parts / known.file).string(), options);
    const std::vector<PlanarFace> faces = planar_faces(loaded.mesh);
    double surface = 0.0;
    for (const PlanarFace& face : faces) surface += face.area;
    std::size_t large = 0;
    for (const PlanarFace& face : faces) large += face.area > 0.01 * surface ? 1 : 0;
    EXPECT_EQ(large, known.large_faces) << known.file;
  }
}

}  // namespace
}  // namespace handey
