#include "corank/check/sheets.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "corank/core/box.h"

namespace corank::check {
namespace {

using Center = Krawczyk::Center;

constexpr int kMostPartsOfSheet = 4096;
constexpr int kProofSteps = 12;
constexpr int kTightenings = 2, kPointTightenings = 30;

class SheetCheck {
 public:
  SheetCheck(const Problem& problem, const std::vector<Row>& equations, const CoverBox& box, const Box& region,
             bool may_be_part)
      : problem_(problem),
        equations_(equations),
        box_(box),
        region_(region),
        may_be_part_(may_be_part),
        newton_(equations, problem.size()) {}

  std::string run() {
    if (std::string fault = check_shape(); !fault.empty()) return fault;
    Sides x;
    for (const int j : problem_.kept()) x.emplace_back(is_free_[j] || in_part_ ? box_.box[j] : region_[j]);
    examine(x, false);
    return reason_;
  }

  // After run(): does the region not span the box's free sides?
  bool is_in_part() const { return in_part_; }

 private:
  std::string check_shape() {
    const std::size_t n = problem_.system().variables.size();
    if (box_.box.size() != n || region_.size() != n) return "it does not have one side for each variable";
    is_free_.assign(n, 0);
    for (const int j : box_.free) {
      if (j < 0 || j >= static_cast<int>(n) || problem_.place(j) < 0 || is_free_[j])
        return "its free variables are not distinct variables that were kept";
      is_free_[j] = 1;
    }
    for (std::size_t k = 0; k < problem_.kept().size(); ++k)
      if (!is_free_[problem_.kept()[k]]) dependent_.push_back(static_cast<int>(k));
    if (dependent_.size() != equations_.size())
      return "the equations that remain are not as many as the dependent variables";
    for (std::size_t j = 0; j < n; ++j)
      if (const Variable& v = problem_.system().variables[j];
          v.is_parameter() && !(is_free_[j] && box_.box[j].contains(v.domain)))
        return "it does not hold for every value of " + v.name;
    const bool is_point = std::cmp_equal(box_.free.size(), problem_.system().parameters());
    if (box_.verdict == (is_point ? Verdict::regular : Verdict::isolated))
      return "its free variables contradict its verdict";
    in_part_ = may_be_part_ && !spans_free_sides(box_, region_);
    if (in_part_) return contains(box_.box, region_) ? "" : "it is not inside the region of its proof, and does not hold it";
    return contains(region_, box_.box) ? "" : "it is not inside the region of its proof";
  }

  bool fail(const std::string& reason) {
    if (reason_.empty()) reason_ = reason;
    return false;
  }

  // Nothing is in a part: what is said of its solutions holds, but a sheet would have some.
  bool empty(const std::string& reason) { return in_part_ || fail(reason); }

  // x: a part of the box's free sides, dependent sides that hold every solution of the region over them. `proven`: there is
  // exactly one for every value. False: stop.
  bool examine(Sides x, bool proven) {
    problem_.stop().poll();
    if (++parts_ > kMostPartsOfSheet) return fail(pending_reason_.empty() ? "too many parts" : pending_reason_);
    if (!proven) {
      const bool shown = prove(x);
      if (!reason_.empty()) return false;
      if (!shown) return bisect(x, false);
    } else if (!newton_.set(dependent_, x, Center::polished)) {
      pending_reason_ = "the Jacobian is singular";
      return bisect(x, true);
    }
    const bool indivisible = choose(x, false, -1) < 0;  // a point, or free sides that are one: no halves will be narrower
    const int steps = indivisible ? kPointTightenings : kTightenings;
    for (int step = 0;; ++step) {
      if ((step > 0 || proven) && !newton_.shrink(x, newton_.image(x))) return empty("a part of it has no solution");
      if (settled(x)) return true;
      if (!reason_.empty()) return false;
      // The region's one solution, for each value of the free variables.
      if ((indivisible || step == steps) && newton_.center_solves(x) && center_in_region()) {
        for (const int k : dependent_) x[k] = Enclosure(newton_.center()[k]);
        if (settled(x)) return true;
        break;
      }
      if (step == steps) {
        // A bound that a solution touches: where one equation alone gives it exactly, no combination may.
        for (const Row& f : equations_)
          if (!f.project(x, true)) return empty("a part of it has no solution");
        if (settled(x)) return true;
        break;
      }
      if ((indivisible || step == 0) && !newton_.set(dependent_, x, indivisible ? point_center_ : Center::polished)) break;
    }
    return bisect(x, true);
  }

