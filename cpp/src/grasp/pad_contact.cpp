// Soft-finger contact (Howe and Cutkosky's ellipsoid): friction carries a force f in the grasp
// plane and a torque m about the closing axis while (f / F)^2 + (m / (F r))^2 <= 1, F being the
// friction of both pads, 2 mu N, and r the mean distance of the contact from its centre. The weight
// W at a lever l, in the hand's worst turn, has f = W and m = W l; so l <= r sqrt((F / W)^2 - 1).
#include "pad_contact.hpp"

#include <algorithm>
#include <cmath>

#include "pair_rules.hpp"
#include "ranges.hpp"

namespace handey::grasp {
namespace {

constexpr double kGravity = 9.81;  // [m/s2]
// The mean distance from the centre is at least this share of the radius of gyration: of a line
// 0.866, of a disc 0.943.
constexpr double kMeanOfGyration = 0.866;
// Radius of the contact with a point. Choice: what a soft pad closes about a corner [m].
constexpr double kPointRadius = 0.001;
// A little more than what a plan's check asks of a face.
constexpr double kMoreThanChecked = 1.05;

double volume_of(const Body& part) {
  double volume = 0.0;
  for (const Shape& shape : part.shapes) {
    volume += std::abs(inspect_surface(tessellate(shape)).volume);
  }
  return volume;
}

double mass_of(const Body& part) {
  if (part.mass) return *part.mass;
  return part.density ? *part.density * volume_of(part) : 0.0;
}

// One pad on one feature.
bool touches_enough(const Region& contact, FeatureKind kind, bool at_point, const PlanarPose& pose,
                    const Gripper& gripper, PadPatch& patch) {
  if (kind == FeatureKind::Face) {
    patch = pad_patch(contact, pose, gripper);
    const double pad_area = gripper.pad_width * gripper.pad_length;
    return patch.area >= kMoreThanChecked * std::min(0.1 * pad_area, 25e-6);
  }
  Gripper inside = gripper;
  inside.pad_width = std::max(0.1 * gripper.pad_width, gripper.pad_width - 2.0 * kInsidePad);
  inside.pad_length = std::max(0.1 * gripper.pad_length, gripper.pad_length - 2.0 * kInsidePad);
  patch = pad_patch(contact, pose, inside);
  if (!at_point) return patch.area >= kLeastContactLength * kContactWidth;
  patch.gyration = kPointRadius / kMeanOfGyration;
  return patch.area >= 0.9 * kContactWidth * kContactWidth;
}

}  // namespace

PadContact pad_contact(const RankedPair& pair, const PlanarPose& pose, const Gripper& gripper) {
  PadContact contact;
  const PadPatch common = pad_patch(pair.unobstructed, pose, gripper);
  contact.area = common.area;
  contact.centre = common.centre;
  contact.radius = kMeanOfGyration * common.gyration;
  if (pair.pair.kind == PairKind::FaceFace) {
    contact.both_sides = contact.area > 0.0;
    return contact;
  }
  const bool crossed = pair.pair.kind == PairKind::CrossedEdges;
  const auto at_point = [&](const Feature& feature) {
    return crossed || feature.kind == FeatureKind::Vertex;
  };
  PadPatch a, b;
  const bool enough_a =
      touches_enough(pair.contact_a, pair.pair.a.kind, at_point(pair.pair.a), pose, gripper, a);
  const bool enough_b =
      touches_enough(pair.contact_b, pair.pair.b.kind, at_point(pair.pair.b), pose, gripper, b);
  contact.both_sides = enough_a && enough_b && contact.area > 0.0;
  // The force goes through the edge or the point, wherever on the face that is.
  contact.centre = b.centre;
  contact.radius = 0.5 * kMeanOfGyration * (a.gyration + b.gyration);
  return contact;
}

Hold::Hold(const Body& part, const LegalityOptions& options)
    : mass_(mass_of(part)), friction_(part.friction), force_(options.grip_force) {
  ratio_ = mass_ > 0.0 ? 2.0 * friction_ * force_ / (mass_ * kGravity) : options.grip_ratio;
}

double Hold::reach(const PadContact& contact) const {
  return ratio_ > 1.0 ? contact.radius * std::sqrt(ratio_ * ratio_ - 1.0) : -1.0;
}

double Hold::excess(const RankedPair& pair, const PadContact& contact) const {
  const double reach_of_hold = reach(contact);
  if (reach_of_hold < 0.0) return 1.0;
  return (pair.centre_of_mass - contact.centre).norm() - reach_of_hold;
}

std::string Hold::reason(const RankedPair& pair, const PadContact& contact) const {
  if (ratio_ <= 1.0) {
    std::string text = "the part would slip";
    if (mass_ <= 0.0) return text;
    return text + ": it weighs " + one_decimal(mass_) + " kg, jaws of " + one_decimal(force_) +
           " N hold " + one_decimal(2.0 * friction_ * force_ / kGravity) + " kg by friction";
  }
  const double lever = (pair.centre_of_mass - contact.centre).norm();
  return "the part would turn in the jaws (centre of mass " + millimetres(lever) +
         " mm from the contact, " + millimetres(reach(contact)) + " mm are held)";
}

}  // namespace handey::grasp
