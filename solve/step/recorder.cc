#include "corank/solve/step/recorder.h"

#include <algorithm>
#include <cmath>

#include "corank/core/check.h"

namespace corank::solve {
namespace {
using Step = Proof::Step;

bool fits_float(double y) { return y == 0 || (std::fabs(y) > 1e-30 && std::fabs(y) < 1e30); }

}  // namespace

std::uint64_t bytes_of(const Proof::Combination& c) {
  return sizeof(c) + 3 * kAllocationBytes + sizeof(int) * (c.equations.size() + c.dependent.size()) +
         sizeof(float) * c.y.size();
}

StepSize size_of_step(Step kind, const std::int32_t* integers) {
  switch (kind) {
    case Step::keep: {
      const std::size_t bounds = integers[0];
      return {1 + bounds, bounds};
    }
    case Step::split: return {1, 1};
    case Step::cut: {
      const std::size_t places = integers[1];
      return {2, places};
    }
    case Step::empty:
    case Step::elsewhere: return {0, 0};
    default: return {1, 0};
  }
}

void round_to_floats(certify::Preconditioner& p) {
  double least = HUGE_VAL, greatest = 0;  // magnitudes; 0 fits
  for (const double y : p.y) {
    const double size = std::fabs(y);
    least = std::min(least, size == 0 ? 1 : size);
    greatest = std::max(greatest, size);
  }
  if (!(fits_float(least) && fits_float(greatest))) return;
  for (double& y : p.y) y = static_cast<double>(static_cast<float>(y));
}

Recorder::Mark Recorder::mark() const {
  return {script_.steps.size(), script_.integers.size(), script_.reals.size(), script_.combinations.size(), nodes_.size()};
}

void Recorder::go_back_to(const Mark& mark) {
  script_.steps.resize(mark.step);
  script_.integers.resize(mark.integer);
  script_.reals.resize(mark.real);
  for (std::size_t k = mark.combinations; k < script_.combinations.size(); ++k)
    combination_bytes_ -= bytes_of(script_.combinations[k]);
  script_.combinations.resize(mark.combinations);
  std::erase_if(nodes_, [&](const auto& node) { return node.second.number >= mark.nodes; });
  open_ = nullptr;
}

std::uint64_t Recorder::bytes() const {
  constexpr std::uint64_t kTreeNode = 48;
  return script_.steps.size() + sizeof(std::int32_t) * script_.integers.size() + sizeof(double) * script_.reals.size() +
         combination_bytes_ + nodes_.size() * (sizeof(Node) + kTreeNode);
}

void Recorder::step(Step s) {
  script_.steps.push_back(static_cast<std::uint8_t>(s));
  close();
}

void Recorder::close() { open_->end = {script_.steps.size(), script_.integers.size(), script_.reals.size()}; }

void Recorder::begin(NodeId node, std::span<const Interval> x, int variables) {
  const Cursor here{script_.steps.size(), script_.integers.size(), script_.reals.size()};
  Node begun{here, here};
  begun.number = nodes_.size();
  open_ = &nodes_.try_emplace(node, begun).first->second;
  kept_.assign(x.begin(), x.begin() + variables);
}

void Recorder::row(int row) {
  script_.integers.push_back(row);
  step(Step::row);
}

void Recorder::newton(const certify::Preconditioner& p, std::span<const Interval> x) {
  if (p.rank() == 0 || !std::ranges::all_of(p.y, fits_float)) return;
  keep(x);
  script_.integers.push_back(static_cast<std::int32_t>(script_.combinations.size()));
  script_.combinations.push_back({p.equations, p.dependent, {p.y.begin(), p.y.end()}});
  combination_bytes_ += bytes_of(script_.combinations.back());
  step(Step::newton);
}

void Recorder::keep(std::span<const Interval> x) {
  std::vector<std::int32_t> sides;
  std::vector<double> bounds;
  for (std::size_t j = 0; j < kept_.size(); ++j) {
    const auto side = static_cast<std::int32_t>(2 * j);
    if (x[j].lo() != kept_[j].lo()) sides.push_back(side), bounds.push_back(x[j].lo());
    if (x[j].hi() != kept_[j].hi()) sides.push_back(side + 1), bounds.push_back(x[j].hi());
    kept_[j] = x[j];
  }
  if (sides.empty()) return;
  script_.integers.push_back(static_cast<std::int32_t>(sides.size()));
  script_.integers.insert(script_.integers.end(), sides.begin(), sides.end());
  script_.reals.insert(script_.reals.end(), bounds.begin(), bounds.end());
  step(Step::keep);
}

void Recorder::split(int variable, double where, NodeId lower, NodeId upper) {
  script_.integers.push_back(variable);
  script_.reals.push_back(where);
  step(Step::split);
  open_->is_split = true;
  open_->lower = lower;
  open_->upper = upper;
}

NodeId Recorder::go_on_later() {
  open_->goes_on = true;
  return open_->upper = new_node();
}

void Recorder::cut(int variable, const std::vector<double>& places) {
  script_.integers.push_back(variable);
  script_.integers.push_back(static_cast<std::int32_t>(places.size()));
  script_.reals.insert(script_.reals.end(), places.begin(), places.end());
  step(Step::cut);
}

void Recorder::leaf_box(std::size_t found) {
  script_.integers.push_back(static_cast<std::int32_t>(found));
  step(Step::box);
}

Proof Recorder::assemble(const std::vector<const Recorder*>& recorders, std::vector<std::vector<Interval>> roots,
                         const std::vector<NodeId>& nodes, const std::map<LeafId, int>& place) {
  Proof proof;
  proof.roots = std::move(roots);
  // A node may have been recorded by another thread than that which made it.
  std::map<NodeId, std::pair<std::size_t, const Node*>> all;
  for (std::size_t k = 0; k < recorders.size(); ++k)
    for (const auto& [id, node] : recorders[k]->nodes_) all[id] = {k, &node};

  const auto copy = [&](std::size_t thread, const Node& node) {
    const Recorder& from = *recorders[thread];
    const std::int32_t* integer = from.script_.integers.data() + node.begin.integer;
    const double* real = from.script_.reals.data() + node.begin.real;
    for (std::size_t s = node.begin.step; s < node.end.step; ++s) {
      const Step kind = static_cast<Step>(from.script_.steps[s]);
      CORANK_CHECK(kind != Step::root);  // which edits of covers make
      const auto [integers, reals] = size_of_step(kind, integer);
      proof.steps.push_back(from.script_.steps[s]);
      proof.integers.insert(proof.integers.end(), integer, integer + integers);
      proof.reals.insert(proof.reals.end(), real, real + reals);
      if (kind == Step::box) proof.integers.back() = place.at(from.leaf(*integer));
      if (kind == Step::newton) {  // numbered as they are used, whichever thread has recorded them
        proof.integers.back() = static_cast<std::int32_t>(proof.combinations.size());
        proof.combinations.push_back(from.script_.combinations[*integer]);
      }
      integer += integers;
      real += reals;
    }
  };
  for (const NodeId root : nodes) {
    std::vector<NodeId> open{root};
    while (!open.empty()) {
      const auto& [thread, node] = all.at(open.back());
      open.pop_back();
      copy(thread, *node);
      if (node->is_split || node->goes_on) open.push_back(node->upper);
      if (node->is_split) open.push_back(node->lower);
    }
  }
  return proof;
}

}  // namespace corank::solve
