#include "corank/symbolic/sets/arm_boundary.h"

#include <algorithm>
#include <functional>
#include <map>

#include "corank/core/rounding.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/velocity/exact_matrix.h"
#include "corank/symbolic/velocity/known_values.h"

namespace corank::symbolic {
namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

bool reaches_inequality(const BoundaryPart& part) {
  return std::ranges::any_of(part.active, [](const auto& active) { return active.inequality.has_value(); });
}

// Of the outputs that are no joints, by joints.
std::vector<Expression> outputs_by_joints(const Mechanism& mechanism, const FreeCoordinates& free) {
  std::map<std::string, Expression> values;
  for (const Relation& r : free.given) values.emplace(r.lhs.name(), r.rhs.substituted(values));
  std::vector<Expression> outputs;
  for (const std::string& u : mechanism.outputs())
    if (const auto value = values.find(u); value != values.end()) outputs.push_back(value->second);
  return outputs;
}

std::vector<std::string> joints_among(const FreeCoordinates& free, const std::vector<std::string>& columns) {
  std::vector<std::string> joints;
  for (const Coordinate& c : free.system.coordinates)
    if (has(columns, c.name)) joints.push_back(c.name);
  return joints;
}

// R J.
ExpressionMatrix first_of(const OutputMotion& motion) {
  const auto columns = static_cast<std::ptrdiff_t>(motion.free);
  ExpressionMatrix m;
  m.columns.assign(motion.entries.columns.begin(), motion.entries.columns.begin() + columns);
  m.roles.assign(motion.free, Role::passive);
  for (const auto& row : motion.entries.rows) m.rows.emplace_back(row.begin(), row.begin() + columns);
  return m;
}

std::string given_name(const Relation& r) { return r.lhs.name(); }

// The outputs by joints; as they are where that becomes too long.
std::vector<Expression> shortened(const Mechanism& mechanism, const Ended& ended) {
  ExpressionMatrix row;
  row.columns = mechanism.outputs();
  row.rows.emplace_back();
  for (const std::string& name : row.columns) row.rows.front().push_back(Expression::symbol(name));
  ExactMatrix exact(mechanism, row, residuals(mechanism), ExactMatrix::Shape::wide);
  exact.put_into_free_coordinates(ended);
  std::vector<Expression> result;
  for (std::size_t j = 0; j < row.columns.size(); ++j) result.push_back(exact.entry(0, j));
  return result;
}

// Into a frame in which the free joints' columns are short.
void turn(const Mechanism& joints, OutputMotion& motion, const Ended& ended) {
  ExpressionMatrix& m = motion.entries;
  std::vector<Expression> no_equations;
  put_in_known_values(joints, m, no_equations);
  ExactMatrix exact(joints, m, {}, ExactMatrix::Shape::wide);
  exact.put_into_free_coordinates(ended, motion.free);
  for (std::size_t i = 0; i < m.rows.size(); ++i)
    for (std::size_t j = 0; j < m.columns.size(); ++j) m.rows[i][j] = exact.entry(i, j);
}

// Shown by a row of zeros, or by the determinant of the columns that are not 0.
bool is_singular_everywhere(const Mechanism& joints, const ExpressionMatrix& m) {
  const auto is_zero = [](const Expression& e) { return same_tree(e, 0); };
  if (std::ranges::any_of(m.rows, [&](const auto& row) { return std::ranges::all_of(row, is_zero); })) return true;
  ExpressionMatrix filled;
  filled.rows.resize(m.rows.size());
  for (std::size_t j = 0; j < m.columns.size(); ++j) {
    if (std::ranges::all_of(m.rows, [&](const auto& row) { return is_zero(row[j]); })) continue;
    filled.columns.push_back(m.columns[j]);
    for (std::size_t i = 0; i < m.rows.size(); ++i) filled.rows[i].push_back(m.rows[i][j]);
  }
  if (filled.columns.size() != m.rows.size()) return filled.columns.size() < m.rows.size();
  const ExactMatrix exact(joints, filled);
  try {
    return exact.modulo_circles(exact.determinant()).is_zero();
  } catch (const DeterminantTooLarge&) {
    return false;
  }
}

std::size_t number_of_pairs(std::size_t n) { return n * (n + 1) / 2; }

// Behind what stands before it: of the pair j ≤ k of n.
std::size_t place_of_pair(std::size_t j, std::size_t k, std::size_t n) { return j * n + j - number_of_pairs(j) + (k - j); }

// The columns of the motion, of which some joints are at their limits.
OutputMotion part_of(const OutputMotion& all, const std::vector<std::size_t>& free, const std::vector<std::size_t>& active) {
  const std::size_t n = all.free, rows = all.entries.rows.size();
  std::vector<std::size_t> columns = free;
  columns.insert(columns.end(), active.begin(), active.end());
  for (std::size_t j = 0; j < free.size(); ++j)
    for (std::size_t k = j; k < free.size(); ++k) columns.push_back(n + place_of_pair(free[j], free[k], n));
  for (std::size_t i = 0; i < rows; ++i) columns.push_back(n + number_of_pairs(n) + i);
  OutputMotion part{{}, free.size(), active.size(), {}};
  for (const std::size_t j : columns) part.entries.columns.push_back(all.entries.columns[j]);
  for (const std::size_t j : columns) part.entries.roles.push_back(all.entries.roles[j]);
  for (const auto& row : all.entries.rows) {
    part.entries.rows.emplace_back();
    for (const std::size_t j : columns) part.entries.rows.back().push_back(row[j]);
  }
  for (const std::size_t j : free) part.sizes.push_back(all.sizes[j]);
  return part;
}

}  // namespace

