#include "corank/symbolic/sets/requirement_conditions.h"

#include <algorithm>
#include <array>

#include "corank/core/check.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/requirement_text.h"
#include "corank/symbolic/sets/drawn_bodies.h"
#include "corank/symbolic/sets/requirement_units.h"
#include "corank/symbolic/velocity/kernel_vector.h"
#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::symbolic {
namespace {

constexpr std::size_t kMostInputs = 8;    // of an error: half as many corners as 2 to that
constexpr std::size_t kMostLocked = 150;  // choices of cables that are locked

}  // namespace

class RequirementTranslator::Translator {
 public:
  Translator(const Mechanism& mechanism, const std::vector<std::string>& parameters)
      : mechanism_(mechanism), parameters_(parameters) {}

  Conditions run(const RequirementLine& line) {
    line_ = &line;
    Conditions out;
    try {
      std::visit([&](const auto& limit) { add(limit, out); }, parse_requirement(line.text, line.where).limit);
    } catch (const RequirementFault& fault) {
      refuse(fault.what(), fault.expectation);
    }
    return out;
  }

 private:
  [[noreturn]] void refuse(const std::string& problem, const std::string& expected) const {
    throw ModelError(line_->where, "the requirement " + in_quotes(line_->text) + ": " + problem, expected);
  }

  const ExpressionMatrix& velocity() {
    if (velocity_.columns.empty()) {
      if (mechanism_.is_plain_system())
        refuse("a plain system has no inputs and outputs", "[INPUTS] and [OUTPUTS], or a comparison such as x <= 1");
      velocity_ = derive(mechanism_).velocity.matrix;
    }
    return velocity_;
  }

  std::size_t column(const std::string& name) {
    const auto& columns = velocity().columns;
    auto found = std::ranges::find(columns, name);
    for (const char* of : {"v_", "w_"})  // how the rates of a robot from parts are called
      if (found == columns.end()) found = std::ranges::find(columns, of + name);
    if (found == columns.end())
      refuse(in_quotes(name) + " has no velocity" + suggestion(name, columns), "one of " + joined(columns));
    return found - columns.begin();
  }
  std::size_t column(const std::string& name, Role role) {
    const std::size_t found = column(name);
    if (velocity().roles[found] != role)
      refuse(in_quotes(name) + " is no " + to_string(role), std::string("the name of an ") + to_string(role));
    return found;
  }
  std::size_t driven_column(const std::string& name) {
    const std::size_t found = column(name);
    if (velocity().roles[found] == Role::input) refuse(in_quotes(name) + " is an input", "coordinates that motors move");
    return found;
  }
  Dimension dimension(std::size_t column) { return dimension_of(mechanism_, velocity().columns[column]); }

  bool depends_on_parameter(const Expression& e) const {
    if (std::ranges::any_of(parameters_, [&](const std::string& name) { return e.mentions(name); })) return true;
    return std::ranges::any_of(mechanism_.constants(),
                               [&](const Constant& c) { return e.mentions(c.name) && depends_on_parameter(c.value); });
  }

  Expression in_model_units(const Quantity& quantity, Dimension wanted) const {
    if (depends_on_parameter(quantity.value))
      refuse(quantity.value.text() + " depends on a parameter", "limits that keep their values");
    if (const std::string name = mechanism_.toleranced_in(quantity.value); !name.empty())
      refuse(quantity.value.text() + " depends on " + in_quotes(name) + ", which is known within a tolerance only",
             "limits that are exact");
    return quantity.unit.empty() ? quantity.value
                                 : quantity.value * size_of_unit(quantity.unit, wanted, mechanism_.drawing().unit);
  }
  const Expression& checked(const Expression& e, int least_sign) const {
    if (exact_value(mechanism_, e, e.text()).sign().value_or(-1) < least_sign)
      refuse(e.text() + " is not " + (least_sign > 0 ? "positive" : "0 or more"), "a positive number");
    return e;
  }
  Expression positive(const Quantity& q, Dimension wanted) const { return checked(in_model_units(q, wanted), 1); }

