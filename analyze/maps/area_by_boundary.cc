#include "corank/analyze/maps/area_by_boundary.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <set>
#include <string>

#include "corank/certify/implied.h"
#include "corank/core/rounding.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/limits.h"

namespace corank::analyze {
namespace {

// Squares of side h at its multiples. h has five binary digits, so that every corner is a double and the number of squares
// is nearly the same in every unit of length.
class Grid {
 public:
  Grid(const Interval& x, const Interval& y, double fineness) {
    constexpr double kMostSquares = 2.5e7;
    const double side = std::max(x.width(), y.width());
    int exponent = 0;
    const double digits = std::floor(32 * std::frexp(std::max(side * fineness, 1e-300), &exponent));
    h_ = std::ldexp(digits, exponent - 5);
    while ((x.width() / h_ + 4) * (y.width() / h_ + 4) > kMostSquares) h_ *= 2;
    x0_ = static_cast<std::int64_t>(std::floor(x.lo() / h_)) - 2;
    y0_ = static_cast<std::int64_t>(std::floor(y.lo() / h_)) - 2;
    nx_ = static_cast<std::int64_t>(std::ceil(x.hi() / h_)) + 2 - x0_;
    ny_ = static_cast<std::int64_t>(std::ceil(y.hi() / h_)) + 2 - y0_;
    from_boundary_.assign(nx_ * ny_, kFar);
  }

  /// All closed squares that meet the closed rectangle. A quotient by h is rounded, a corner is not.
  void mark(const Interval& x, const Interval& y) {
    const auto first = [&](double lo, std::int64_t origin) {
      auto i = static_cast<std::int64_t>(std::floor(lo / h_)) - 2;
      while (static_cast<double>(i + 1) * h_ < lo) ++i;
      return std::max<std::int64_t>(0, i - origin);
    };
    const auto last = [&](double hi, std::int64_t origin, std::int64_t n) {
      auto i = static_cast<std::int64_t>(std::ceil(hi / h_)) + 1;
      while (static_cast<double>(i) * h_ > hi) --i;
      return std::min(n - 1, i - origin);
    };
    for (std::int64_t i = first(x.lo(), x0_); i <= last(x.hi(), x0_, nx_); ++i)
      for (std::int64_t j = first(y.lo(), y0_); j <= last(y.hi(), y0_, ny_); ++j) at(from_boundary_, i, j) = 0;
  }

  struct Component {
    std::uint64_t squares = 0;
    std::int64_t deepest = 0;  ///< the square furthest from the marked ones
    bool outer = false;        ///< it meets the border of the grid
  };

  /// Connected sets of squares that are not marked.
  std::vector<Component> components() {
    measure_depth();
    std::vector<bool> seen(from_boundary_.size());
    std::vector<Component> result;
    for (std::int64_t start = 0; start < nx_ * ny_; ++start) {
      if (seen[start] || depth(start) == 0) continue;
      Component c;
      c.deepest = start;
      std::deque<std::int64_t> open{start};
      seen[start] = true;
      while (!open.empty()) {
        const std::int64_t k = open.front();
        open.pop_front();
        ++c.squares;
        if (depth(k) > depth(c.deepest)) c.deepest = k;
        if (!for_each_neighbour(k, [&](std::int64_t n) {
              if (seen[n] || depth(n) == 0) return;
              seen[n] = true;
              open.push_back(n);
            }))
          c.outer = true;
      }
      result.push_back(c);
    }
    return result;
  }

  std::uint64_t marked() const { return static_cast<std::uint64_t>(std::ranges::count(from_boundary_, std::uint16_t{0})); }
  double square() const { return h_ * h_; }
  /// A part of the square's middle.
  Interval x_of(std::int64_t k) const { return middle(x0_ + k % nx_); }
  Interval y_of(std::int64_t k) const { return middle(y0_ + k / nx_); }

