#include "corank/solve/exactness.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "corank/certify/domain.h"
#include "corank/certify/exact_verification.h"
#include "corank/certify/isolation.h"
#include "corank/certify/kernel_bound.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/reduction.h"
#include "corank/certify/refinement.h"
#include "corank/certify/rounding.h"
#include "corank/solve/corank_system.h"
#include "corank/solve/exact_guess.h"
#include "corank/solve/polish.h"

namespace corank::solve {
namespace {

using certify::Box;
using certify::Cover;
using certify::CoverBox;
using certify::ExactNumber;
using certify::ExactPoint;
using certify::Interval;
using certify::System;
using certify::Verdict;

constexpr int kBits = 512;                     // of the arithmetic of guesses
constexpr int kGuessBits = 220;                // that are right in what it finds, also at double solutions
constexpr int kDegree = 4;                     // of algebraic numbers
constexpr std::uint64_t kFaceBoxes = 200'000;  // to search in one face of a blow-up
constexpr double kSmallSingularValue = 0.2;    // relative to the largest: worth a try
constexpr std::size_t kMostOpenBoxes = 3000;   // beyond, clusters are no longer sought
constexpr int kCoreAttempts = 6;
constexpr int kKernelDepth = 6;  // halvings of a box in which the kernel's dimension is bounded

bool contains(const Box& outer, const Box& inner) {
  for (std::size_t j = 0; j < outer.size(); ++j)
    if (!outer[j].contains(inner[j])) return false;
  return true;
}

bool overlap(const Box& a, const Box& b) {
  for (std::size_t j = 0; j < a.size(); ++j)
    if (!a[j].overlaps(b[j])) return false;
  return true;
}

std::vector<double> midpoint(const Box& box) {
  std::vector<double> x;
  for (const Interval& side : box) x.push_back(side.mid());
  return x;
}

std::vector<ExactNumber> dyadic(const std::vector<double>& x) {
  std::vector<ExactNumber> result;
  for (const double c : x) result.push_back(ExactNumber::dyadic(c));
  return result;
}

class Prover {
 public:
  Prover(const System& system, const Options& options, Cover& cover) : system_(system), cover_(cover), options_(options) {
    options_.progress = nullptr;
    options_.max_boxes = options_.max_solutions = 0;
    options_.time_limit = 0;
    options_.sigma = cover.sigma;
  }

  void points() {
    for (CoverBox& point : cover_.points) {
      if (stopped()) return;
      if (point.verdict != Verdict::isolated && point.verdict != Verdict::undecided) continue;
      const std::optional<int> exact = exact_point(point.box);
      if (!exact) continue;
      if (point.verdict == Verdict::isolated) {
        for (CoverBox& box : cover_.boxes)
          if (box.verdict == Verdict::isolated && box.box == point.box) box.point = *exact;
        point.point = *exact;
      } else if (is_only_solution(*exact, point.box)) {
        point.verdict = Verdict::exact;
        point.point = *exact;
        for (std::size_t i = 0; i < cover_.boxes.size(); ++i)
          if (cover_.boxes[i].verdict == Verdict::undecided && contains(point.box, cover_.boxes[i].box))
            replace(i, static_cast<int>(cover_.boxes.size()));
        cover_.boxes.push_back(point);
      }
    }
    finish();
  }

  void coranks() {
    const certify::KernelMatrix matrix = certify::kernel_matrix(system_);
    if (matrix.rows.empty()) return;
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i)
      if (cover_.boxes[i].verdict == Verdict::undecided) open.push_back(i);
    if (open.empty() || open.size() > kMostOpenBoxes) return;
    for (const std::vector<std::size_t>& cluster : clusters(open)) {
      if (stopped()) break;
      Box hull = cover_.boxes[cluster[0]].box;
      for (const std::size_t i : cluster)
        for (std::size_t j = 0; j < hull.size(); ++j) hull[j] = Interval::hull(hull[j], cover_.boxes[i].box[j]);
      const std::optional<int> point = corank_point(matrix, hull);
      if (!point) continue;
      search_around(*point, hull, cluster);
    }
    finish();
  }