  // The rows of L in these columns, each a sum of multiples of columns; without rows of zeros.
  struct Column {
    std::vector<std::pair<std::size_t, Expression>> parts;
  };
  VelocityCondition condition(const std::vector<Column>& columns) {
    VelocityCondition result;
    for (const Column& c : columns)
      result.kinds.push_back(c.parts.size() == 1 && dimension(c.parts[0].first) == Dimension::angle
                                 ? CoordinateKind::angle
                                 : CoordinateKind::length);
    for (const std::vector<Expression>& row : velocity().rows) {
      std::vector<Expression> entries;
      bool zero = true;
      for (const Column& c : columns) {
        std::vector<Expression> terms;
        for (const auto& [column, factor] : c.parts)
          if (!same_tree(row[column], 0)) terms.push_back(same_tree(factor, 1) ? row[column] : times(row[column], factor));
        zero = zero && terms.empty();
        entries.push_back(terms.empty() ? Expression(0) : sum_of(terms));
      }
      if (!zero) result.rows.push_back(std::move(entries));
    }
    return result;
  }
  static Column whole(std::size_t column) { return {{{column, 1}}}; }

  void add(const AmplificationLimit& limit, Conditions& out) {
    const Role other = limit.role == Role::output ? Role::input : Role::output;
    if (!limit.most.unit.empty()) refuse("an amplification has no unit", "a number; units belong behind metric");
    const Expression most = positive(limit.most, Dimension::number);
    const std::size_t n = velocity().columns.size();
    std::vector<std::optional<Expression>> sizes(n);
    for (const auto& [name, quantity] : limit.metric) {
      const std::size_t c = column(name);
      if (velocity().roles[c] == Role::passive) refuse(in_quotes(name) + " is neither input nor output", "one that is");
      sizes[c] = positive(quantity, dimension(c));
    }
    std::array<std::array<bool, 3>, 2> has{};  // of the other role, of this one: numbers, lengths, angles
    for (std::size_t c = 0; c < n; ++c)
      if (velocity().roles[c] != Role::passive)
        has[velocity().roles[c] == limit.role][static_cast<std::size_t>(dimension(c))] = true;
    const auto kinds = [&](bool of_role) { return std::ranges::count(has[of_role], true); };
    if (kinds(false) == 0 || kinds(true) == 0) refuse("the model has no inputs or no outputs", "both");
    std::vector<Column> columns;
    std::vector<Expression> form;
    for (std::size_t c = 0; c < n; ++c) {
      columns.push_back(whole(c));
      const Role role = velocity().roles[c];
      const bool of_role = role == limit.role;
      if (role != Role::passive && !sizes[c] && kinds(of_role) > 1)
        refuse(std::string("the ") + to_string(role) + "s have different units, and " + in_quotes(velocity().columns[c]) +
                   " has no metric",
               "metric " + velocity().columns[c] +
                   (dimension(c) == Dimension::angle    ? ": 1 deg"
                    : dimension(c) == Dimension::length ? ": 1 mm"
                                                        : ": 1") +
                   ", …");
      const Expression size = sizes[c] ? *sizes[c] * *sizes[c] : Expression(1);
      form.push_back(role == other ? most * most / size : of_role ? -(Expression(1) / size) : Expression(0));
    }
    out.of_velocities.push_back(condition(columns));
    out.of_velocities.back().form = std::move(form);
  }

  void add(const EffortLimit& limit, Conditions& out) {
    const std::size_t motor = column(limit.motor, Role::input);
    const bool turns = dimension(motor) == Dimension::angle;
    if (turns != limit.torque) refuse(in_quotes(limit.motor) + " is " + word(dimension(motor)), turns ? "torque" : "force");
    std::vector<Column> columns;
    const std::vector<int> place = without_inputs(columns);
    columns.push_back(whole(motor));
    VelocityCondition of_motor = on_a_line(columns);
    of_motor.bound = positive(limit.most, limit.torque ? Dimension::moment : Dimension::force);
    add_loads(limit.loads, place, {}, of_motor.bound, of_motor);
    out.of_velocities.push_back(std::move(of_motor));
  }

