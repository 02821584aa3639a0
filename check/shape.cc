#include "corank/check/shape.h"

#include <algorithm>
#include <map>
#include <set>

#include "corank/check/classes.h"
#include "corank/check/distinct.h"
#include "corank/check/inertia.h"
#include "corank/check/linking.h"
#include "corank/check/search.h"
#include "corank/core/box.h"

namespace corank::check {
namespace {

class ShapeCheck {
 public:
  ShapeCheck(const System& system, const Shape& shape, const std::vector<CriticalSystem>& heights, const Options& options)
      : system_(system), shape_(shape), heights_(heights), options_(options), stop_(options.ended) {}

  ShapeReport run() {
    report_.interrupted = !finishes([&] { check_all(); });
    if (report_.interrupted) report_.stage = stage_;
    return std::move(report_);
  }

 private:
  void fail(std::string what) { report_.failures.push_back(std::move(what)); }
  void enter(const char* stage) {
    stage_ = stage;
    stop_.poll();
  }

  void check_all() {
    enter("the cover");
    const Cover& cover = shape_.space;
    report_.space = check(system_, cover, options_);
    if (!settled(report_.space, "the cover")) return;
    if (heights_.size() != shape_.heights.size()) return fail("its heights are not those of the model");
    if (cover.dimension < 1 || static_cast<int>(system_.equations.size()) + cover.dimension != system_.size())
      return fail("the set does not have the dimension that its equations leave");
    for (const CoverBox& box : cover.boxes)
      if (box.verdict != Verdict::regular || box.region < 0 || box.motion >= 0)
        return fail("a box is not regular: the set is not shown to be smooth");
    if (!std::ranges::all_of(cover.boxes, [&](const CoverBox& b) { return spans(cover, b); }))
      return fail("a box has no solution for every value of its free variables");
    const std::size_t n = system_.variables.size();
    for (const SheetBridge& b : shape_.bridges)
      if (!is_box(b.region, n)) return fail("a bridge does not have one bounded side for each variable");
    const Problem problem(system_, cover.reduction, stop_);
    enter("the components");
    const Linking linking(system_, problem, cover, shape_.bridges);
    Classes classes(linking.sheets());
    if (!link(linking, classes)) return;
    count_groups(linking, classes, problem);
    enter("the ends");
    if (shape_.euler_characteristic || !shape_.heights.empty() || !shape_.genus.empty()) check_closed(problem);
    enter("the critical points");
    std::vector<int> characteristics;
    std::vector<std::vector<int>> of_pieces;  // of each height by class
    for (std::size_t k = 0; k < heights_.size(); ++k)
      if (!check_height(k, linking, classes, characteristics, of_pieces)) return;
    compare_counts();
    compare_shape(characteristics, of_pieces);
  }

  // Can what follows rest on these boxes?
  bool settled(const Report& report, const std::string& what) {
    if (report.interrupted) throw Stopped{};
    for (const Failure& f : report.failures)
      fail(what + ", " +
           (f.place == Failure::Place::box || f.place == Failure::Place::point ? "box " + std::to_string(f.index + 1)
                                                                               : std::string("as a whole")) +
           ": " + f.reason);
    if (report.failures.empty() && !report.verified()) fail(what + ": something in it cannot be checked");
    return report_.failures.empty();
  }

  bool link(const Linking& linking, Classes& classes) {
    for (std::size_t k = 0; k < linking.sheets(); ++k) {
      stop_.poll();
      if (std::string fault = linking.sheet_fault(k); !fault.empty()) {
        fail("sheet " + std::to_string(k + 1) + ": " + fault);
      } else {
        ++report_.sheets;
      }
    }
    for (std::size_t k = 0; k < shape_.links.size(); ++k) {
      stop_.poll();
      if (std::string fault = linking.link_fault(shape_.links[k]); !fault.empty()) {
        fail("link " + std::to_string(k + 1) + ": " + fault);
        continue;
      }
      ++report_.links;
      classes.unite(shape_.links[k].first, shape_.links[k].second);
    }
    return report_.failures.empty();
  }

  std::size_t class_of_box(const Linking& linking, Classes& classes, std::size_t box) {
    return classes.of(linking.sheet_of_box(box));
  }