  void kernel_dimensions() {
    const certify::KernelBound bound(system_);
    if (!bound.applies()) return;
    const auto treat = [&](CoverBox& box) {
      const certify::UpwardRounding rounding;
      if (box.verdict == Verdict::pending) return;
      box.corank = bound.at_most(box.box);
      if (box.corank <= 1) return;
      for (std::size_t i = 0; i < cover_.exact_points.size() && box.point < 0; ++i)
        if (cover_.exact_points[i].corank >= box.corank && certify::lies_in(cover_.exact_points[i], box.box))
          box.point = static_cast<int>(i);
      if (box.point < 0) box.corank = at_most_on_parts(bound, box.box, kKernelDepth);
    };
    for (CoverBox& box : cover_.boxes) treat(box);
    for (CoverBox& point : cover_.points) treat(point);
  }

 private:
  // Boxes whose union with the core is `all`, and how it is split into them; in the variables that are kept, by their numbers there.
  struct Split {
    int variable;
    double where;
    bool part_is_lower;
  };
  struct Parts {
    std::vector<Box> boxes;
    std::vector<Split> splits;
  };

  int at_most_on_parts(const certify::KernelBound& bound, const Box& box, int depth) const {
    const int whole = bound.at_most(box);
    if (whole <= 1 || depth == 0) return whole;
    std::size_t widest = 0;
    for (std::size_t j = 1; j < box.size(); ++j)
      if (system_.variables[j].kind != certify::VariableKind::kernel && box[j].width() > box[widest].width()) widest = j;
    const Interval side = box[widest];
    const double middle = side.mid();
    if (!(side.lo() < middle && middle < side.hi())) return whole;
    int most = 0;
    for (const Interval& half : {Interval(side.lo(), middle), Interval(middle, side.hi())}) {
      Box part = box;
      part[widest] = half;
      most = std::max(most, at_most_on_parts(bound, part, depth - 1));
      if (most >= whole) return whole;
    }
    return most;
  }

  bool stopped() const { return options_.stop && options_.stop->load(std::memory_order_relaxed); }

  int add(ExactPoint point) {
    const auto known = std::find(cover_.exact_points.begin(), cover_.exact_points.end(), point);
    if (known != cover_.exact_points.end()) return static_cast<int>(known - cover_.exact_points.begin());
    cover_.exact_points.push_back(std::move(point));
    return static_cast<int>(cover_.exact_points.size()) - 1;
  }

  // A verified solution in the box.
  std::optional<int> exact_point(const Box& box) {
    const std::vector<double> start = polish(system_, box).value_or(midpoint(box));
    const auto zero = certify::approximate_zero(system_, dyadic(start), kBits);
    if (!zero) return std::nullopt;
    auto point = guess_exactly({zero->begin(), zero->end()}, kGuessBits, kDegree);
    if (!point) return std::nullopt;
    const certify::ExactVerification verified = certify::verify_exactly(system_, *point);
    if (!verified.holds || !certify::lies_in(*point, box)) return std::nullopt;
    point->corank = verified.corank;
    return add(std::move(*point));
  }

  bool is_only_solution(int index, const Box& box) {
    ExactPoint& point = cover_.exact_points[static_cast<std::size_t>(index)];
    // A power of two that is large enough: a double as well as a rational number.
    double radius = std::ldexp(1.0, -60);
    const ExactNumber needed = certify::reach(point, box);
    while ((ExactNumber::dyadic(radius) - needed).sign() != 1) radius *= 2;
    const auto faces = certify::blow_up(system_, point, ExactNumber::dyadic(radius));
    if (!faces) return false;
    Options options;
    options.threads = options_.threads;
    options.stop = options_.stop;
    options.max_boxes = kFaceBoxes;
    for (const System& face : *faces) {
      const Cover solutions = solve(face, options);
      if (!solutions.complete() || !solutions.boxes.empty()) return false;
    }
    point.sole_within = radius;
    return true;
  }