  // The work of the loads: a group for each, and one for those of one value less the cables' mean, a column z = Σ c_j m_j /
  // size, `size` one like the c_j.
  void add_loads(const std::vector<Load>& loads, const std::vector<int>& place, std::vector<std::pair<int, Expression>> work,
                 const Expression& size, VelocityCondition& result) {
    for (const Load& load : loads) {
      VelocityCondition::Group group;
      for (const std::string& name : load.names) {
        const std::size_t c = driven_column(name);
        if (dimension(c) != (load.moment ? Dimension::angle : Dimension::length))
          refuse(in_quotes(name) + " is " + word(dimension(c)), load.moment ? "a moment on angles" : "a force on lengths");
        add_column(name, place[c], group);
      }
      const Expression most = in_model_units(load.most, load.moment ? Dimension::moment : Dimension::force);
      if (load.constant) {
        work.emplace_back(group.columns[0], most);
      } else {
        group.weight = checked(most, 0);
        result.groups.push_back(std::move(group));
      }
    }
    if (work.empty()) return;
    for (std::vector<Expression>& row : result.rows) row.insert(row.begin(), 0);
    std::vector<Expression>& row = result.rows.emplace_back(result.kinds.size() + 1, 0);
    result.kinds.insert(result.kinds.begin(), CoordinateKind::length);
    row[0] = 1;
    for (const auto& [column, factor] : work) row[column + 1] = row[column + 1] - factor / size;
    for (VelocityCondition::Group& group : result.groups)
      for (int& column : group.columns) ++column;
    result.groups.push_back({{0}, size});
  }

  void add(const TensionLimit& limit, Conditions& out) {
    const Expression least = checked(in_model_units(limit.least, Dimension::force), 0);
    const Expression most = positive(limit.most, Dimension::force), two(2);
    if (exact_value(mechanism_, most - least, limit.most.value.text()).sign().value_or(0) <= 0)
      refuse("its range is empty", "the smaller tension first");
    std::vector<std::size_t> cables;
    for (const std::string& name : limit.cables) {
      cables.push_back(column(name, Role::input));
      if (dimension(cables.back()) != Dimension::length) refuse(in_quotes(name) + " is no length", "the lengths of cables");
      if (std::ranges::count(cables, cables.back()) > 1) refuse(in_quotes(name) + " occurs twice", "each name once");
    }
    const auto& columns = velocity().columns;
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (velocity().roles[c] == Role::input && std::ranges::find(cables, c) == cables.end())
        refuse("the input " + in_quotes(columns[c]) + " is none of the cables", "all inputs");
    const std::size_t freedom = columns.size() - std::min(columns.size(), velocity().rows.size());
    if (freedom == 0 || cables.size() < freedom)
      refuse("there are " + counted(cables.size(), "cable") + " for " + counted(freedom, "degree") + " of freedom",
             "as many or more");
    // The cables that are not locked: freedom − 1 are.
    std::vector<char> moves(cables.size(), 0);
    std::fill(moves.begin() + static_cast<std::ptrdiff_t>(freedom) - 1, moves.end(), 1);
    std::size_t count = 0;
    do {
      if (++count > kMostLocked) refuse("there are too many cables", "fewer: each choice of those that are locked counts");
      std::vector<Column> all;
      const std::vector<int> place = without_inputs(all);
      std::vector<std::pair<int, Expression>> work;
      for (std::size_t k = 0; k < cables.size(); ++k) {
        if (moves[k] == 0) continue;
        work.emplace_back(static_cast<int>(all.size()), -((least + most) / two));
        all.push_back(whole(cables[k]));
      }
      VelocityCondition result = on_a_line(all);
      result.ends = static_cast<int>(work.size());
      result.of_tensions = true;
      result.bound = (most - least) / two;
      add_loads(limit.loads, place, std::move(work), most, result);
      out.of_velocities.push_back(std::move(result));
    } while (std::next_permutation(moves.begin(), moves.end()));
  }

