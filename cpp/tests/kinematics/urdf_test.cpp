// Reading URDFs: the Puma model as it should be, and every way in which a file can be wrong, by its
// code.
#include "handey/kinematics/urdf.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>

#include "handey/errors.hpp"
#include "test_arms.hpp"

namespace handey {
namespace {

namespace fs = std::filesystem;
using namespace testing;

/// A folder of its own that goes away with the test.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "handey_urdf_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path operator/(const std::string& name) const { return path_ / name; }
  std::string write(const std::string& name, const std::string& text) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }

 private:
  fs::path path_;
};

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

const std::string kUrdf = R"(<robot name="two">
<link name="base"/>
<link name="arm1"><collision><geometry><box size="1 2 3"/></geometry></collision></link>
<link name="arm2"><collision><geometry><mesh filename="piece.obj"/></geometry></collision></link>
<link name="palm"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
<link name="left"><collision><geometry><cylinder radius="0.1" length="0.2"/></geometry></collision></link>
<link name="right"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
<joint name="j1" type="revolute"><parent link="base"/><child link="arm1"/><axis xyz="0 0 1"/><limit lower="-1" upper="2" velocity="1" effort="1"/></joint>
<joint name="j2" type="revolute"><origin xyz="1 0 0"/><parent link="arm1"/><child link="arm2"/><axis xyz="0 0 1"/><limit lower="-1" upper="2" velocity="3" effort="1"/></joint>
<joint name="tool" type="fixed"><origin xyz="0 0 0.5"/><parent link="arm2"/><child link="palm"/></joint>
<joint name="f1" type="prismatic"><parent link="palm"/><child link="left"/><axis xyz="0 1 0"/><limit lower="0" upper="0.05" velocity="0.1" effort="1"/></joint>
<joint name="f2" type="prismatic"><parent link="palm"/><child link="right"/><axis xyz="0 -1 0"/><limit lower="0" upper="0.05" velocity="0.1" effort="1"/></joint>
</robot>
)";

RobotDescription description() {
  RobotDescription d;
  d.name = "two";
  d.arm = {"j1", "j2"};
  d.home = {0.0, 0.5};
  d.gripper_link = "palm";
  d.X_LH = translation(0, 0, 0.1);
  d.fingers = {"f1", "f2"};
  d.ignore_collisions = {{"arm1", "palm"}};
  return d;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::vector<Fault> faults_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InvalidInput& error) {
    return error.faults();
  }
  return {};
}

/// Faults of a URDF text beside a sound mesh.
std::vector<Fault> faults_of_text(const std::string& text) {
  const Folder folder;
  folder.write("piece.obj", kTetrahedron);
  const std::string path = folder.write("two.urdf", text);
  return faults_of([&] { load_robot(path, description()); });
}

std::string listed(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& f : faults) text += f.code + " | " + f.place + " | " + f.message + "\n";
  return text;
}

/// One fault of that code, in its line, with `words` in its message.
void expect_fault(const std::string& text, const std::string& code, int line,
                  const std::string& words = "") {
  const std::vector<Fault> faults = faults_of_text(text);
  const std::string place = "two.urdf:" + std::to_string(line);
  const bool found = std::any_of(faults.begin(), faults.end(), [&](const Fault& f) {
    return f.code == code && (f.place == place || f.place.rfind(place + ":", 0) == 0) &&
           f.message.find(words) != std::string::npos;
  });
  EXPECT_TRUE(found) << "expected " << code << " in line " << line << " with '" << words
                     << "', found\n"
                     << listed(faults);
}

LoadedRobot load_text(const std::string& text, const RobotDescription& d = description()) {
  const Folder folder;
  folder.write("piece.obj", kTetrahedron);
  return load_robot(folder.write("two.urdf", text), d);
}