  std::vector<std::vector<std::size_t>> clusters(const std::vector<std::size_t>& open) const {
    std::vector<std::vector<std::size_t>> result;
    std::vector<bool> taken(open.size(), false);
    for (std::size_t a = 0; a < open.size(); ++a) {
      if (taken[a]) continue;
      std::vector<std::size_t> cluster{a};
      taken[a] = true;
      for (std::size_t at = 0; at < cluster.size(); ++at)
        for (std::size_t b = 0; b < open.size(); ++b)
          if (!taken[b] && overlap(cover_.boxes[open[cluster[at]]].box, cover_.boxes[open[b]].box)) {
            taken[b] = true;
            cluster.push_back(b);
          }
      for (std::size_t& i : cluster) i = open[i];
      result.push_back(std::move(cluster));
    }
    return result;
  }

  // A verified configuration in or next to the box where the kernel has dimension 2 or more.
  std::optional<int> corank_point(const certify::KernelMatrix& matrix, const Box& hull) {
    const std::vector<double> x = midpoint(hull);
    const std::vector<double> s = singular_values(matrix, x);
    const int k = static_cast<int>(s.size());
    for (int c = 2; c <= k && s[static_cast<std::size_t>(k - c)] < kSmallSingularValue * s[0]; ++c) {
      const CorankSystem extended = corank_system(system_, matrix, x, c);
      const auto zero = certify::approximate_zero(extended.system, dyadic(extended.start), kBits);
      if (!zero) continue;
      std::vector<std::optional<ExactNumber>> coordinates(x.size());
      for (std::size_t j = 0; j < extended.configuration.size(); ++j)
        coordinates[static_cast<std::size_t>(extended.configuration[j])] = (*zero)[j];
      auto point = guess_exactly(coordinates, kGuessBits, kDegree);
      if (!point) continue;
      const certify::ExactVerification verified = certify::verify_exactly(system_, *point);
      if (!verified.holds || verified.corank < 2) continue;
      point->corank = verified.corank;
      // Next to the box: no farther than a box may be wide.
      const ExactNumber far = certify::reach(*point, hull);
      if ((far - ExactNumber::dyadic(3 * cover_.sigma)).sign() == 1) continue;
      return add(std::move(*point));
    }
    return std::nullopt;
  }

  // Box i of the cover goes; in the proof, `box i` becomes `box by`.
  void replace(std::size_t i, int by) {
    replaced_.resize(cover_.boxes.size(), kStays);
    replaced_[i] = by;
  }

  // Removes the boxes that were replaced, sorts the others as solve() does, and renumbers them in the proof.
  void finish() {
    replaced_.resize(cover_.boxes.size(), kStays);
    std::vector<int> order;
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i)
      if (replaced_[i] == kStays) order.push_back(static_cast<int>(i));
    std::vector<int> variables = reduction_.kept;
    for (const auto& definition : reduction_.definitions) variables.push_back(definition.variable);
    const auto before = [&](int i, int k) {
      const CoverBox &a = cover_.boxes[static_cast<std::size_t>(i)], &b = cover_.boxes[static_cast<std::size_t>(k)];
      for (const int v : variables) {
        const Interval &x = a.box[static_cast<std::size_t>(v)], &y = b.box[static_cast<std::size_t>(v)];
        if (x.lo() != y.lo()) return x.lo() < y.lo();
        if (x.hi() != y.hi()) return x.hi() < y.hi();
      }
      return std::tie(a.verdict, a.free) < std::tie(b.verdict, b.free);
    };
    std::sort(order.begin(), order.end(), before);
    std::vector<int> place(cover_.boxes.size(), -1);
    std::vector<CoverBox> boxes;
    for (const int i : order) {
      place[static_cast<std::size_t>(i)] = static_cast<int>(boxes.size());
      boxes.push_back(std::move(cover_.boxes[static_cast<std::size_t>(i)]));
    }
    cover_.boxes = std::move(boxes);
    if (!cover_.proof) return;
    auto proof = std::make_shared<certify::Proof>(*cover_.proof);
    change_leaves(*proof, [&](int i) {
      const int by = replaced_[static_cast<std::size_t>(i)];
      if (by <= kInRoot) return Leaf{certify::Proof::Step::root, kInRoot - by};
      return Leaf{certify::Proof::Step::box, place[static_cast<std::size_t>(by == kStays ? i : by)]};
    });
    cover_.proof = std::move(proof);
  }

