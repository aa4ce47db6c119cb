// Edits of a cell, and what makes one valid.
#include "handey/world/cell.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "handey/errors.hpp"

namespace handey {
namespace {

/// Edit distance, for "did you mean".
std::size_t letters_apart(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

void require_part(const Cell& cell, int part) {
  if (part >= 0 && part < static_cast<int>(cell.parts.size())) return;
  throw InvalidInput("E_REF", "part",
                     "index " + std::to_string(part) + ", the cell has " +
                         std::to_string(cell.parts.size()) + " parts");
}

void add_fault(std::vector<Fault>& faults, const std::string& code, const std::string& place,
               const std::string& message) {
  faults.push_back({code, place, message});
}

/// Runs a check that throws and keeps what it says.
template <class Check>
void collect(std::vector<Fault>& faults, const Check& check) {
  try {
    check();
  } catch (const InvalidInput& error) {
    faults.insert(faults.end(), error.faults().begin(), error.faults().end());
  }
}

void check_quantity(std::vector<Fault>& faults, const std::string& place, double value,
                    bool may_be_zero) {
  if (!std::isfinite(value)) {
    add_fault(faults, "E_NUMBER", place, "is not finite");
  } else if (value < 0.0 || (value == 0.0 && !may_be_zero)) {
    add_fault(faults, "E_RANGE", place,
              std::to_string(value) +
                  (may_be_zero ? ", must not be negative" : ", must be greater than 0"));
  }
}

void check_solid(std::vector<Fault>& faults, const Shape& shape, const std::string& place) {
  const MeshShape* mesh = std::get_if<MeshShape>(&shape.geometry);
  if (mesh == nullptr || mesh->mesh == nullptr) return;
  if (!mesh->solid) {
    add_fault(faults, "E_NOT_CLOSED", place,
              "a part's mesh must be a closed solid, this one is an open skin");
    return;
  }
  const SurfaceReport report = inspect_surface(*mesh->mesh);
  if (!report.closed) {
    add_fault(faults, "E_NOT_CLOSED", place,
              "a part's mesh must be closed, this one has " + std::to_string(report.open_edges) +
                  " open edges");
  } else if (!(report.volume > 0.0)) {
    add_fault(faults, "E_MESH_DEGENERATE", place, "the mesh encloses no volume, or is inside out");
  }
}

void check_body(std::vector<Fault>& faults, const Body& body, const std::string& place,
                bool is_part) {
  if (body.name.empty()) add_fault(faults, "E_NAME", place, "a body has an empty name");
  collect(faults, [&] { require_rigid(body.X_WB, place + ".pose"); });
  if (body.shapes.empty()) add_fault(faults, "E_EMPTY", place, "has no shapes");
  for (const Shape& shape : body.shapes) {
    collect(faults, [&] {
      require_valid(shape, place);
      if (is_part) check_solid(faults, shape, place);
    });
  }
  check_quantity(faults, place + ".friction", body.friction, true);
  if (body.mass) check_quantity(faults, place + ".mass", *body.mass, false);
  if (body.density) check_quantity(faults, place + ".density", *body.density, false);
}

void check_start(std::vector<Fault>& faults, const Cell& cell) {
  const Eigen::Index joints = static_cast<Eigen::Index>(cell.robot->joints.size());
  if (cell.start.q.size() != joints) {
    add_fault(faults, "E_DOF", "robot.start",
              "has " + std::to_string(cell.start.q.size()) + " joint values, the arm has " +
                  std::to_string(joints));
  } else if (!cell.start.q.allFinite()) {
    add_fault(faults, "E_NUMBER", "robot.start", "has a joint value that is not finite");
  } else if (const std::string violation = limit_violation(*cell.robot, cell.start.q);
             !violation.empty()) {
    add_fault(faults, "E_LIMIT", "robot.start", violation);
  }
  const Gripper& gripper = cell.robot->gripper;
  if (!std::isfinite(cell.start.opening)) {
    add_fault(faults, "E_NUMBER", "robot.start_opening", "is not finite");
  } else if (cell.start.opening < gripper.min_opening - 1e-9 ||
             cell.start.opening > gripper.max_opening + 1e-9) {
    add_fault(faults, "E_LIMIT", "robot.start_opening",
              std::to_string(cell.start.opening) + ", the gripper opens from " +
                  std::to_string(gripper.min_opening) + " to " +
                  std::to_string(gripper.max_opening));
  }
}

void check_bodies(std::vector<Fault>& faults, const Cell& cell) {
  std::set<std::string> names;
  const auto check_all = [&](const std::vector<Body>& bodies, const std::string& kind,
                             bool are_parts) {
    for (const Body& body : bodies) {
      const std::string place = kind + "." + body.name;
      check_body(faults, body, place, are_parts);
      if (!names.insert(body.name).second)
        add_fault(faults, "E_DUP", place, "a second body of this name");
    }
  };
  check_all(cell.fixtures, "fixtures", false);
  check_all(cell.parts, "parts", true);
}

}  // namespace

const Body& Cell::body(const BodyRef& ref) const {
  const std::vector<Body>& bodies = ref.kind == BodyRef::Kind::Fixture ? fixtures : parts;
  if (ref.index < 0 || ref.index >= static_cast<int>(bodies.size())) {
    throw InvalidInput(
        "E_REF", ref.kind == BodyRef::Kind::Fixture ? "fixtures" : "parts",
        "index " + std::to_string(ref.index) + ", there are " + std::to_string(bodies.size()));
  }
  return bodies[static_cast<std::size_t>(ref.index)];
}

int Cell::part_index(const std::string& part_name) const {
  std::string legal, nearest;
  std::size_t least = 3;  // farther than two letters is no misspelling
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].name == part_name) return static_cast<int>(i);
    legal += (legal.empty() ? "" : ", ") + parts[i].name;
    const std::size_t apart = letters_apart(parts[i].name, part_name);
    if (apart < least) {
      least = apart;
      nearest = parts[i].name;
    }
  }
  std::string message = "no part '" + part_name + "'";
  if (!nearest.empty()) message += ", did you mean '" + nearest + "'?";
  throw InvalidInput("E_REF", "parts",
                     message + "; the cell has: " + (legal.empty() ? "no parts" : legal));
}