TEST(Urdf, MakesOneBodyOfLinksThatAreFixedToEachOther) {
  const LoadedRobot loaded = load_text(kUrdf);
  EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings.front();
  const Robot& robot = loaded.robot;
  ASSERT_EQ(robot.bodies.size(), 5u);
  EXPECT_EQ(robot.bodies[2].name, "arm2");
  EXPECT_EQ(robot.bodies[2].links, (std::vector<std::string>{"arm2", "palm"}));
  ASSERT_EQ(robot.bodies[2].shapes.size(), 2u);
  EXPECT_TRUE(robot.bodies[2].shapes[1].X_BS.isApprox(translation(0, 0, 0.5)));
  EXPECT_EQ(std::get<Sphere>(robot.bodies[2].shapes[1].geometry).radius, 0.1);
  EXPECT_EQ(std::get<MeshShape>(robot.bodies[2].shapes[0].geometry).mesh->triangles.size(), 4u);
  EXPECT_EQ(std::get<Box>(robot.bodies[1].shapes[0].geometry).size, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(robot.gripper.body, 2);
  EXPECT_TRUE(robot.gripper.X_BH.isApprox(translation(0, 0, 0.6)));
  EXPECT_EQ(robot.joints[1].limit.velocity, 3.0);
  EXPECT_EQ(robot.joints[1].limit.acceleration, 5.0);
  EXPECT_EQ(robot.ignored_pairs, (std::vector<std::pair<int, int>>{{1, 2}}));
  Eigen::VectorXd q(2);
  q << kPi / 2, 0.0;
  EXPECT_TRUE((hand_pose(robot, q).translation() - Eigen::Vector3d(0, 1, 0.6)).norm() < 1e-12);
}

TEST(Urdf, ReadsThePumaModel) {
  RobotDescription d;
  d.name = "puma560";
  d.arm = {"joint1", "joint2", "joint3", "joint4", "joint5", "joint6"};
  d.home = {0, kPi / 2, -kPi / 2, 0, 0, 0};
  d.gripper_link = "gripper";
  d.X_LH = translation(0, 0, 0.125);
  d.fingers = {"left_finger_joint", "right_finger_joint"};
  d.pad_length = 0.03;
  const LoadedRobot loaded = load_robot(HANDEY_MODELS_DIR "/robots/puma560/puma560.urdf", d);
  EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings.front();
  const Robot expected = puma(0.05625 + 0.125);
  ASSERT_EQ(loaded.robot.bodies.size(), 9u);
  std::size_t shapes = 0;
  for (const RobotBody& body : loaded.robot.bodies) shapes += body.shapes.size();
  EXPECT_EQ(shapes, 17u);
  std::mt19937 random(1);
  for (int n = 0; n < 100; ++n) {
    const Eigen::VectorXd q = random_configuration(loaded.robot, random);
    EXPECT_TRUE(hand_pose(loaded.robot, q).isApprox(hand_pose(expected, q), 1e-12));
  }
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(loaded.robot.joints[i].limit.lower, expected.joints[i].limit.lower, 1e-14);
    EXPECT_NEAR(loaded.robot.joints[i].limit.upper, expected.joints[i].limit.upper, 1e-14);
  }
}

TEST(Urdf, KeepsThePumasPiecesTogether) {
  // Bodies that a joint joins lie against each other: no gap of more than 15 mm at home.
  RobotDescription d;
  d.arm = {"joint1", "joint2", "joint3", "joint4", "joint5", "joint6"};
  d.home = {0, kPi / 2, -kPi / 2, 0, 0, 0};
  d.gripper_link = "gripper";
  d.X_LH = translation(0, 0, 0.125);
  d.fingers = {"left_finger_joint", "right_finger_joint"};
  const Robot robot = load_robot(HANDEY_MODELS_DIR "/robots/puma560/puma560.urdf", d).robot;
  const std::vector<Pose> poses = body_poses(robot, {robot.home, 0.05});
  const auto box = [&](std::size_t body) {
    Eigen::AlignedBox3d bounds;
    for (const Shape& shape : robot.bodies[body].shapes) {
      for (const Eigen::Vector3d& p : hull_points(shape)) bounds.extend(poses[body] * p);
    }
    return bounds;
  };
  for (std::size_t i = 0; i + 1 < robot.bodies.size() - 1; ++i) {
    EXPECT_LT(box(i).exteriorDistance(box(i + 1)), 0.015) << robot.bodies[i + 1].name;
  }
}