 private:
  static constexpr std::uint16_t kFar = 0xffff;

  Interval middle(std::int64_t i) const {
    return {(static_cast<double>(i) + 0.375) * h_, (static_cast<double>(i) + 0.625) * h_};
  }
  std::uint16_t& at(std::vector<std::uint16_t>& list, std::int64_t i, std::int64_t j) const { return list[j * nx_ + i]; }
  std::uint16_t depth(std::int64_t k) const { return from_boundary_[k]; }

  // False: the square is on the border of the grid.
  template <class Visit>
  bool for_each_neighbour(std::int64_t k, const Visit& visit) const {
    const std::int64_t i = k % nx_, j = k / nx_;
    if (i > 0) visit(k - 1);
    if (i + 1 < nx_) visit(k + 1);
    if (j > 0) visit(k - nx_);
    if (j + 1 < ny_) visit(k + nx_);
    return i > 0 && i + 1 < nx_ && j > 0 && j + 1 < ny_;
  }

  void measure_depth() {
    std::deque<std::int64_t> open;
    for (std::int64_t k = 0; k < nx_ * ny_; ++k)
      if (depth(k) == 0) open.push_back(k);
    while (!open.empty()) {
      const std::int64_t k = open.front();
      open.pop_front();
      for_each_neighbour(k, [&](std::int64_t n) {
        if (depth(n) != kFar) return;
        from_boundary_[n] = static_cast<std::uint16_t>(std::min(depth(k) + 1, kFar - 1));
        open.push_back(n);
      });
    }
  }