Cell Cell::with_part_at(int part, const Pose& X_WP) const {
  require_part(*this, part);
  require_rigid(X_WP, "X_WP");
  Cell edited = *this;
  edited.parts[static_cast<std::size_t>(part)].X_WB = X_WP;
  return edited;
}

Cell Cell::with_held(int part, const Pose& X_HP) const {
  require_part(*this, part);
  require_rigid(X_HP, "X_HP");
  Cell edited = *this;
  edited.held = HeldPart{part, X_HP};
  return edited;
}

Cell Cell::with_released(const Pose& X_WP) const {
  if (!held) throw InvalidInput("E_STATE", "held", "no part is held that could be released");
  Cell edited = with_part_at(held->part, X_WP);
  edited.held.reset();
  return edited;
}

void require_valid(const Cell& cell) {
  if (cell.robot == nullptr) throw InvalidInput("E_MISSING", "robot", "the cell has no robot");
  std::vector<Fault> faults;
  collect(faults, [&] { require_rigid(cell.X_WR, "robot.base"); });
  check_start(faults, cell);
  check_bodies(faults, cell);
  if (cell.held) {
    collect(faults, [&] {
      require_part(cell, cell.held->part);
      require_rigid(cell.held->X_HP, "held.pose");
    });
  }
  if (!faults.empty()) throw InvalidInput(std::move(faults));
}

Pose hand_in_world(const Cell& cell, const Eigen::VectorXd& q) {
  if (cell.robot == nullptr) throw InvalidInput("E_MISSING", "robot", "the cell has no robot");
  return cell.X_WR * hand_pose(*cell.robot, q);
}

}  // namespace handey