  void add(const ErrorLimit& limit, Conditions& out) {
    std::vector<Column> columns;
    const std::vector<int> place = without_inputs(columns);
    std::vector<std::size_t> inputs;
    for (std::size_t c = 0; c < place.size(); ++c)
      if (place[c] < 0) inputs.push_back(c);
    if (inputs.empty() || inputs.size() > kMostInputs)
      refuse("there are " + counted(inputs.size(), "input"), "1 to " + std::to_string(kMostInputs));
    VelocityCondition::Group group{{}, 1};
    const Dimension of = dimension(column(limit.names[0]));
    for (const std::string& name : limit.names) {
      const std::size_t c = driven_column(name);
      if (dimension(c) != of) refuse("an error in different units", "a requirement for each");
      add_column(name, place[c], group);
    }
    std::vector<std::optional<Expression>> most(place.size());
    for (const auto& [name, quantity] : limit.inputs) {
      const bool all = name == "inputs" && std::ranges::find(velocity().columns, name) == velocity().columns.end();
      for (const std::size_t c : all ? inputs : std::vector{column(name, Role::input)})
        most[c] = checked(in_model_units(quantity, dimension(c)), 0);
    }
    for (const std::size_t c : inputs)
      if (!most[c]) refuse("the error of " + in_quotes(velocity().columns[c]) + " is not given", "one for each input");
    const Expression bound = positive(limit.most, of);
    for (std::size_t corner = 0; corner < std::size_t{1} << (inputs.size() - 1); ++corner) {
      Column together;
      for (std::size_t k = 0; k < inputs.size(); ++k)
        together.parts.emplace_back(inputs[k], (corner >> k & 1) != 0 ? -*most[inputs[k]] : *most[inputs[k]]);
      std::vector<Column> all = columns;
      all.push_back(std::move(together));
      VelocityCondition at_corner = on_a_line(all);
      at_corner.groups.push_back(group);
      at_corner.bound = bound;
      out.of_velocities.push_back(std::move(at_corner));
    }
  }

  void add(const DistanceLimit& limit, Conditions& out) const {
    const Expression wanted = checked(in_model_units(limit.least, Dimension::length), 0);
    std::array<std::vector<RoundedHull>, 2> bodies;
    for (std::size_t b = 0; b < 2; ++b) {
      bodies[b] = drawn_body(mechanism_.drawing(), limit.bodies[b].names);
      if (const std::optional<Quantity>& radius = limit.bodies[b].radius)
        for (RoundedHull& hull : bodies[b])
          hull.radius = hull.radius + checked(in_model_units(*radius, Dimension::length), 0);
    }
    for (const RoundedHull& a : bodies[0])
      for (const RoundedHull& b : bodies[1])
        out.of_distances.push_back({{a.points, b.points}, positive({wanted + a.radius + b.radius}, Dimension::length)});
  }

  // cos² of the angle, or of the limit where it is the other way round, is at most the other one. ‖u‖²‖v‖² is on both sides.
  void add(const LineAngleLimit& limit, Conditions& out) const {
    std::vector<std::array<Expression, 3>> lines;
    const auto add_line = [&](const std::string& from, const std::string& to) {
      const auto a = drawn_point(mechanism_.drawing(), from), b = drawn_point(mechanism_.drawing(), to);
      lines.push_back({b[0] - a[0], b[1] - a[1], b[2] - a[2]});
    };
    if (limit.least) {
      const std::vector<std::string>& p = limit.points[0];
      if (p.size() != 3) refuse("it has " + counted(p.size(), "point"), "three, the angle's vertex in the middle");
      add_line(p[1], p[0]);
      add_line(p[1], p[2]);
    } else {
      for (const std::vector<std::string>& p : limit.points) {
        if (p.size() != 2) refuse("a line has " + counted(p.size(), "point"), "two");
        add_line(p[0], p[1]);
      }
    }
    const Expression angle = positive(limit.limit, Dimension::angle);
    if (exact_value(mechanism_, pi() / Expression(2) - angle, limit.limit.value.text()).sign().value_or(-1) <= 0)
      refuse(limit.limit.value.text() + " is not below 90 degrees", "an angle between 0 and 90 deg");
    const auto dot = [](const std::array<Expression, 3>& u, const std::array<Expression, 3>& v) {
      std::vector<Expression> terms;
      for (std::size_t i = 0; i < 3; ++i)
        if (!same_tree(u[i], 0) && !same_tree(v[i], 0)) terms.push_back(times(u[i], v[i]));
      return terms.empty() ? Expression(0) : sum_of(terms);
    };
    const Expression along = pow(dot(lines[0], lines[1]), 2);
    const Expression all = pow(Expression::function("cos", angle), 2) * dot(lines[0], lines[0]) * dot(lines[1], lines[1]);
    out.excess = limit.least ? along - all : all - along;
  }

