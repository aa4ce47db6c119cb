// What a table depends on, as 128 bits: every number as it lies in memory, mixed in order.
#include <cmath>
#include <cstring>
#include <variant>

#include "arm_table_impl.hpp"

namespace handey::cspace {
namespace {

// Raise it whenever tables of the same robot and options come out otherwise than before.
constexpr std::uint64_t kTableVersion = 1;

/// Two multiply-and-fold sums that see the same words in different ways.
class Mixer {
 public:
  explicit Mixer(const ContentKey& start = {0x6a09e667f3bcc908, 0xbb67ae8584caa73b})
      : key_(start) {}
  void add(std::uint64_t word) {
    key_[0] = fold((key_[0] ^ word) * 0x9e3779b97f4a7c15);
    key_[1] = fold((key_[1] + word) * 0xc2b2ae3d27d4eb4f) ^ key_[0];
  }
  void add(double number) {
    const double value = number == 0.0 ? 0.0 : number;  // one zero
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof(word));
    add(word);
  }
  void add(int number) { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(number))); }

  void add(const Eigen::Vector3d& vector) {
    for (int i = 0; i < 3; ++i) add(vector[i]);
  }
  void add(const Pose& pose) {
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) add(pose.matrix()(row, column));
    }
  }
  const ContentKey& key() const { return key_; }

 private:
  static std::uint64_t fold(std::uint64_t word) { return word ^ (word >> 29); }
  ContentKey key_;
};

void add(Mixer& mixer, const Shape& shape) {
  mixer.add(static_cast<int>(shape.geometry.index()));
  mixer.add(shape.X_BS);
  if (const Box* box = std::get_if<Box>(&shape.geometry)) {
    mixer.add(box->size);
  } else if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
    mixer.add(cylinder->radius);
    mixer.add(cylinder->length);
  } else if (const Sphere* sphere = std::get_if<Sphere>(&shape.geometry)) {
    mixer.add(sphere->radius);
  } else if (const MeshShape* mesh = std::get_if<MeshShape>(&shape.geometry)) {
    mixer.add(static_cast<int>(mesh->mesh->vertices.size()));
    for (const Eigen::Vector3d& vertex : mesh->mesh->vertices) mixer.add(vertex);
    for (const Eigen::Vector3i& triangle : mesh->mesh->triangles) {
      for (int i = 0; i < 3; ++i) mixer.add(triangle[i]);
    }
  }
}

}  // namespace

ContentKey content_key(const Robot& robot) {
  Mixer mixer;
  mixer.add(static_cast<int>(robot.bodies.size()));
  for (const RobotBody& body : robot.bodies) {
    mixer.add(static_cast<int>(body.shapes.size()));
    for (const Shape& shape : body.shapes) add(mixer, shape);
  }
  mixer.add(static_cast<int>(robot.joints.size()));
  for (const ArmJoint& joint : robot.joints) {
    mixer.add(joint.child);
    mixer.add(joint.X_PJ);
    mixer.add(joint.axis);
    mixer.add(joint.limit.lower);
    mixer.add(joint.limit.upper);
  }
  mixer.add(robot.gripper.body);
  mixer.add(robot.gripper.X_BH);
  for (const FingerJoint& finger : robot.gripper.fingers) mixer.add(finger.child);
  return mixer.key();
}

ContentKey table_key(const ArmTable::Impl& table) {
  Mixer mixer(table.robot);
  mixer.add(kTableVersion);
  mixer.add(table.level);
  for (std::size_t j = 0; j < 3; ++j) mixer.add(table.lattice.count[j]);
  mixer.add(table.grid.width);
  for (const int number : {table.grid.rings, table.grid.phases, table.grid.runs}) {
    mixer.add(number);
  }
  return mixer.key();
}

}  // namespace handey::cspace