bool is_large(const FreeCoordinates& joints) {
  constexpr long kLeastFree = 4;
  return std::ranges::count_if(joints.system.coordinates, std::not_fn(is_fixed)) >= kLeastFree;
}

void put_into_joints(const Mechanism& mechanism, const FreeCoordinates& free, KernelQuestion& kernel) {
  ExpressionMatrix matrix;
  matrix.columns = joints_among(free, kernel.matrix.columns);
  for (const std::string& name : matrix.columns) matrix.roles.push_back(role_of(mechanism, name));
  for (Derivatives& d : derivatives(mechanism, matrix.columns, outputs_by_joints(mechanism, free)))
    matrix.rows.push_back(std::move(d.first));
  kernel.matrix = std::move(matrix);
}

std::optional<Component> product_at_limits(const FreeCoordinates& free, const BoundaryPart& part) {
  constexpr std::ptrdiff_t kSurface = 2;
  if (reaches_inequality(part)) return std::nullopt;
  std::vector<Expression> kept;
  std::vector<std::string> others;
  for (const Coordinate& c : free.system.coordinates)
    if (std::ranges::find(part.active, c.name, &BoundaryPart::Active::name) != part.active.end()) {
      kept.push_back(Expression::symbol(c.name));
    } else if (!is_fixed(c)) {
      others.push_back(c.name);
    }
  if (kept.size() < part.active.size() || std::ssize(others) <= kSurface) return std::nullopt;
  kept.push_back(Expression::symbol(others.front()));  // stands in for them
  Component product;
  return put_in_factor(free, std::move(kept), product) ? std::optional(std::move(product)) : std::nullopt;
}

std::optional<ArmBoundary> ArmBoundary::of(const Mechanism& moving, const std::optional<FreeCoordinates>& free,
                                           const Ended& ended) {
  constexpr std::size_t kLeastOutputs = 3;
  if (!free || !is_large(*free)) return std::nullopt;
  const auto is_joint = [&](const std::string& u) {
    return std::ranges::find(free->given, u, given_name) == free->given.end();
  };
  if (moving.outputs().size() < kLeastOutputs || std::ranges::any_of(moving.outputs(), is_joint)) return std::nullopt;
  const std::vector<Expression> outputs = shortened(moving, ended);
  for (const Relation& r : free->given)
    if (std::ranges::any_of(outputs, [&](const Expression& u) { return u.mentions(given_name(r)); })) return std::nullopt;
  KernelQuestion kernel = boundary_kernel(moving, {});
  OutputMotion motion;
  ExpressionMatrix& m = motion.entries;
  m.columns = joints_among(*free, kernel.matrix.columns);
  motion.free = m.columns.size();
  const std::size_t rows = outputs.size();
  if (rows > motion.free) return std::nullopt;
  for (Derivatives& d : derivatives(moving, m.columns, outputs)) {
    m.rows.push_back(std::move(d.first));
    for (auto& row : d.second) m.rows.back().insert(m.rows.back().end(), row.begin(), row.end());
    for (std::size_t i = 0; i < rows; ++i) m.rows.back().emplace_back(i + 1 == m.rows.size() ? 1 : 0);
  }
  const std::vector<std::string> sizes = coordinate_sizes(moving);
  for (const std::string& name : m.columns) motion.sizes.push_back(sizes[moving.find_coordinate(name)]);
  while (m.columns.size() < m.rows.front().size()) m.columns.push_back("d" + std::to_string(m.columns.size()));
  m.roles.assign(m.columns.size(), Role::passive);
  std::vector<std::string> given;  // but the first, which is about joints alone: a mechanism has equations
  for (std::size_t i = 1; i < free->given.size(); ++i) given.push_back(free->given[i].lhs.name());
  Mechanism joints = limits_as_ranges(moving.without(given));
  turn(joints, motion, ended);
  if (is_singular_everywhere(joints, first_of(motion))) return std::nullopt;
  return ArmBoundary(std::move(joints), *free, std::move(kernel), std::move(motion));
}

