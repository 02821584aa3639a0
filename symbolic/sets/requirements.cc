#include "corank/symbolic/sets/requirements.h"

#include <algorithm>
#include <iterator>
#include <variant>

#include "corank/core/check.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/requirement_text.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/requirement_conditions.h"
#include "corank/symbolic/velocity/kernel_vector.h"

namespace corank::symbolic {
namespace {

bool is_of_distance(const RequirementLine& line) {
  return std::holds_alternative<DistanceLimit>(parse_requirement(line.text, line.where).limit);
}

// A mechanism with the same configurations and other rates, to which velocity equations are added.
class Companion {
 public:
  explicit Companion(const Mechanism& mechanism) : mechanism_(mechanism), out_(mechanism.without_rates()) {}

  Expression rate(CoordinateKind kind, Role role = Role::passive) {
    std::string name = "r" + std::to_string(out_.rates().size() + 1);
    while (mechanism_.has(name)) name += "_";
    return out_.rate(name, kind, role);
  }
  std::vector<Expression> rates(const std::vector<CoordinateKind>& kinds) {
    std::vector<Expression> result;
    for (const CoordinateKind kind : kinds) result.push_back(rate(kind));
    return result;
  }
  void add_row(const RequirementLine& line, const std::vector<Expression>& entries, const std::vector<Expression>& rates) {
    const auto row = kernel_row(entries, rates);
    if (!row)
      throw ModelError(line.where, "the requirement " + in_quotes(line.text) + " says nothing of a rate that nothing ties",
                       "a mechanism whose rates its equations tie");
    add_equation(line, *row);
  }
  void add_equation(const RequirementLine& line, const Expression& lhs) { out_.velocity(lhs == Expression(0), line.where); }
  // Which do nothing: as many as the mechanism has freedom beyond that of the others.
  void add_locked_rates(std::size_t freedom) {
    const std::size_t coordinates = mechanism_.coordinates().size(), equations = mechanism_.equations().size();
    if (coordinates <= equations)
      throw ModelError(model_place(mechanism_),
                       "the model has " + counted(coordinates, "coordinate") + " and " + counted(equations, "equation") +
                           ", so nothing moves",
                       "fewer equations than coordinates");
    for (std::size_t k = equations + freedom; k < coordinates; ++k) rate(CoordinateKind::length, Role::input);
  }
  Mechanism take() { return std::move(out_); }