  void add(const Relation& relation, Conditions& out) const {
    const bool at_most = relation.kind == Relation::Kind::less_equal;
    out.excess = at_most ? relation.lhs - relation.rhs : relation.rhs - relation.lhs;
  }

  // The same, for one velocity but for its size: locked motors leave the mechanism no freedom, and one more motor moves it.
  VelocityCondition on_a_line(const std::vector<Column>& columns) {
    VelocityCondition result = condition(columns);
    if (result.rows.size() + 1 != columns.size())
      refuse("the mechanism with all motors locked has " +
                 std::string(result.rows.size() + 1 < columns.size() ? "a freedom left" : "more equations than unknowns"),
             "as many inputs as the mobility");
    return result;
  }

  // Appends the columns but the inputs', and says where each is; −1: an input's.
  std::vector<int> without_inputs(std::vector<Column>& columns) {
    std::vector<int> place(velocity().columns.size(), -1);
    for (std::size_t c = 0; c < place.size(); ++c) {
      if (velocity().roles[c] == Role::input) continue;
      place[c] = static_cast<int>(columns.size());
      columns.push_back(whole(c));
    }
    return place;
  }
  void add_column(const std::string& name, int column, VelocityCondition::Group& group) const {
    if (std::ranges::find(group.columns, column) != group.columns.end())
      refuse(in_quotes(name) + " occurs twice", "each name once");
    group.columns.push_back(column);
  }

  const Mechanism& mechanism_;
  const std::vector<std::string> parameters_;
  const RequirementLine* line_ = nullptr;
  ExpressionMatrix velocity_;
};

void refuse_distances(const RequirementLine& line, const Conditions& conditions) {
  if (!conditions.of_distances.empty())
    throw ModelError(line.where,
                     "the requirement " + in_quotes(line.text) + " is one of a distance, whose limit is no single equation",
                     "corank map, or other requirements");
}

void refuse_tensions(const RequirementLine& line, const VelocityCondition& condition) {
  if (condition.of_tensions)
    throw ModelError(line.where,
                     "the requirement " + in_quotes(line.text) + " is one of tensions, whose limit is no single form",
                     "corank map, or other requirements");
}

VelocityCondition as_form(const RequirementLine& line, VelocityCondition c) {
  refuse_tensions(line, c);
  if (!c.form.empty()) return c;
  if (c.groups.size() != 1)
    throw ModelError(line.where, "the requirement " + in_quotes(line.text) + " has " + counted(c.groups.size(), "load"),
                     "one load, or corank map");
  c.form.assign(c.kinds.size(), 0);
  for (const int j : c.groups[0].columns) c.form[j] = -(c.groups[0].weight * c.groups[0].weight);
  c.form.back() = c.bound * c.bound;
  c.groups.clear();
  return c;
}

RequirementTranslator::RequirementTranslator(const Mechanism& mechanism, const std::vector<std::string>& parameters)
    : translator_(std::make_unique<Translator>(mechanism, parameters)) {}
RequirementTranslator::~RequirementTranslator() = default;

Conditions RequirementTranslator::run(const RequirementLine& line) { return translator_->run(line); }

}  // namespace corank::symbolic
