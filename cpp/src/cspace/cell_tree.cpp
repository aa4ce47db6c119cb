// Cells that are cut where it helps.
#include "cell_tree.hpp"

#include <algorithm>
#include <cmath>

namespace handey::cspace {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kTouch = 1e-7;  // a configuration this near to a cell is in it [rad]

int floor_div(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

}  // namespace

CellTree::CellTree(BlockedCells::Impl& proofs, int finest_level)
    : proofs_(proofs), lattice_(proofs.lattice), finest_(finest_level) {
  const int n0 = lattice_.count[0], n1 = lattice_.count[1], n2 = lattice_.count[2];
  cells_.resize(static_cast<std::size_t>(n0) * static_cast<std::size_t>(n1) *
                static_cast<std::size_t>(n2));
  std::size_t id = 0;
  for (int i = 0; i < n0; ++i) {
    for (int j = 0; j < n1; ++j) {
      for (int k = 0; k < n2; ++k) cells_[id++].index = {i, j, k};
    }
  }
}

CellState CellTree::look(int id) {
  TreeCell& cell = cells_[static_cast<std::size_t>(id)];
  if (cell.state != CellState::Unknown) return cell.state;
  ++looked_at_;
  finest_looked_at_ = std::max<int>(finest_looked_at_, cell.level);
  cell.proof = proofs_.proving_pair(cell.level, cell.index);
  if (cell.proof != kNoPair) {
    cell.state = CellState::Blocked;
  } else if (cell.level >= finest_ || !proofs_.can_be_blocked(cell.level, cell.index)) {
    cell.state = CellState::Open;
  } else {
    cell.state = CellState::Doubt;
  }
  return cell.state;
}

void CellTree::cut(int id) {
  const int first = static_cast<int>(cells_.size());
  const TreeCell parent = cells_[static_cast<std::size_t>(id)];
  for (int k = 0; k < 8; ++k) {
    TreeCell child;
    child.level = static_cast<signed char>(parent.level + 1);
    for (std::size_t j = 0; j < 3; ++j) child.index[j] = 2 * parent.index[j] + (k >> j & 1);
    cells_.push_back(child);
  }
  cells_[static_cast<std::size_t>(id)].children = first;
  cells_[static_cast<std::size_t>(id)].state = CellState::Cut;
}

void CellTree::leaves_at(const Eigen::VectorXd& q, std::vector<int>& leaves) const {
  Span span;
  for (std::size_t j = 0; j < 3; ++j) {
    const double edge = lattice_.width[j] / (1 << finest_);
    double offset = q[static_cast<Eigen::Index>(j)] - lattice_.lower[j];
    const double round = lattice_.width[j] * lattice_.count[j];
    if (lattice_.wraps[j]) offset -= round * std::floor(offset / round);
    if (edge <= 0.0) {  // a joint that cannot move
      span.lower[j] = 0;
      span.upper[j] = 2 << finest_;
      continue;
    }
    const int above = static_cast<int>(std::ceil((offset - kTouch) / edge));
    const int below = static_cast<int>(std::floor((offset + kTouch) / edge));
    span.lower[j] = above <= below ? 2 * above : 2 * below + 1;
    span.upper[j] = above <= below ? 2 * below : 2 * below + 1;
  }
  leaves.clear();
  collect(span, leaves);
}

void CellTree::neighbours(int id, std::vector<int>& leaves) const {
  const TreeCell& cell = cells_[static_cast<std::size_t>(id)];
  const int size = 2 << (finest_ - cell.level);
  Span span;
  for (std::size_t j = 0; j < 3; ++j) {
    span.lower[j] = cell.index[j] * size;
    span.upper[j] = span.lower[j] + size;
  }
  leaves.clear();
  collect(span, leaves);
}

double CellTree::gap(int id, const Eigen::VectorXd& q) const {
  const TreeCell& cell = cells_[static_cast<std::size_t>(id)];
  double widest = 0.0;
  for (int j = 0; j < 3; ++j) {
    double gap = q[j] - lattice_.centre(cell.level, j, cell.index[static_cast<std::size_t>(j)]);
    if (lattice_.wraps[static_cast<std::size_t>(j)]) gap = std::remainder(gap, 2.0 * kPi);
    widest = std::max(widest, std::abs(gap));
  }
  return widest;
}

Eigen::VectorXd CellTree::middle(int id, const Eigen::VectorXd& q) const {
  const TreeCell& cell = cells_[static_cast<std::size_t>(id)];
  Eigen::VectorXd result = q;
  for (int j = 0; j < 3; ++j) {
    result[j] = lattice_.centre(cell.level, j, cell.index[static_cast<std::size_t>(j)]);
  }
  return result;
}

/// Leaves whose closed boxes meet the span.
void CellTree::collect(const Span& span, std::vector<int>& leaves) const {
  const int size = 2 << finest_;
  std::array<int, 3> first{}, last{};
  for (std::size_t j = 0; j < 3; ++j) {
    first[j] = floor_div(span.lower[j] - 1, size);
    last[j] = floor_div(span.upper[j], size);
    if (!lattice_.wraps[j]) {
      first[j] = std::max(first[j], 0);
      last[j] = std::min(last[j], lattice_.count[j] - 1);
    }
  }
  const auto wrapped = [this](int i, std::size_t j) {
    const int n = lattice_.count[j];
    return ((i % n) + n) % n;
  };
  for (int i = first[0]; i <= last[0]; ++i) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int k = first[2]; k <= last[2]; ++k) {
        const std::array<int, 3> at{wrapped(i, 0), wrapped(j, 1), wrapped(k, 2)};
        const int id = (at[0] * lattice_.count[1] + at[1]) * lattice_.count[2] + at[2];
        if (cells_[static_cast<std::size_t>(id)].state != CellState::Cut) {
          leaves.push_back(id);
          continue;
        }
        descend(id, span, {(i - at[0]) * size, (j - at[1]) * size, (k - at[2]) * size}, leaves);
      }
    }
  }
}

void CellTree::descend(int id, const Span& span, const std::array<int, 3>& shift,
                       std::vector<int>& leaves) const {
  const TreeCell& cell = cells_[static_cast<std::size_t>(id)];
  const int size = 2 << (finest_ - cell.level);
  for (std::size_t j = 0; j < 3; ++j) {
    const int lower = cell.index[j] * size + shift[j];
    if (lower > span.upper[j] || lower + size < span.lower[j]) return;
  }
  if (cell.state != CellState::Cut) {
    leaves.push_back(id);
    return;
  }
  for (int k = 0; k < 8; ++k) descend(cell.children + k, span, shift, leaves);
}

}  // namespace handey::cspace