std::optional<ArmBoundary::Question> ArmBoundary::question(const BoundaryPart& part, const Ended& ended) const {
  if (reaches_inequality(part)) return std::nullopt;
  Question result{joints_, free_, kernel_, false, nullptr};
  std::vector<std::size_t> free, active;
  for (const BoundaryPart::Active& a : part.active) {
    result.joints.set_range(a.name, a.value, a.value);
    hold(result.free.system.coordinates, a.name, a.value);
  }
  for (std::size_t j = 0; j < motion_.free; ++j)
    if (std::ranges::find(part.active, motion_.entries.columns[j], &BoundaryPart::Active::name) == part.active.end())
      free.push_back(j);
  for (const BoundaryPart::Active& a : part.active)
    active.push_back(std::ranges::find(motion_.entries.columns, a.name) - motion_.entries.columns.begin());
  OutputMotion motion = part_of(motion_, free, active);
  turn(result.joints, motion, ended);
  ExpressionMatrix& m = result.kernel.matrix;
  m = first_of(motion);
  result.is_everywhere = is_singular_everywhere(result.joints, m);
  result.kernel.where.assign(m.rows.size(), SourceLocation{joints_.name(), 0, 0});
  result.kernel.dropped.clear();
  result.motion = std::make_shared<const OutputMotion>(std::move(motion));
  return result;
}

bool put_in_factor(const FreeCoordinates& free, std::vector<Expression> functions, Component& part) {
  functions.insert(functions.end(), part.conditions.begin(), part.conditions.end());
  if (part.dependent_angle)
    for (const std::string& name : {part.dependent_angle->angle, part.dependent_angle->other})
      functions.push_back(Expression::symbol(name));
  if (part.block)
    for (const auto& row : part.block->rows) functions.insert(functions.end(), row.begin(), row.end());
  for (const auto& [joint, value] : part.values) functions.push_back(Expression::symbol(joint));
  auto factor = mentioned_coordinates(free, functions);
  if (!factor) return false;
  for (const auto& [joint, value] : part.values) hold(factor->coordinates, joint, value);
  part.factor = std::make_shared<const TrigonometricSystem>(std::move(*factor));
  part.joints = names_of(free.system.coordinates);
  return true;
}

std::vector<Expression> passage_functions(const OutputMotion& motion, const Component& part) {
  std::vector<Expression> functions;
  for (const auto& row : motion.entries.rows)
    for (std::size_t j = 0; j + motion.entries.rows.size() < row.size(); ++j) {
      const bool is_slack = motion.free <= j && j < motion.free + motion.active;
      if (!is_slack || !part.block) functions.push_back(row[j]);
    }
  return functions;
}

std::optional<PassageForm> passage_form_in_joints(const BoundaryPart& part, const TrigonometricSystem& system,
                                                  const System& compiled) {
  const OutputMotion& motion = *part.motion;
  const std::size_t rows = motion.entries.rows.size(), n = motion.free, columns = motion.entries.columns.size();
  std::vector<std::string> unknown;
  for (const std::string& name : part.component->joints)
    if (std::ranges::find(system.coordinates, name, &Coordinate::name) == system.coordinates.end()) unknown.push_back(name);
  std::vector<Expression> all;
  PassageForm form;
  bool has_frame = true;
  for (const auto& row : motion.entries.rows)
    for (std::size_t j = 0; j < columns; ++j) {
      const bool is_known = std::ranges::none_of(unknown, [&](const std::string& name) { return row[j].mentions(name); });
      const bool is_slack = n <= j && j < n + motion.active, is_frame = j + rows >= columns;
      if (!is_known && !is_slack && !is_frame) return std::nullopt;
      form.has_slacks = form.has_slacks && (is_known || !is_slack);
      has_frame = has_frame && (is_known || !is_frame);
      all.push_back(is_known ? row[j] : Expression(0));
    }
  const std::vector<Polynomial> values = polynomials(system, all);
  const UpwardRounding rounding;
  const auto entry = [&](std::size_t i, std::size_t j, const ExactNumber& factor, bool times_lambda) {
    Polynomial f = values[i * columns + j];
    for (Monomial& m : f.monomials) {
      if (times_lambda) m.factors.push_back({compiled.size() + static_cast<int>(i), 1});
      m = Monomial(m.coefficient * factor, std::move(m.factors));
    }
    return f;
  };
  const auto times_lambda = [&](std::size_t j, const ExactNumber& factor) {
    Polynomial sum;
    for (std::size_t i = 0; i < rows; ++i) {
      const Polynomial f = entry(i, j, factor, true);
      sum.monomials.insert(sum.monomials.end(), f.monomials.begin(), f.monomials.end());
    }
    return sum;
  };
  const ExactNumber minus(-1);
  std::vector<ExactNumber> by;
  for (const std::string& size : motion.sizes) by.push_back(ExactNumber::rational(size));
  form.equations = static_cast<int>(rows);
  form.columns = static_cast<int>(n);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < n; ++j) form.jacobian.push_back(entry(i, j, minus * by[j], false));
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = j; k < n; ++k)
      form.hessian.push_back(times_lambda(n + motion.active + place_of_pair(j, k, n), minus * by[j] * by[k]));
  for (std::size_t i = 0; form.has_slacks && i < motion.active; ++i)
    form.slack.push_back(times_lambda(n + i, ExactNumber(part.active[i].upper ? 1 : -1)));
  for (std::size_t u = 0; has_frame && u < rows; ++u)
    form.normal.push_back(times_lambda(columns - rows + u, ExactNumber(1)));
  return form;
}

}  // namespace corank::symbolic