  // Existence, but of a box in part, and uniqueness over x; shrinks its dependent sides to what holds the solutions. False:
  // not shown.
  bool prove(Sides& x) {
    pending_reason_ = "the Jacobian is singular";
    if (in_part_) return prove_unique(x);
    // About the middle of x; about a solution; about the middle of the region, as the search may have done it. Each time
    // from x as it is: a side that was shrunk to an image has no interior left for the next.
    Sides region = problem_.kept(region_);
    for (const auto& [around, center] : {std::pair(&x, Center::middle), {&x, Center::polished}, {&region, Center::middle}}) {
      Sides part = x;
      if (newton_.set(dependent_, *around, center) && prove_about_center(part)) {
        x = std::move(part);
        return true;
      }
      if (!reason_.empty()) return false;
    }
    if (prove_near_box(x)) return true;
    if (!reason_.empty() || !box_.free.empty()) return false;
    // A point near a double one.
    if (!newton_.set(dependent_, x, Center::refined) || !prove_about_center(x)) return false;
    point_center_ = Center::refined;
    return true;
  }

  // x may hold nothing: then it stays as it is.
  bool prove_unique(Sides& x) {
    pending_reason_ = "uniqueness in it is not shown";
    if (!newton_.set(dependent_, x, Center::middle)) return false;
    Sides part = x;
    const bool some = newton_.shrink(part, newton_.image(x));
    if (some) x = std::move(part);
    return !some || newton_.is_injective(x);
  }

  bool prove_about_center(Sides& x) {
    bool exists = false;
    for (int step = 0; step < kProofSteps; ++step) {
      problem_.stop().poll();
      const Sides image = newton_.image(x);
      exists = exists || newton_.is_inside(image, x);  // K ⊂ int Z: a fixed point for every value of the free variables
      if (exists && newton_.is_injective(x))
        return newton_.shrink(x, image) || fail("existence and emptiness contradict each other");
      double former = 0, now = 0;
      for (std::size_t a = 0; a < image.size(); ++a) former = std::max(former, x[place(a)].width());
      if (!newton_.shrink(x, image)) return fail("a part of it has no solution in its region");
      for (std::size_t a = 0; a < image.size(); ++a) now = std::max(now, x[place(a)].width());
      if (now > 0.9 * former) break;
    }
    pending_reason_ = exists ? "uniqueness in its region is not shown" : "existence in its region is not shown";
    return false;
  }

  // The box may fill its region so nearly that K about another centre than the solver's leaves it. Then: existence in a Z
  // that ε-inflation of the box's sides finds, wherever it leads; at most one solution in the hull of Z and x, where the
  // box is in a corner of its region with a Y of the hull's own (corollary of doc/theory.md). That one is all that the
  // region may hold, and x becomes what holds it: whether it lies in the box is still to be shown.
  bool prove_near_box(Sides& x) {
    constexpr int kInflations = 10;
    Sides z = x;
    for (std::size_t a = 0; a < dependent_.size(); ++a) z[place(a)] = Enclosure(box_.box[problem_.kept()[place(a)]]);
    if (!newton_.set(dependent_, z, Center::polished)) return false;
    for (int step = 0; step < kInflations; ++step) {
      problem_.stop().poll();
      const Sides image = newton_.image(z);
      if (!std::ranges::all_of(image, [](const Enclosure& k) { return k.is_bounded(); })) return false;
      if (newton_.is_inside(image, z)) {
        Sides both = z;
        for (std::size_t a = 0; a < image.size(); ++a) both[place(a)] = Enclosure::hull(z[place(a)], x[place(a)]);
        if (!newton_.is_injective(both) && !(newton_.is_injective(z) && is_injective_about_middle(both))) return false;
        for (std::size_t a = 0; a < image.size(); ++a) x[place(a)] = image[a];
        return true;
      }
      for (std::size_t a = 0; a < image.size(); ++a) {
        const double margin = 0.1 * image[a].width() + 1e-15 * image[a].mag() + 1e-300;
        z[place(a)] = Enclosure(image[a].lo() - margin, image[a].hi() + margin);
      }
    }
    return false;
  }