  // The search again, in the hull without a core about the point's known coordinates; then the core itself. Nothing changes where even large
  // cores leave boxes undecided around them.
  void search_around(int index, const Box& hull, const std::vector<std::size_t>& cluster) {
    const ExactPoint& point = cover_.exact_points[static_cast<std::size_t>(index)];
    double half = 0;
    for (std::size_t j = 0; j < hull.size(); ++j)
      if (!point.coordinates[j].empty()) half = std::max(half, 0.25 * hull[j].width());
    for (int attempt = 0; attempt < kCoreAttempts && 2 * half <= cover_.sigma; ++attempt, half *= 2) {
      Box core = hull, all = hull;
      const certify::AlgebraicNumber t(point.polynomial, point.lower, point.upper);
      for (const int kept : reduction_.kept) {
        const std::size_t j = static_cast<std::size_t>(kept);
        if (point.coordinates[j].empty()) continue;
        const auto bounds = t.bounds(point.coordinates[j], ExactNumber::dyadic(half / 64));
        core[j] = Interval(bounds.lower.enclose().lo() - half, bounds.upper.enclose().hi() + half);
        all[j] = Interval::hull(hull[j], core[j]);
      }
      Options options = options_;
      const Parts parts = difference(all, core);
      if (parts.boxes.empty()) return;
      options.roots = parts.boxes;
      Cover around = solve(system_, options);
      cover_.statistics.processed += around.statistics.processed;
      cover_.statistics.newton_steps += around.statistics.newton_steps;
      cover_.statistics.proofs_tried += around.statistics.proofs_tried;
      if (!around.complete()) return;
      if (around.count(Verdict::undecided) > 0) continue;
      core = with_values(core);
      if (!certify::lies_in(point, core)) return;
      if (cover_.proof && !around.proof) return;
      const int first = static_cast<int>(cover_.boxes.size()), region = static_cast<int>(cover_.regions.size());
      std::move(around.regions.begin(), around.regions.end(), std::back_inserter(cover_.regions));
      for (CoverBox& box : around.boxes) {
        if (box.region >= 0) box.region += region;
        cover_.boxes.push_back(std::move(box));
      }
      cover_.boxes.emplace_back(std::move(core), Verdict::undecided, std::vector<int>{});
      cover_.boxes.back().point = index;
      const int root = cover_.proof ? append_proof(all, parts, *around.proof, first) : 0;
      for (const std::size_t i : cluster) replace(i, kInRoot - root);
      return;
    }
  }