TEST(BadUrdf, ThatIsNoXml) {
  expect_fault("", "E_XML", 1);
  expect_fault("this is not xml", "E_XML", 1);
  expect_fault(kUrdf.substr(0, kUrdf.size() / 2), "E_XML", 8);
}
TEST(BadUrdf, WithAnotherRoot) { expect_fault("<model name='a'/>", "E_ROOT", 1, "<model>"); }
TEST(BadUrdf, WithoutNames) {
  expect_fault(replaced(kUrdf, " name=\"two\"", ""), "E_NAME", 1);
  expect_fault(replaced(kUrdf, "<link name=\"base\"/>", "<link name=\"\"/>"), "E_NAME", 2);
  expect_fault(replaced(kUrdf, "<joint name=\"j1\"", "<joint"), "E_NAME", 8);
}
TEST(BadUrdf, WithoutLinks) { expect_fault("<robot name='a'/>", "E_EMPTY", 1); }
TEST(BadUrdf, WithTwoRoots) {
  expect_fault(replaced(kUrdf, "<link name=\"base\"/>", "<link name=\"base\"/><link name=\"b2\"/>"),
               "E_TREE", 2, "'base', 'b2'");
}
TEST(BadUrdf, WithTheSameNameTwice) {
  expect_fault(replaced(kUrdf, "<link name=\"right\"", "<link name=\"left\""), "E_DUP", 7,
               "line 6");
  expect_fault(replaced(kUrdf, "name=\"j2\"", "name=\"j1\""), "E_DUP", 9, "line 8");
}
TEST(BadUrdf, ThatIsNoTree) {
  expect_fault(replaced(kUrdf, "<child link=\"right\"/>", "<child link=\"left\"/>"), "E_TREE", 12,
               "has a parent already");
  expect_fault(replaced(kUrdf, "<parent link=\"base\"/>", "<parent link=\"right\"/>"), "E_TREE", 3,
               "ring");
  const std::string cycle =
      "<link name='x'/><link name='y'/>"
      "<joint name='xy' type='fixed'><parent link='x'/><child link='y'/></joint>"
      "<joint name='yx' type='fixed'><parent link='y'/><child link='x'/></joint></robot>";
  expect_fault(replaced(kUrdf, "</robot>", cycle), "E_TREE", 13, "ring");
  expect_fault(replaced(kUrdf, "<child link=\"arm1\"/>", "<child link=\"base\"/>"), "E_TREE", 8,
               "to itself");
}
TEST(BadUrdf, ThatRefersToNothing) {
  expect_fault(replaced(kUrdf, "<parent link=\"base\"/>", "<parent link=\"bas\"/>"), "E_REF", 8,
               "'bas' is no link");
  expect_fault(replaced(kUrdf, "<child link=\"arm1\"/>", ""), "E_REF", 8, "<child>");
}
TEST(BadUrdf, WithJointsOfAnotherKind) {
  expect_fault(replaced(kUrdf, "\"revolute\"", "\"rotary\""), "E_JOINT_TYPE", 8, "'rotary'");
  expect_fault(replaced(kUrdf, "\"revolute\"", "\"floating\""), "E_UNSUPPORTED", 8);
  expect_fault(replaced(kUrdf, "\"revolute\"", "\"planar\""), "E_UNSUPPORTED", 8);
  expect_fault(replaced(kUrdf, "type=\"fixed\"", "type=\"continuous\""), "E_LIMIT", 10);
}
const std::string kLimit = R"(<limit lower="-1" upper="2" velocity="1" effort="1"/>)";
std::string with_limit(const std::string& limit) { return replaced(kUrdf, kLimit, limit); }
TEST(BadUrdf, WithLimitsThatLeaveNoMotion) {
  expect_fault(with_limit(""), "E_LIMIT", 8, "no <limit>");
  expect_fault(with_limit(R"(<limit lower="2" upper="-1" velocity="1" effort="1"/>)"), "E_LIMIT", 8,
               "lower < upper");
  expect_fault(with_limit(R"(<limit velocity="1" effort="1"/>)"), "E_LIMIT", 8, "neither");
  expect_fault(with_limit(R"(<limit lower="-1" upper="2" effort="1"/>)"), "E_LIMIT", 8, "velocity");
  expect_fault(with_limit(R"(<limit lower="-1" upper="2" velocity="0" effort="1"/>)"), "E_LIMIT", 8,
               "more than 0");
  expect_fault(with_limit(R"(<limit lower="-1" upper="2" velocity="-1" effort="1"/>)"), "E_LIMIT",
               8);
  expect_fault(with_limit(R"(<limit lower="-160" upper="160" velocity="1" effort="1"/>)"),
               "E_LIMIT", 8, "degrees");
}
TEST(BadUrdf, WithNumbersThatAreNone) {
  for (const char* bad : {"nan", "inf", "1e400", "1,5", "", "1 2", "0x1p3", "abc", "+-1"}) {
    expect_fault(replaced(kUrdf, "upper=\"2\"", "upper=\"" + std::string(bad) + "\""), "E_NUMBER",
                 8);
  }
  expect_fault(replaced(kUrdf, "<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 1\"/>"), "E_NUMBER", 8);
  expect_fault(replaced(kUrdf, "<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 1 0 0\"/>"), "E_NUMBER", 8);
  expect_fault(replaced(kUrdf, "<origin xyz=\"1 0 0\"/>", "<origin xyz=\"1 0 nan\"/>"), "E_NUMBER",
               9);
  expect_fault(replaced(kUrdf, "<origin xyz=\"1 0 0\"/>", "<origin rpy=\"1 0\"/>"), "E_NUMBER", 9);
}
TEST(BadUrdf, WithLeftoversOfXacro) {
  expect_fault(replaced(kUrdf, "upper=\"2\"", "upper=\"${pi}\""), "E_XACRO", 8);
  expect_fault(replaced(kUrdf, "\"piece.obj\"", "\"$(find x)/piece.obj\""), "E_XACRO", 4);
  expect_fault(replaced(kUrdf, "</robot>", "<xacro:arm/></robot>"), "E_XACRO", 13);
}
TEST(BadUrdf, WithAZeroAxis) {
  expect_fault(replaced(kUrdf, "<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 0\"/>"), "E_AXIS", 8);
}
TEST(BadUrdf, WithMisspeltTagsAndAttributes) {
  expect_fault(replaced(kUrdf, "<collision>", "<colision>")
                   .replace(kUrdf.find("</collision>") - 1, 12, "</colision>"),
               "E_UNKNOWN_TAG", 3, "'collision'");
  expect_fault(replaced(kUrdf, "velocity=", "velocty="), "E_UNKNOWN_ATTR", 8, "'velocity'");
  expect_fault(replaced(kUrdf, "<axis xyz=\"0 0 1\"/>", "<axes xyz=\"0 0 1\"/>"), "E_UNKNOWN_TAG",
               8);
  expect_fault(replaced(kUrdf, kLimit, kLimit + kLimit), "E_DUP", 8, "second <limit>");
  expect_fault(replaced(kUrdf, "<link name=\"base\"/>", "<link name=\"base\">x</link>"), "E_XML", 2,
               "stray text");
}
TEST(BadUrdf, WithMimicsOfNothingOrOfThemselves) {
  const auto mimic = [](const std::string& leader) {
    return replaced(kUrdf, "<axis xyz=\"0 -1 0\"/>",
                    "<axis xyz=\"0 -1 0\"/><mimic joint=\"" + leader + "\"/>");
  };
  expect_fault(mimic("f3"), "E_REF", 12, "'f3'");
  expect_fault(mimic("f2"), "E_MIMIC", 12);
  expect_fault(
      replaced(mimic("f1"), "<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1 0\"/><mimic joint=\"f2\"/>"),
      "E_MIMIC", 11, "ring");
  EXPECT_TRUE(faults_of_text(mimic("f1")).empty());
}
TEST(BadUrdf, WithShapesThatAreNone) {
  const std::string box = "<box size=\"1 2 3\"/>",
                    cylinder = "<cylinder radius=\"0.1\" length=\"0.2\"/>";
  for (const char* size : {"nan 1 1", "1 1", "1 1 0", "1 -1 1", "1 1 1 1", "1 1 inf"}) {
    expect_fault(replaced(kUrdf, box, "<box size=\"" + std::string(size) + "\"/>"), "E_GEOMETRY",
                 3);
  }
  expect_fault(replaced(kUrdf, cylinder, "<cylinder radius=\"0.1\"/>"), "E_GEOMETRY", 6, "length");
  expect_fault(replaced(kUrdf, cylinder, "<capsule radius=\"0.1\" length=\"0.2\"/>"),
               "E_UNSUPPORTED", 6);
  expect_fault(replaced(kUrdf, "<geometry>" + box + "</geometry>", ""), "E_GEOMETRY", 3);
  expect_fault(replaced(kUrdf, box, ""), "E_GEOMETRY", 3);
  expect_fault(replaced(kUrdf, box, box + box), "E_GEOMETRY", 3, "two shapes");
}
TEST(BadUrdf, WithALookButNoCollisionShape) {
  expect_fault(replaced(kUrdf, "<link name=\"base\"/>",
                        "<link name=\"base\"><visual><geometry><sphere radius=\"1\"/></geometry>"
                        "</visual></link>"),
               "E_NO_COLLISION", 2);
}
std::string with_mesh(const std::string& mesh) {
  return replaced(kUrdf, "<mesh filename=\"piece.obj\"/>", mesh);
}
TEST(BadUrdf, WithMeshesThatAreNoFiles) {
  expect_fault(with_mesh("<mesh/>"), "E_MESH_REF", 4);
  expect_fault(with_mesh("<mesh filename=\"none.obj\"/>"), "E_PATH", 4, "none.obj");
  expect_fault(with_mesh("<mesh filename=\".\"/>"), "E_PATH", 4);
  expect_fault(with_mesh("<mesh filename=\"two.urdf\"/>"), "E_PATH", 4, "no known kind");
  expect_fault(with_mesh("<mesh filename=\"http://a.b/c.stl\"/>"), "E_PATH", 4);
  expect_fault(with_mesh("<mesh filename=\"package://none/c.stl\"/>"), "E_PATH", 4, "known are");
  expect_fault(with_mesh("<mesh filename=\"/dev/zero\"/>"), "E_PATH", 4);
  expect_fault(with_mesh("<mesh filename=\"../../../../../../etc/passwd\"/>"), "E_PATH", 4);
  for (const char* scale : {"0 1 1", "nan 1 1", "-1 1 1", "1"}) {
    expect_fault(with_mesh("<mesh filename=\"piece.obj\" scale=\"" + std::string(scale) + "\"/>"),
                 "E_SCALE", 4);
  }
}
TEST(BadUrdf, WithMeshesBehindOddFiles) {
  const Folder folder;
  folder.write("piece.obj", kTetrahedron);
  fs::create_symlink(folder / "loop.obj", folder / "loop.obj");
  ASSERT_EQ(mkfifo((folder / "pipe.obj").c_str(), 0600), 0);
  const Folder elsewhere;
  elsewhere.write("piece.obj", kTetrahedron);
  fs::create_symlink(elsewhere / "piece.obj", folder / "outside.obj");
  for (const char* name : {"loop.obj", "pipe.obj", "outside.obj"}) {
    const std::string path =
        folder.write("two.urdf", with_mesh("<mesh filename=\"" + std::string(name) + "\"/>"));
    const std::vector<Fault> faults = faults_of([&] { load_robot(path, description()); });
    ASSERT_EQ(faults.size(), 1u) << name << listed(faults);
    EXPECT_EQ(faults[0].code, "E_PATH") << name;
  }
}
TEST(BadUrdf, WhoseMeshIsBroken) {
  const Folder folder;
  folder.write("piece.obj", "v 0 0 0\nf 1 2 3\n");
  const std::string path = folder.write("two.urdf", kUrdf);
  const std::vector<Fault> faults = faults_of([&] { load_robot(path, description()); });
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults[0].place.rfind("two.urdf:4: link 'arm2'", 0), 0u) << listed(faults);
}
TEST(BadUrdf, MadeToHurtTheReader) {
  std::string deep = "<robot name='a'>";
  for (int i = 0; i < 200000; ++i) deep += "<a>";
  expect_fault(deep, "E_DEPTH", 1);
  expect_fault("<!DOCTYPE robot [<!ENTITY a 'b'>]>\n" + kUrdf, "E_DOCTYPE", 1);
  expect_fault("<robot name=\"\xff\"/>", "E_ENCODING", 1);
  expect_fault("<robot name=\"\xc3", "E_ENCODING", 1);
  expect_fault("<robot name=\"\xed\xa0\x80\"/>", "E_ENCODING", 1);
  expect_fault(std::string("\xff\xfe<\0r\0", 6), "E_ENCODING", 1);
  expect_fault(std::string("<robot name='a'>\n\0</robot>", 26), "E_ENCODING", 2);
  expect_fault("<?xml version='1.0' encoding='ISO-8859-1'?>" + kUrdf, "E_ENCODING", 1);
  std::string many = "<robot name='a'>";
  for (int i = 0; i < 30000; ++i) many += "<link name='l" + std::to_string(i) + "'/>";
  expect_fault(many + "</robot>", "E_TOO_BIG", 1);
}
TEST(BadUrdf, ThatIsNoReadableFile) {
  const Folder folder;
  folder.write("big.urdf", "");
  fs::resize_file(folder / "big.urdf", 100u << 20);
  ASSERT_EQ(mkfifo((folder / "pipe.urdf").c_str(), 0600), 0);
  const auto code = [&](const fs::path& path) {
    const std::vector<Fault> faults = faults_of([&] { load_robot(path.string(), description()); });
    return faults.empty() ? "" : faults[0].code;
  };
  EXPECT_EQ(code(folder / "big.urdf"), "E_TOO_BIG");
  EXPECT_EQ(code(folder / "none.urdf"), "E_PATH");
  EXPECT_EQ(code(folder / "."), "E_PATH");
  EXPECT_EQ(code(folder / "pipe.urdf"), "E_PATH");
}
TEST(BadUrdf, ReportsAllItsFaultsAtOnce) {
  std::string text = replaced(kUrdf, "upper=\"2\"", "upper=\"x\"");
  text = replaced(text, "1 2 3", "1 2");
  text = replaced(text, "piece.obj", "none.obj");
  text = replaced(text, "length=", "lenght=");
  const std::vector<Fault> faults = faults_of_text(text);
  for (const char* code : {"E_NUMBER", "E_GEOMETRY", "E_PATH", "E_UNKNOWN_ATTR"}) {
    EXPECT_TRUE(
        std::any_of(faults.begin(), faults.end(), [&](const Fault& f) { return f.code == code; }))
        << code << "\n"
        << listed(faults);
  }
}