  double h_ = 1;
  std::int64_t x0_ = 0, y0_ = 0, nx_ = 0, ny_ = 0;
  std::vector<std::uint16_t> from_boundary_;  // 0: marked
};

// No configuration at an end of a range that is no limit, and no inequality of which only the model says that it ends
// nothing. Of an output the lines at such ends are edges instead: they may bound the workspace, too.
bool has_no_other_ends(const symbolic::Mechanism& model, const System& system, int x, int y, std::vector<Box>& edges,
                       solve::Control& control) {
  constexpr std::uint64_t kMost = 2000;  // boxes of a search: what takes more is not known
  std::set<std::string> limited;
  for (const symbolic::Limit& limit : symbolic::effective_limits(model)) limited.insert(limit.coordinate);
  for (const symbolic::Constraint& c : model.constraints())
    if (c.relation.kind != symbolic::Relation::Kind::equal && symbolic::is_no_end(c)) return false;
  for (const Angle& angle : system.angles)
    if (!limited.contains(angle.name) && !(angle.range.width() > 6.283185)) return false;
  const std::vector<certify::ImpliedSides> implied = certify::implied_domains(system);
  for (std::size_t j = 0; j < system.variables.size(); ++j) {
    const Variable& v = system.variables[j];
    if (v.kind != VariableKind::length || limited.contains(v.name)) continue;
    for (const bool upper : {false, true}) {
      if (upper ? implied[j].upper || v.upper_implied : implied[j].lower || v.lower_implied) continue;
      System at_end = system;
      const ExactNumber& end = upper ? v.upper : v.lower;
      at_end.variables[j] = Variable(v.name, v.kind, end, end);
      const Cover cover = solve::solve(solve::prepare(at_end, {}, control), control, kMost);
      if (cover.boxes.empty() && cover.complete()) continue;
      if (static_cast<int>(j) != x && static_cast<int>(j) != y) return false;
      const Box line = at_end.domain();
      edges.push_back({line[x], line[y]});
    }
  }
  return true;
}

}  // namespace

std::optional<AreaBounds> area_by_boundary(const study::Question& question, const BoundaryAreaOptions& options,
                                           solve::Control& control) {
  study::require_exact_constants(question.model, "the area of a workspace");
  const std::vector<std::string>& outputs = question.model.outputs();
  const System system = symbolic::configurations(question.model);
  if (outputs.size() != 2 || symbolic::algebrize(symbolic::plain_system(question.model)).size() != system.size())
    return std::nullopt;
  const int x = system.find(outputs[0]), y = system.find(outputs[1]);
  constexpr double kWholeCircle = 2;  // of sines and cosines
  std::vector<Box> edges;
  if (x < 0 || y < 0 || !has_no_other_ends(question.model, system, x, y, edges, control)) return std::nullopt;

  std::vector<Box> boundary;
  std::optional<double> sigma;             // of lengths; what angles are in a box has no effect
  for (const bool fine : {false, true}) {  // first of any size, to know how large the workspace is
    boundary = edges;
    for (const study::Question& part : study::parts_of(question)) {
      const System of_part = study::system(part);  // may be without idle coordinates
      const int part_x = of_part.find(outputs[0]), part_y = of_part.find(outputs[1]);
      if (part_x < 0 || part_y < 0) return std::nullopt;
      const solve::Options search{.sigma_length = sigma, .sigma_angle = kWholeCircle, .threads = options.threads};
      const Cover cover = solve::solve(solve::prepare(of_part, search, control), control);
      if (!cover.complete()) return std::nullopt;
      for (const CoverBox& box : cover.boxes) boundary.push_back({box.box[part_x], box.box[part_y]});
    }
    if (boundary.empty()) return AreaBounds{};
    Box hull = boundary.front();
    for (const Box& b : boundary)
      for (std::size_t k = 0; k < 2; ++k) hull[k] = Interval::hull(hull[k], b[k]);
    sigma = std::max(hull[0].width(), hull[1].width()) * options.fineness;
    if (!fine) continue;
    Grid grid(hull[0], hull[1], options.fineness / 2.5);
    for (const Box& b : boundary) grid.mark(b[0], b[1]);
    std::vector<Grid::Component> components = grid.components();
    std::erase_if(components, [](const Grid::Component& c) { return c.outer; });
    std::ranges::sort(components, [](const auto& a, const auto& b) { return a.squares > b.squares; });
    AreaBounds bounds;
    std::uint64_t in = 0, open = grid.marked();
    for (std::size_t k = 0; k < components.size(); ++k) {
      constexpr int kTries = 60;
      const Grid::Component& c = components[k];
      const bool tested = static_cast<int>(k) < options.most_components && !control.ended();
      const int found = tested ? membership(system, x, y, grid.x_of(c.deepest), grid.y_of(c.deepest), kTries) : 0;
      bounds.cells += tested;
      (found > 0 ? in : open) += found < 0 ? 0 : c.squares;
    }
    bounds.lo = static_cast<double>(in) * grid.square();  // exact: h² has ten binary digits
    bounds.hi = static_cast<double>(in + open) * grid.square();
    return bounds;
  }
  return std::nullopt;
}

bool is_plane_of_lengths(const symbolic::Mechanism& model, const std::vector<std::string>& names) {
  return names.size() == 2 && std::ranges::all_of(names, [&](const std::string& name) {
           const int k = model.find_coordinate(name);
           return k >= 0 && model.coordinates()[k].kind == symbolic::CoordinateKind::length;
         });
}

std::optional<Interval> area(const study::Question& question, int threads, bool anyway, solve::Control& control) {
  std::optional<AreaBounds> bounds = area_by_boundary(question, {.threads = threads}, control);
  if (!bounds && anyway && question.model.outputs().size() == 2) {
    const System system = symbolic::configurations(question.model);
    const int x = system.find(question.model.outputs()[0]), y = system.find(question.model.outputs()[1]);
    if (x >= 0 && y >= 0)  // else one is an angle
      bounds = workspace_area(system, x, y, {.stop = [&control] { return control.ended(); }});
  }
  return bounds ? std::optional(Interval(bounds->lo, bounds->hi)) : std::nullopt;
}

}  // namespace corank::analyze