  // Adds to the proof: a root for the box `all`, which is split into the parts, each the root of its own search, and the core,
  // the last box of the cover. Returns the root's number.
  int append_proof(const Box& all, const Parts& parts, certify::Proof around, int first_box) {
    using Step = certify::Proof::Step;
    certify::Proof proof = *cover_.proof;
    const int root = static_cast<int>(proof.roots.size());
    const auto add_leaf = [&](Step kind, int index) {
      proof.steps.push_back(static_cast<std::uint8_t>(kind));
      proof.integers.push_back(index);
    };
    proof.roots.emplace_back();
    for (std::size_t k = 0; k < reduction_.kept.size(); ++k) {
      Interval side = all[static_cast<std::size_t>(reduction_.kept[k])];
      side.intersect(reduction_.system.variables[k].domain);
      proof.roots.back().push_back(side);
    }
    // The parts came one after the other: each split leaves one part and what goes on. Those that lie below come at once, those above after
    // all that follows.
    std::vector<int> above;
    for (std::size_t k = 0; k < parts.splits.size(); ++k) {
      const Split& split = parts.splits[k];
      proof.steps.push_back(static_cast<std::uint8_t>(Step::split));
      proof.integers.push_back(split.variable);
      proof.reals.push_back(split.where);
      const int part = root + 1 + static_cast<int>(k);
      if (split.part_is_lower) {
        add_leaf(Step::root, part);
      } else {
        above.push_back(part);
      }
    }
    add_leaf(Step::box, static_cast<int>(cover_.boxes.size()) - 1);
    for (auto part = above.rbegin(); part != above.rend(); ++part) add_leaf(Step::root, *part);
    // The searches of the parts follow.
    const auto combination = static_cast<std::int32_t>(proof.combinations.size());
    change_steps(around, [&](Step kind, std::int32_t* integers) {
      if (kind == Step::newton) integers[0] += combination;
      if (kind == Step::box) integers[0] += first_box;
    });
    std::move(around.roots.begin(), around.roots.end(), std::back_inserter(proof.roots));
    std::move(around.combinations.begin(), around.combinations.end(), std::back_inserter(proof.combinations));
    proof.steps.insert(proof.steps.end(), around.steps.begin(), around.steps.end());
    proof.integers.insert(proof.integers.end(), around.integers.begin(), around.integers.end());
    proof.reals.insert(proof.reals.end(), around.reals.begin(), around.reals.end());
    cover_.proof = std::make_shared<const certify::Proof>(std::move(proof));
    return root;
  }

  // Calls change(kind, its first integer) for every step.
  template <class Change>
  static void change_steps(certify::Proof& proof, Change change) {
    using Step = certify::Proof::Step;
    std::size_t integer = 0;
    for (const std::uint8_t s : proof.steps) {
      const Step kind = static_cast<Step>(s);
      std::int32_t* const at = proof.integers.data() + integer;
      switch (kind) {
        case Step::row:
        case Step::newton:
        case Step::split:
        case Step::box:
        case Step::root: integer += 1; break;
        case Step::keep: integer += 1 + static_cast<std::size_t>(*at); break;
        case Step::cut: integer += 2; break;
        case Step::empty:
        case Step::elsewhere: break;
      }
      change(kind, at);
    }
  }

  struct Leaf {
    certify::Proof::Step step;
    int index;
  };
  // Every leaf `box i` becomes leaf_of(i).
  template <class LeafOf>
  static void change_leaves(certify::Proof& proof, LeafOf leaf_of) {
    std::size_t step = 0;
    change_steps(proof, [&](certify::Proof::Step kind, std::int32_t* integers) {
      if (kind == certify::Proof::Step::box) {
        const Leaf leaf = leaf_of(*integers);
        *integers = leaf.index;
        proof.steps[step] = static_cast<std::uint8_t>(leaf.step);
      }
      ++step;
    });
  }

  // The box with the sides of eliminated variables that those of the others imply.
  Box with_values(const Box& box) const {
    const certify::UpwardRounding rounding;
    Box sides;
    for (const int j : reduction_.kept) sides.push_back(box[static_cast<std::size_t>(j)]);
    const Box kept = sides;
    for (const auto& definition : reduction_.definitions) sides.push_back(certify::evaluate(definition.value, kept));
    Box result = reduction_.lift(sides);
    certify::clip_to_domain(system_, result);
    return result;
  }

