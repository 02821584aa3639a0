#include "corank/check/passage.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "corank/check/inertia.h"
#include "corank/check/krawczyk.h"
#include "corank/core/box.h"
#include "corank/core/dense.h"

namespace corank::check {
namespace {
constexpr int kMostPassageParts = 500;
constexpr std::size_t kMostRowsTried = 5;
}  // namespace

PassageCheck::PassageCheck(const System& system, const StopFlag& stop)
    : stop_(stop), variables_(system.size()), lengths_(domain_lengths(system)) {
  if (!system.passage || system.coefficient_tolerance > 0) return;
  const PassageForm& form = *system.passage;
  has_form_ = true;
  columns_ = form.columns;
  multipliers_ = form.multipliers;
  for (int i = 0; i < form.further_variables(); ++i) multipliers_.push_back(variables_ + i);
  const int variables = variables_ + form.further_variables();
  jacobian_ = entries_of({form.equations, form.columns, form.jacobian}, variables);
  hessian_ = rows_of(form.hessian, variables);
  slack_ = rows_of(form.slack, variables);
  has_slacks_ = form.has_slacks;
  normal_ = rows_of(form.normal, variables);
  RowMatrix all = jacobian_;
  all.insert(all.end(), {hessian_, slack_, normal_});
  arguments_ = variables_of(all);
  std::erase_if(arguments_, [this](int j) { return j >= variables_; });
  equations_ = rows_of(system.equations, system.size());
  inequalities_ = rows_of(system.inequalities, system.size());
}

std::vector<Sides> PassageCheck::with_multipliers(const Sides& part) const {
  if (multipliers_.empty() || multipliers_.front() < variables_) return {part};
  Sides x = part;
  x.resize(part.size() + multipliers_.size());
  const std::vector<Sides> rows = values(jacobian_, x);
  const std::size_t n = rows.size();
  Eigen::MatrixXd middle(n, columns_);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < columns_; ++j) middle(i, j) = rows[i][j].mid();
    if (const double size = middle.row(i).lpNorm<Eigen::Infinity>(); size > 0) middle.row(i) /= size;  // in any unit
  }
  if (columns_ + 1 < n || !middle.allFinite()) return {};
  std::vector<Eigen::Index> order(n);  // det N is a multiple of the λ of the row that it passes over
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  if (n > 1) {
    const Eigen::VectorXd about = decompose(middle).u.col(static_cast<Eigen::Index>(n) - 1).cwiseAbs();
    std::ranges::sort(order, [&](Eigen::Index i, Eigen::Index j) { return about(i) > about(j); });
  }
  std::vector<Sides> result;
  for (std::size_t attempt = 0; attempt < std::min(n, kMostRowsTried); ++attempt) {
    Eigen::MatrixXd others = middle;
    others.row(order[attempt]).setZero();
    const Pivots chosen = pivots(std::move(others), n - 1);  // N's rows and columns
    if (chosen.rows.size() + 1 < n) continue;
    std::vector<Sides> transposed(n - 1, Sides(n));
    for (std::size_t k = 0; k + 1 < n; ++k)
      for (std::size_t i = 0; i < n; ++i) transposed[k][i] = rows[i][chosen.columns[k]];
    const auto lambda = kernel_basis(transposed, chosen.rows, all_but(chosen.rows, static_cast<int>(n)));
    if (!lambda) continue;
    for (std::size_t i = 0; i < n; ++i) x[multipliers_[i]] = (*lambda)[i][0];
    result.push_back(x);
  }
  return result;
}

std::optional<std::vector<Sides>> PassageCheck::form(const Sides& x) const {
  std::vector<Sides> rows = values(jacobian_, x), h(columns_, Sides(columns_));
  if (!rows.empty()) {  // N is without the row of the multiplier that is farthest from 0
    const auto passed = std::ranges::max_element(multipliers_, {}, [&](int j) { return x[j].mig(); });
    if (x[*passed].has_zero()) return std::nullopt;
    rows.erase(rows.begin() + (passed - multipliers_.begin()));
  }
  for (std::size_t i = 0, next = 0; i < columns_; ++i)
    for (std::size_t j = i; j < columns_; ++j, ++next) h[i][j] = h[j][i] = hessian_[next].value(x);
  return form_on_kernel(h, rows);
}

bool PassageCheck::holds_with_multipliers(const CoverBox& box, const Sides& x) const {
  Enclosure along;  // n·side
  for (std::size_t i = 0; i < normal_.size(); ++i) along.add_product(box.side[i], normal_[i].value(x));
  if (along.has_zero() && !normal_.empty()) return false;
  const auto s = form(x);
  if (!s) return false;
  Sides slack;
  for (const Row& f : slack_) slack.push_back(f.value(x));
  if (box.passage == Passage::traversable) {
    const auto turned = nearly_diagonal(*s);
    if (!turned) return false;
    for (std::size_t k = 0; k < s->size(); ++k) slack.insert(slack.end(), {(*s)[k][k], (*turned)[k][k]});
    const bool plus = std::ranges::any_of(slack, &Enclosure::is_positive);
    const bool minus = std::ranges::any_of(slack, &Enclosure::is_negative);
    return plus && minus;
  }
  if (!has_slacks_) return false;
  const std::optional<Inertia> signs = inertia(*s);
  const auto is_definite = [&](int sign) {
    const auto has_sign = [sign](const Enclosure& mu) { return sign > 0 ? mu.is_positive() : mu.is_negative(); };
    return signs && (sign > 0 ? signs->negative : signs->positive) == 0 && std::ranges::all_of(slack, has_sign);
  };
  if (normal_.empty()) return is_definite(1) || is_definite(-1);
  return is_definite(along.is_negative() ? 1 : -1);  // the outputs are at −n where the form is positive
}

bool PassageCheck::holds(const CoverBox& box, const Sides& part) const {
  return std::ranges::any_of(with_multipliers(part), [&](const Sides& x) { return holds_with_multipliers(box, x); });
}

bool PassageCheck::contract(Sides& x) const {
  for (int sweep = 0; sweep < 2; ++sweep) {
    if (!std::ranges::all_of(equations_, [&](const Row& f) { return f.project(x, true); })) return false;
    if (!std::ranges::all_of(inequalities_, [&](const Row& g) { return g.project(x, false); })) return false;
  }
  return true;
}

std::string PassageCheck::fault(const CoverBox& box) const {
  if (box.passage == Passage::unproven) return box.side.empty() ? "" : "it names a side, but no passage";
  if (!has_form_) return "it says whether the output can pass, but nothing decides that here";
  double length = 0;
  for (const double d : box.side) length = std::hypot(length, d);
  if (box.side.size() != normal_.size() || (!normal_.empty() && !(std::fabs(length - 1) < 1e-9)))
    return "its side is not a unit vector";
  const bool shown = shown_in_parts(Sides(box.box.begin(), box.box.end()), arguments_, lengths_, kMostPassageParts, stop_,
                                    [&](Sides& x) { return holds(box, x) || !contract(x) || holds(box, x); });
  if (shown) return "";
  return std::string("it is not shown that the output finds a ") +
         (box.passage == Passage::barrier ? "barrier there, on that side" : "way through there");
}

}  // namespace corank::check