 private:
  const Mechanism& mechanism_;
  Mechanism out_;
};

// [diag(form), Aᵀ; A, 0] (m, λ) = 0.
void add_block(const RequirementLine& line, const VelocityCondition& c, Companion& to) {
  const std::vector<Expression> m = to.rates(c.kinds), lambda = to.rates(std::vector(c.rows.size(), CoordinateKind::length));
  for (std::size_t j = 0; j < m.size(); ++j) {
    std::vector<Expression> entries{c.form[j]}, rates{m[j]};
    for (std::size_t i = 0; i < lambda.size(); ++i) {
      entries.push_back(c.rows[i][j]);
      rates.push_back(lambda[i]);
    }
    to.add_row(line, entries, rates);
  }
  for (const std::vector<Expression>& row : c.rows) to.add_row(line, row, m);
}

}  // namespace

MatrixEntry Requirements::entry(const Mechanism& mechanism, const Expression& e, const std::string& source) {
  const bool negated = e.kind() == Expression::Kind::negation;
  if ((negated ? e.operands()[0] : e).kind() == Expression::Kind::number) return {-1, exact_value(mechanism, e, e.text())};
  return {function(mechanism, e, source), {}};
}

int Requirements::function(const Mechanism& mechanism, const Expression& value, const std::string& source) {
  for (std::size_t k = 0; k < functions_.size(); ++k)
    if (same_tree(functions_[k].value, value)) return static_cast<int>(k);
  std::string name = "req" + std::to_string(functions_.size() + 1);
  while (mechanism.has(name)) name += "_";
  functions_.push_back({name, value, source});
  return static_cast<int>(functions_.size()) - 1;
}

Requirements::Requirements(const Mechanism& mechanism, const std::vector<std::string>& parameters) {
  const auto exact = [&](const Expression& e) { return exact_value(mechanism, e, e.text()); };
  RequirementTranslator translator(mechanism, parameters);
  for (const RequirementLine& line : mechanism.requirements()) {
    const Conditions conditions = translator.run(line);
    Requirement& r = requirements_.emplace_back(Requirement{line.text, {}, {}});
    if (conditions.excess) r.excess = function(mechanism, *conditions.excess, in_quotes(line.text));
    for (const VelocityCondition& c : conditions.of_velocities) {
      VelocityTest& test = r.tests.emplace_back();
      test.columns = static_cast<int>(c.kinds.size());
      for (const std::vector<Expression>& row : c.rows)
        for (const Expression& e : row) test.matrix.push_back(entry(mechanism, e, "velocity equation"));
      for (const Expression& e : c.form) test.form.push_back(exact(e));
      for (const VelocityCondition::Group& g : c.groups) test.groups.push_back({g.columns, exact(g.weight)});
      if (c.form.empty()) test.bound = exact(c.bound);
      test.ends = c.ends;
    }
    for (const DistanceCondition& c : conditions.of_distances) {
      DistanceTest& test = r.distances.emplace_back();
      for (std::size_t b = 0; b < 2; ++b)
        for (const std::array<Expression, 3>& p : c.hulls[b]) {
          std::array<MatrixEntry, 3>& entries = test.hulls[b].emplace_back();
          for (std::size_t i = 0; i < 3; ++i) entries[i] = entry(mechanism, p[i], "point");
        }
      test.least = exact(c.least);
    }
  }
}

std::vector<Expression> Requirements::functions() const {
  std::vector<Expression> result;
  for (const Function& f : functions_) result.push_back(f.value);
  return result;
}

void Requirements::add_to(TrigonometricSystem& system) const {
  for (const Function& f : functions_) {
    Coordinate c{f.name, CoordinateKind::length, 0, 0, {system.name, 0, 0}};
    c.auxiliary = true;
    c.has_range = false;
    system.coordinates.push_back(c);
    system.equations.push_back({Expression::symbol(f.name) == f.value, "requirement: " + f.source, c.where});
  }
}

std::vector<Requirement> Requirements::in(const System& system) const {
  std::vector<Requirement> result = requirements_;
  const auto variable = [&](int function) {
    const int found = system.find(functions_[function].name);
    CORANK_CHECK(found >= 0);
    return found;
  };
  const auto replace = [&](MatrixEntry& e) {
    if (e.variable >= 0) e.variable = variable(e.variable);
  };
  for (Requirement& r : result) {
    if (r.excess) r.excess = variable(*r.excess);
    for (VelocityTest& test : r.tests)
      for (MatrixEntry& e : test.matrix) replace(e);
    for (DistanceTest& test : r.distances)
      for (auto& hull : test.hulls)
        for (auto& p : hull)
          for (MatrixEntry& e : p) replace(e);
  }
  return result;
}

Mechanism with_distances_alone(Mechanism mechanism) {
  std::vector<RequirementLine> lines;
  std::ranges::copy_if(mechanism.requirements(), std::back_inserter(lines), is_of_distance);
  mechanism.keep_requirements(std::move(lines));
  return mechanism;
}

Mechanism without_distances(Mechanism mechanism) {
  std::vector<RequirementLine> lines;
  std::ranges::remove_copy_if(mechanism.requirements(), std::back_inserter(lines), is_of_distance);
  mechanism.keep_requirements(std::move(lines));
  return mechanism;
}

KeptDistances kept_distances(const Mechanism& mechanism, const TrigonometricSystem& space) {
  const Requirements requirements(with_distances_alone(mechanism));
  KeptDistances result{polynomials(space, requirements.functions()), {}};
  for (const Requirement& r : requirements.of_functions())
    result.tests.insert(result.tests.end(), r.distances.begin(), r.distances.end());
  return result;
}

Mechanism at_requirements(const Mechanism& mechanism) {
  if (mechanism.requirements().empty())
    throw ModelError(model_place(mechanism), "the model has no requirements",
                     "some, in its section [REQUIREMENTS] or beside it");
  Companion companion(mechanism);
  RequirementTranslator translator(mechanism, {});
  for (const RequirementLine& line : mechanism.requirements()) {
    const Conditions conditions = translator.run(line);
    refuse_distances(line, conditions);
    for (const VelocityCondition& c : conditions.of_velocities) add_block(line, as_form(line, c), companion);
    if (conditions.excess) companion.add_equation(line, times(*conditions.excess, companion.rate(CoordinateKind::length)));
  }
  companion.add_locked_rates(0);
  return companion.take();
}

std::vector<RequirementPart> requirement_parts(const Mechanism& mechanism) {
  std::vector<RequirementPart> parts;
  RequirementTranslator translator(mechanism, {});
  for (std::size_t k = 0; k < mechanism.requirements().size(); ++k) {
    const RequirementLine& line = mechanism.requirements()[k];
    const Conditions conditions = translator.run(line);
    refuse_distances(line, conditions);
    const std::size_t n = std::max<std::size_t>(conditions.of_velocities.size(), 1);
    for (std::size_t c = 0; c < n; ++c) {
      std::string name = n > 1 ? line.text + " (" + std::to_string(c + 1) + ")" : line.text;
      const auto is_taken = [&](const std::string& text) {
        return std::ranges::any_of(parts, [&](const RequirementPart& p) { return p.name == text; });
      };
      if (is_taken(name)) continue;  // the same requirement again
      parts.push_back({std::move(name), k, c});
    }
  }
  return parts;
}

LimitCompanion at_limit(const Mechanism& mechanism, const RequirementPart& part) {
  const RequirementLine& line = mechanism.requirements().at(part.requirement);
  Conditions conditions = RequirementTranslator(mechanism, {}).run(line);
  Companion companion(mechanism);
  if (conditions.excess) {
    companion.add_equation(line, times(*conditions.excess, companion.rate(CoordinateKind::length)));
    companion.add_locked_rates(0);
    return {companion.take(), {}};
  }
  VelocityCondition& condition = conditions.of_velocities.at(part.condition);
  refuse_tensions(line, condition);
  if (condition.groups.empty()) {
    add_block(line, condition, companion);
    companion.add_locked_rates(0);
    return {companion.take(), {}};
  }
  const std::vector<Expression> m = companion.rates(condition.kinds);
  for (const std::vector<Expression>& row : condition.rows) companion.add_row(line, row, m);
  companion.add_locked_rates(1);
  return {companion.take(), std::move(condition)};
}

}  // namespace corank::symbolic