  void count_groups(const Linking& linking, Classes& classes, const Problem& problem) {
    const std::vector<CoverBox>& boxes = shape_.space.boxes;
    std::set<std::size_t> pieces;
    for (std::size_t i = 0; i < boxes.size(); ++i) pieces.insert(class_of_box(linking, classes, i));
    report_.at_most = static_cast<int>(pieces.size());
    Classes groups(linking.sheets());
    for (std::size_t k = 0; k < linking.sheets(); ++k) groups.unite(k, classes.of(k));
    std::vector<const Box*> sides;
    for (const CoverBox& box : boxes) sides.push_back(&box.box);
    Search search(problem);
    const auto apart = [&](std::size_t a, std::size_t b) {
      stop_.poll();
      const std::size_t first = linking.sheet_of_box(a), second = linking.sheet_of_box(b);
      if (groups.of(first) == groups.of(second)) return true;
      Sides common = problem.kept(boxes[a].box);
      const Sides other = problem.kept(boxes[b].box);
      for (std::size_t k = 0; k < common.size(); ++k)
        if (!common[k].intersect(other[k])) return true;
      if (search.is_empty(std::move(common))) {
        ++report_.apart;
      } else {
        groups.unite(first, second);
      }
      return true;
    };
    meeting_pairs(sides, apart, 1);
    std::set<std::size_t> distinct;
    for (std::size_t i = 0; i < boxes.size(); ++i) distinct.insert(class_of_box(linking, groups, i));
    report_.at_least = static_cast<int>(distinct.size());
  }

  // Of every box: each end of the domain, and each inequality, that the equations do not imply holds strictly at its
  // solutions.
  void check_closed(const Problem& problem) {
    for (std::size_t i = 0; i < shape_.space.boxes.size(); ++i)
      for (const Condition& c : problem.conditions()) {
        if (c.implied || holds_strictly(problem, c, shape_.space.boxes[i].box)) continue;
        return fail("it is not shown that the set is closed: box " + std::to_string(i + 1) + " may come to " +
                    (c.variable < 0 ? std::string("an inequality") : "an end of " + system_.variables[c.variable].name));
      }
    report_.closed = true;
  }

  bool holds_strictly(const Problem& problem, const Condition& condition, const Box& box) const {
    constexpr int kMostPartsOfRange = 2000;
    Search search(problem);
    const Row& row = condition.row;
    return shown_in_parts(
        problem.kept(box), all_but({}, problem.size()), problem.lengths(), kMostPartsOfRange, stop_,
        [&](Sides& x) { return row.value(x).is_positive() || !search.contract(x) || row.value(x).is_positive(); });
  }

  bool check_height(std::size_t k, const Linking& linking, Classes& classes, std::vector<int>& characteristics,
                    std::vector<std::vector<int>>& of_pieces) {
    const std::string name = "height " + std::to_string(k + 1);
    const Cover& cover = shape_.heights[k].cover;
    const CriticalSystem& critical = heights_[k];
    report_.heights.push_back(check(critical.system, cover, options_));
    if (!settled(report_.heights.back(), name)) return false;
    if (cover.dimension != 0) return fail(name + ": its critical points are not isolated"), false;
    // What is counted are points: a box that none of them stands for may hold any number of critical points, or a curve.
    for (std::size_t b = 0; b < cover.boxes.size(); ++b)
      if (!stands_for_a_point(cover.boxes[b]))
        return fail(name + ", box " + std::to_string(b + 1) + ": critical points along a set may lie in it"), false;
    const std::vector<Row> inside = rows_of(critical.system.inequalities, critical.system.size());
    std::vector<int> by_index(shape_.space.dimension + 1, 0);
    std::map<std::size_t, int> euler;
    bool placed = true;
    for (std::size_t p = 0; p < cover.points.size(); ++p) {
      const CoverBox& point = cover.points[p];
      const std::string which = name + ", critical point " + std::to_string(p + 1) + ": ";
      if (point.verdict != Verdict::isolated && point.verdict != Verdict::exact)
        return fail(which + "it is not shown to be one solution"), false;
      const Sides x(point.box.begin(), point.box.end());
      for (const Row& g : inside)
        if (!g.value(x).is_positive()) return fail(which + "it may be counted twice"), false;
      const std::optional<int> index = index_at(critical, x);
      if (!index || *index >= static_cast<int>(by_index.size()))
        return fail(which + "it is not shown to be nondegenerate"), false;
      ++by_index[*index];
      const std::optional<std::size_t> piece = class_at(linking, classes, critical.system, point.box);
      placed = placed && piece;
      if (piece) euler[*piece] += *index % 2 == 0 ? 1 : -1;
    }
    report_.by_index.push_back(by_index);
    if (by_index != shape_.heights[k].by_index)
      return fail(name + ": the numbers by index are not those of its points"), false;
    if (report_.closed) report_.at_most = std::min(report_.at_most, by_index.front());
    int sum = 0;
    for (std::size_t i = 0; i < by_index.size(); ++i) sum += i % 2 == 0 ? by_index[i] : -by_index[i];
    characteristics.push_back(sum);
    of_pieces.emplace_back();
    for (std::size_t i = 0; placed && i < shape_.space.boxes.size(); ++i)
      euler.try_emplace(class_of_box(linking, classes, i), 0);
    if (placed)
      for (const auto& [piece, chi] : euler) of_pieces.back().push_back(chi);
    return true;
  }