  bool is_injective_about_middle(const Sides& x) const {
    Krawczyk newton(equations_, problem_.size());
    return newton.set(dependent_, x, Center::middle) && newton.is_injective(x);
  }

  bool center_in_region() const {
    const std::vector<double>& center = newton_.center();
    for (std::size_t k = 0; k < center.size(); ++k)
      if (!region_[problem_.kept()[k]].contains(center[k])) return false;
    return true;
  }

  std::size_t place(std::size_t a) const { return dependent_[a]; }

  // After image(x0), x ⊂ x0 holding the solutions over x's free sides: do they lie in the box, and where asked in the
  // domain?
  bool settled(const Sides& x) {
    wide_ = -1;
    for (std::size_t a = 0; a < dependent_.size(); ++a) {
      const int v = problem_.kept()[place(a)];
      if (inside(x[place(a)], v)) continue;
      wide_ = static_cast<int>(a);
      return false;
    }
    Sides clipped = x;
    if (!problem_.clip_to_implied(clipped)) return empty("a part of it lies outside a domain that the equations imply");
    for (const Problem::Value& v : problem_.values()) {
      Enclosure value = v.row.value(clipped);
      if (value.inside(box_.box[v.variable])) continue;
      value.intersect(newton_.value_at_zeros(v.row, x));
      if (!inside(value, v.variable)) return false;
    }
    if (box_.verdict == Verdict::boundary) return true;
    for (const Condition& condition : problem_.conditions()) {
      if (condition.implied || is_end_of_free(condition)) continue;
      Enclosure value = condition.row.value(clipped);
      if (!value.is_nonnegative()) value.intersect(newton_.value_at_zeros(condition.row, x));
      if (value.is_nonnegative()) continue;
      const std::string what =
          condition.variable < 0 ? "an inequality" : "the domain of " + problem_.system().variables[condition.variable].name;
      if (value.is_negative() && !in_part_) return fail("a part of it violates " + what);
      pending_reason_ = "it may violate " + what;
      return false;
    }
    return true;
  }

  // Of a free variable whose side reaches no farther than its domain's ends, rounded outward, or than those of a variable
  // that is an affine function of it: the claim is about values in the domain.
  bool is_end_of_free(const Condition& condition) const {
    const auto is_free = [&](int variable) { return std::ranges::find(box_.free, variable) != box_.free.end(); };
    if (condition.image && is_free(condition.image->of)) {
      const Interval& side = box_.box[condition.image->of];
      return condition.image->is_lower ? side.lo() >= condition.image->end : side.hi() <= condition.image->end;
    }
    if (condition.variable < 0 || !is_free(condition.variable)) return false;
    const std::size_t j = condition.variable;
    return problem_.system().variables[j].domain.contains(box_.box[j]);
  }

  bool inside(const Enclosure& side, int variable) {
    const Interval& bound = box_.box[variable];
    if (side.inside(bound)) return true;
    const std::string& name = problem_.system().variables[variable].name;
    if (!side.overlaps(bound) && !in_part_) return fail("a solution of its region lies outside it (" + name + ")");
    pending_reason_ = "a solution of its region may lie outside it (" + name + ")";
    return false;
  }

  // The free variable, by its place among the kept, whose halves narrow most: the side that was too wide if it alone is
  // `meant`, else any; −1: none.
  int choose(const Sides& x, bool proven, int meant) const {
    int along = -1;
    double most = 0;
    for (const int j : box_.free) {
      const int k = problem_.place(j);
      double share = meant >= 0 ? newton_.steepness(meant, k) : 1;
      for (std::size_t a = 0; proven && meant < 0 && a < dependent_.size(); ++a)
        share = std::max(share, newton_.steepness(a, k));
      const Enclosure& side = x[k];
      const double width = side.width(), middle = side.mid();
      if (share * width > most && side.lo() < middle && middle < side.hi()) most = share * width, along = k;
    }
    return along;
  }