  Parts difference(Box all, const Box& core) const {
    Parts parts;
    for (std::size_t k = 0; k < reduction_.kept.size(); ++k) {
      const std::size_t j = static_cast<std::size_t>(reduction_.kept[k]);
      Interval side = all[j], inner = core[j];
      if (!side.intersect(reduction_.system.variables[k].domain) || !inner.intersect(side)) return {};
      if (side.lo() < inner.lo()) {
        parts.boxes.push_back(all);
        parts.boxes.back()[j] = Interval(side.lo(), inner.lo());
        parts.splits.push_back({static_cast<int>(k), inner.lo(), true});
      }
      if (inner.hi() < side.hi()) {
        parts.boxes.push_back(all);
        parts.boxes.back()[j] = Interval(inner.hi(), side.hi());
        parts.splits.push_back({static_cast<int>(k), inner.hi(), false});
      }
      all[j] = inner;
    }
    return parts;
  }

  const System& system_;
  Cover& cover_;
  Options options_;
  const certify::Reduction reduction_ = certify::reduce(system_);  // what solve() searches
  // Of each box of the cover: it stays; the box that takes its place; or kInRoot − the root of the proof that does.
  static constexpr int kStays = -1, kInRoot = -2;
  std::vector<int> replaced_;
};

}  // namespace

void prove_exactly(const System& system, const Options& options, Cover& cover) {
  if (system.coefficient_tolerance > 0) return;
  Prover prover(system, options, cover);
  if (cover.dimension == 0) {
    prover.points();
  } else {
    prover.coranks();
  }
  prover.kernel_dimensions();
}

void prove_decimals(const System& system, int digits, Cover& cover) {
  cover.decimals.clear();
  const certify::Reduction reduction = certify::reduce(system);
  for (const CoverBox& point : cover.points) {
    std::vector<std::string>& decimals = cover.decimals.emplace_back();
    if (point.point >= 0) {
      const ExactPoint& exact = cover.exact_points[static_cast<std::size_t>(point.point)];
      const certify::AlgebraicNumber t(exact.polynomial, exact.lower, exact.upper);
      const ExactNumber width = pow(ExactNumber(10), -digits - 2);
      for (const auto& x : exact.coordinates) {
        const auto bounds = t.bounds(x, width);
        decimals.push_back(certify::proven_decimal(bounds.lower, bounds.upper, digits));
      }
    } else if (point.verdict == Verdict::isolated) {
      std::vector<ExactNumber> start;
      for (const int j : reduction.kept) start.push_back(ExactNumber::dyadic(point.box[static_cast<std::size_t>(j)].mid()));
      const auto zero = certify::prove_zero(reduction.system, start, digits + 2);
      if (!zero || reduction.tolerant || reduction.subset) continue;
      // The region of the proof holds exactly one solution: one that is proven in it is that.
      const Box& region = point.region >= 0 ? cover.regions[static_cast<std::size_t>(point.region)] : point.box;
      const auto inside = [&](std::size_t j) {
        const Interval& side = region[static_cast<std::size_t>(reduction.kept[j])];
        return (zero->sides[j].first - ExactNumber::dyadic(side.lo())).sign() != -1 &&
               (zero->sides[j].second - ExactNumber::dyadic(side.hi())).sign() != 1;
      };
      bool same = true;
      for (std::size_t j = 0; j < reduction.kept.size(); ++j) same = same && inside(j);
      if (!same) continue;
      decimals.resize(system.variables.size());
      for (std::size_t j = 0; j < reduction.kept.size(); ++j)
        decimals[static_cast<std::size_t>(reduction.kept[j])] =
            certify::proven_decimal(zero->sides[j].first, zero->sides[j].second, digits);
      for (const auto& definition : reduction.definitions) {
        const auto value = certify::bounds(definition.value, zero->sides, zero->bits);
        decimals[static_cast<std::size_t>(definition.variable)] = certify::proven_decimal(value.first, value.second, digits);
      }
    }
  }
}

}  // namespace corank::solve