  // What the checker of covers does not ask of these: to be, or to lie in, one of the points.
  static bool stands_for_a_point(const CoverBox& box) {
    return box.motion < 0 && !(box.verdict == Verdict::undecided && box.reason == Reason::degenerate_set);
  }

  static std::optional<int> index_at(const CriticalSystem& critical, const Sides& x) {
    const auto at = [&](const PolynomialMatrix& m) { return values(entries_of(m, critical.system.size()), x); };
    const Enclosure mu = Row(critical.multiplier, critical.system.size()).value(x);
    if (mu.has_zero()) return std::nullopt;
    const std::optional<Inertia> inertia = inertia_on_kernel(at(critical.hessian), at(critical.jacobian));
    if (!inertia) return std::nullopt;
    return mu.is_positive() ? inertia->negative : inertia->positive;
  }

  // The class of a sheet that holds the configuration.
  std::optional<std::size_t> class_at(const Linking& linking, Classes& classes, const System& critical,
                                      const Box& point) const {
    Box configuration;
    for (const Variable& v : system_.variables) {
      const int j = critical.find(v.name);
      if (j < 0) return std::nullopt;
      configuration.push_back(point[j]);
    }
    for (std::size_t i = 0; i < shape_.space.boxes.size(); ++i) {
      const std::size_t sheet = linking.sheet_of_box(i);
      if (linking.holds(sheet, configuration)) return classes.of(sheet);
    }
    return std::nullopt;
  }

  void compare_counts() {
    if (shape_.at_least > report_.at_least)
      fail("at least " + std::to_string(shape_.at_least) + " components are claimed, " + std::to_string(report_.at_least) +
           " shown");
    if (shape_.at_most && *shape_.at_most < report_.at_most)
      fail("at most " + std::to_string(*shape_.at_most) + " components are claimed, at most " +
           std::to_string(report_.at_most) + " shown");
    if (report_.at_least > report_.at_most)
      fail("its boxes show at least " + std::to_string(report_.at_least) + " components, its critical points at most " +
           std::to_string(report_.at_most) + ": they contradict each other, so some of them are missing");
  }

  void compare_shape(const std::vector<int>& characteristics, const std::vector<std::vector<int>>& of_pieces) {
    const int dimension = shape_.space.dimension;
    const bool odd = dimension % 2 != 0;
    // Of a closed set each height gives the same, 0 where its dimension is odd, whether or not it is claimed.
    for (const int chi : characteristics)
      if (report_.closed && (chi != characteristics.front() || (odd && chi != 0)))
        fail("the critical points contradict each other, as some are missing: a height gives the Euler characteristic " +
             std::to_string(chi));
    if (shape_.euler_characteristic) {
      if (!odd && characteristics.empty()) fail("no height shows the Euler characteristic");
      if (odd && *shape_.euler_characteristic != 0) fail("a closed set of odd dimension has the Euler characteristic 0");
      for (const int chi : characteristics)
        if (chi != *shape_.euler_characteristic)
          fail("the critical points give the Euler characteristic " + std::to_string(chi));
    }
    if (shape_.genus.empty()) return;
    if (dimension != 2 || characteristics.empty() || report_.at_least != report_.at_most)
      return fail("it is not shown that its components are closed surfaces, one for each genus");
    std::vector<int> genus;
    if (report_.at_least == 1) {
      genus = {1 - characteristics.front() / 2};
    } else {
      for (const int chi : of_pieces.front()) genus.push_back(1 - chi / 2);
    }
    std::ranges::sort(genus);
    if (genus != shape_.genus) fail("the genus of its components is not what the critical points give");
  }

  const System& system_;
  const Shape& shape_;
  const std::vector<CriticalSystem>& heights_;
  const Options& options_;
  StopFlag stop_;
  const char* stage_ = "the cover";
  ShapeReport report_;
};

}  // namespace

bool ShapeReport::verified() const {
  return failures.empty() && !interrupted && space.verified() &&
         std::ranges::all_of(heights, [](const Report& r) { return r.verified(); });
}

bool ShapeReport::complete() const {
  return verified() && space.complete() && std::ranges::all_of(heights, [](const Report& r) { return r.complete(); });
}

ShapeReport check_shape(const System& system, const Shape& shape, const std::vector<CriticalSystem>& heights,
                        const Options& options) {
  return ShapeCheck(system, shape, heights, options).run();
}

}  // namespace corank::check