  bool bisect(const Sides& x, bool proven) {
    int along = proven && wide_ >= 0 ? choose(x, proven, wide_) : -1;
    if (along < 0) along = choose(x, proven, -1);
    if (along < 0) return fail(pending_reason_);
    const std::size_t k = along;
    const double middle = x[k].mid();
    for (const auto& half : {Enclosure(x[k].lo(), middle), Enclosure(middle, x[k].hi())}) {
      Sides part = x;
      part[k] = half;
      if (!examine(std::move(part), proven)) return false;
    }
    return true;
  }

  const Problem& problem_;
  const std::vector<Row>& equations_;
  const CoverBox& box_;
  const Box& region_;
  const bool may_be_part_;
  Krawczyk newton_;
  Center point_center_ = Center::middle;  // of a point's box, once its solution has been shown
  std::vector<unsigned char> is_free_;
  std::vector<int> dependent_;
  bool in_part_ = false;
  int parts_ = 0;
  int wide_ = -1;  // the first dependent that was not shown to lie in the box, when they were looked at last; −1: none
  std::string reason_, pending_reason_;
};

}  // namespace

std::string check_sheet(const Problem& problem, const std::vector<Row>& equations, const CoverBox& box, const Box& region) {
  return SheetCheck(problem, equations, box, region, false).run();
}

std::string check_sheet_or_part(const Problem& problem, const CoverBox& box, const Box& region) {
  SheetCheck check(problem, problem.equations(), box, region, true);
  std::string fault = check.run();
  if (!fault.empty() || !check.is_in_part()) return fault;
  CoverBox part = box;
  part.box = region;
  part.verdict = Verdict::boundary;  // of the domain is said above what is said of all the box
  return check_sheet(problem, problem.equations(), part, region);
}

Sides solution_near(const Problem& problem, const std::vector<double>& point, const std::vector<int>& held_variables,
                    std::string& fault, const std::vector<Interval>& over) {
  constexpr int kInflations = 12, kSteps = 3;
  const std::size_t n = problem.system().variables.size();
  const auto no = [&](const char* why) {
    fault = why;
    return Sides();
  };
  if (point.size() != n || !std::ranges::all_of(point, [](double x) { return std::isfinite(x); }))
    return no("its point does not have one number for each variable");
  std::vector<unsigned char> held(n, 0);
  for (const int j : held_variables) {
    if (j < 0 || j >= static_cast<int>(n) || held[j]) return no("it holds a variable that does not exist, or one twice");
    held[j] = 1;
  }
  std::vector<int> dependent;
  Sides x;
  for (std::size_t j = 0; j < n; ++j) {
    const double c = point[j], radius = held[j] ? 0 : 1e-10 * std::max(1.0, std::fabs(c));
    x.emplace_back(c - radius, c + radius);
    if (!held[j]) dependent.push_back(static_cast<int>(j));
  }
  for (std::size_t k = 0; k < over.size(); ++k) x[held_variables[k]] = Enclosure(over[k]);
  Krawczyk newton(problem.equations(), static_cast<int>(n));
  if (dependent.size() != problem.equations().size())
    return no("the number of variables that it holds is not the dimension of the set");
  bool exists = false;
  for (int step = 0; !exists && step < kInflations; ++step) {
    problem.stop().poll();
    if (!newton.set(dependent, x, Krawczyk::Center::polished)) return no("its equations are singular");
    const Sides image = newton.image(x);
    exists = newton.is_inside(image, x);
    for (std::size_t a = 0; a < image.size(); ++a) {
      if (!image[a].is_bounded()) return no("no solution is shown near its point");
      Enclosure& side = x[dependent[a]];
      const double margin = 0.2 * image[a].width() + 1e-15 * image[a].mag() + 1e-300;
      if (!exists) side = Enclosure(image[a].lo() - margin, image[a].hi() + margin);
      if (exists) side = image[a];
    }
  }
  if (!exists) return no("no solution is shown near its point");
  for (int step = 0; step < kSteps; ++step) {
    if (!newton.set(dependent, x, Krawczyk::Center::refined)) break;
    if (!newton.shrink(x, newton.image(x))) return no("no solution is shown near its point");
  }
  return x;
}

}  // namespace corank::check