TEST(UrdfWarning, OfAnAxisThatIsNoUnitVector) {
  const LoadedRobot loaded =
      load_text(replaced(kUrdf, "<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 5\"/>"));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_EQ(loaded.robot.joints[0].axis, Eigen::Vector3d::UnitZ());
}
TEST(UrdfWarning, OfASafetyControllerWhoseLimitsAreApplied) {
  const LoadedRobot loaded =
      load_text(replaced(kUrdf, kLimit,
                         kLimit + "<safety_controller soft_lower_limit=\"-0.5\" "
                                  "soft_upper_limit=\"3\" k_velocity=\"1\"/>"));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_EQ(loaded.robot.joints[0].limit.lower, -0.5);
  EXPECT_EQ(loaded.robot.joints[0].limit.upper, 2.0);
}
TEST(UrdfWarning, OfAnOpenMeshThatItsHullStandsFor) {
  const Folder folder;
  folder.write("piece.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  const LoadedRobot loaded = load_robot(folder.write("two.urdf", kUrdf), description());
  ASSERT_FALSE(loaded.warnings.empty());
  const auto& mesh = std::get<MeshShape>(loaded.robot.bodies[2].shapes[0].geometry).mesh;
  EXPECT_TRUE(inspect_surface(*mesh).closed);
}

TEST(UrdfPaths, FindPackagesBesideAroundAndByName) {
  const Folder folder;
  folder.write("my_arm/package.xml", "<package/>");
  folder.write("my_arm/meshes/piece.obj", kTetrahedron);
  folder.write("other/package.xml", "<package/>");
  folder.write("other/piece.obj", kTetrahedron);
  folder.write("far/deep/piece.obj", kTetrahedron);
  RobotDescription d = description();
  d.packages["named"] = (folder / "far").string();
  for (const char* name : {"package://my_arm/meshes/piece.obj", "../meshes/piece.obj",
                           "package://other/piece.obj", "package://named/deep/piece.obj"}) {
    const std::string path = folder.write(
        "my_arm/urdf/two.urdf", with_mesh("<mesh filename=\"" + std::string(name) + "\"/>"));
    const std::vector<Fault> faults = faults_of([&] { load_robot(path, d); });
    EXPECT_TRUE(faults.empty()) << name << "\n" << listed(faults);
  }
  const std::string path =
      folder.write("my_arm/urdf/two.urdf", with_mesh("<mesh filename=\"../../other/piece.obj\"/>"));
  EXPECT_FALSE(faults_of([&] { load_robot(path, d); }).empty());
}

TEST(UrdfForeign, TagsOfOtherProgramsAreLetBy) {
  const std::string text =
      replaced(kUrdf, "</robot>",
               "<transmission name='t'><type>x</type></transmission><gazebo "
               "reference='base'><a>1</a></gazebo>"
               "<material name='red'><color rgba='1 0 0 1'/></material></robot>");
  EXPECT_TRUE(faults_of_text(text).empty()) << listed(faults_of_text(text));
}

void expect_description_fault(const std::function<void(RobotDescription&)>& edit,
                              const std::string& code, const std::string& place,
                              const std::string& words = "") {
  RobotDescription d = description();
  edit(d);
  const std::vector<Fault> faults = faults_of([&] { load_text(kUrdf, d); });
  EXPECT_TRUE(std::any_of(faults.begin(), faults.end(),
                          [&](const Fault& f) {
                            return f.code == code && f.place.find(place) != std::string::npos &&
                                   f.message.find(words) != std::string::npos;
                          }))
      << code << " " << place << " not in\n"
      << listed(faults);
}

TEST(BadDescription, NamesTheLegalJointsAndLinks) {
  using D = RobotDescription;
  expect_description_fault([](D& d) { d.arm = {"j1", "j3"}; }, "E_REF", "arm", "'j1', 'j2'");
  expect_description_fault([](D& d) { d.arm = {"j1", "j1"}; }, "E_DUP", "arm");
  expect_description_fault([](D& d) { d.arm = {"j1", "f1"}; }, "E_JOINT_TYPE", "arm");
  expect_description_fault([](D& d) { d.fingers[0] = "tool"; }, "E_JOINT_TYPE", "gripper.fingers");
  expect_description_fault([](D& d) { d.gripper_link = "hand"; }, "E_REF", "gripper.link",
                           "'palm'");
  expect_description_fault(
      [](D& d) {
        d.ignore_collisions = {{"arm1", "x"}};
      },
      "E_REF", "ignore_collisions");
  expect_description_fault([](D& d) { d.packages["x"] = "/no/such/folder"; }, "E_PATH",
                           "packages.x");
}
TEST(BadDescription, WhoseArmIsNoChain) {
  using D = RobotDescription;
  expect_description_fault([](D& d) { d.arm = {"j2", "j1"}; }, "E_TREE", "two.urdf:9", "chain");
  expect_description_fault([](D& d) { d.gripper_link = "arm1"; }, "E_TREE", "gripper.link", "'j1'");
  expect_description_fault(
      [](D& d) {
        d.arm = {"j1"};
        d.home = {0.0};
      },
      "E_UNSUPPORTED", "two.urdf:9", "neither");
}
TEST(BadDescription, WithNumbersOutOfRange) {
  using D = RobotDescription;
  const double nan = std::nan("");
  expect_description_fault([](D& d) { d.home = {0.0}; }, "E_DOF", "home");
  expect_description_fault([=](D& d) { d.home[0] = nan; }, "E_NUMBER", "home");
  expect_description_fault([](D& d) { d.home[0] = 2.5; }, "E_LIMIT", "home", "exceeds 2");
  expect_description_fault([](D& d) { d.acceleration = {1.0}; }, "E_DOF", "acceleration");
  expect_description_fault([](D& d) { d.acceleration = {1.0, 0.0}; }, "E_RANGE", "acceleration");
  expect_description_fault([](D& d) { d.max_opening = 0.0; }, "E_RANGE", "gripper.opening");
  expect_description_fault([](D& d) { d.max_opening = 0.2; }, "E_LIMIT", "gripper.opening", "'f1'");
  expect_description_fault([=](D& d) { d.pad_width = nan; }, "E_RANGE", "gripper.pad.width");
  expect_description_fault([](D& d) { d.X_LH.linear() *= 2.0; }, "E_NUMBER", "grasp_frame");
  expect_description_fault([](D& d) { d.X_LH = turn_z(0.3); }, "E_AXIS", "gripper.fingers",
                           "closing axis");
}

}  // namespace
}  // namespace handey
