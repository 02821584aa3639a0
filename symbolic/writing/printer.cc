#include "corank/symbolic/writing/printer.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "corank/symbolic/writing/line_breaks.h"

namespace corank::symbolic {
namespace {

// ---- text

std::string right_aligned(const std::string& text, std::size_t width) {
  return text.size() >= width ? text : std::string(width - text.size(), ' ') + text;
}

std::string number_label(std::size_t i) { return "(" + std::to_string(i + 1) + ")"; }

// Of a matrix too wide for a line: row by row the entries that are not 0, each behind its column.
void print_entries(std::ostream& out, const ExpressionMatrix& matrix, std::size_t label) {
  std::size_t column = 0;
  for (const std::string& name : matrix.columns) column = std::max(column, name.size());
  const std::size_t indent = 2 + label + 2 + column + 2;
  for (std::size_t i = 0; i < matrix.rows.size(); ++i) {
    std::string number = number_label(i);
    for (std::size_t j = 0; j < matrix.columns.size(); ++j) {
      if (same_tree(matrix.rows[i][j], Expression(0))) continue;
      const std::string entry = matrix.rows[i][j].text();
      out << "  " << padded(number, label) << "  " << padded(matrix.columns[j], column) << "  "
          << broken(entry, indent, indent + 2) << "\n";
      number.clear();
    }
    if (!number.empty()) out << "  " << padded(number, label) << "  0\n";
  }
}

// A matrix with the coordinates, or the rates, above its columns and the equations' numbers before its rows.
void print_matrix(std::ostream& out, const std::string& name, const ExpressionMatrix& matrix) {
  out << name << "   " << matrix.rows.size() << " x " << matrix.columns.size() << "\n";
  if (matrix.columns.empty()) return;
  const std::size_t label = number_label(matrix.rows.empty() ? 0 : matrix.rows.size() - 1).size();
  std::vector<std::size_t> widths;
  std::size_t line = 2 + label;
  for (std::size_t j = 0; j < matrix.columns.size() && line <= kLineWidth; ++j) {
    std::size_t width = matrix.columns[j].size();
    for (const auto& row : matrix.rows) width = std::max(width, row[j].text().size());
    widths.push_back(width);
    line += 2 + width;
  }
  if (line > kLineWidth) return print_entries(out, matrix, label);
  out << "  " << std::string(label, ' ');
  for (std::size_t j = 0; j < widths.size(); ++j) out << "  " << right_aligned(matrix.columns[j], widths[j]);
  out << "\n";
  for (std::size_t i = 0; i < matrix.rows.size(); ++i) {
    out << "  " << padded(number_label(i), label);
    for (std::size_t j = 0; j < widths.size(); ++j) out << "  " << right_aligned(matrix.rows[i][j].text(), widths[j]);
    out << "\n";
  }
}

// Which rows are zero because their equations speak of the chosen coordinates alone.
void print_ties(std::ostream& out, const std::string& chosen, const std::vector<std::size_t>& rows) {
  if (rows.empty()) return;
  out << "  ";
  for (const std::size_t row : rows) out << number_label(row) << " ";
  out << (rows.size() == 1 ? "ties" : "tie") << " the " << chosen << " to one another; the rank is that of the other rows\n";
}

// Numbered lines "(3)  text    source", the sources aligned unless the texts are very long.
void print_numbered(std::ostream& out, const std::vector<std::pair<std::string, std::string>>& lines,
                    std::size_t first = 0) {
  constexpr std::size_t kLongest = 90;
  std::size_t width = 0;
  for (const auto& [text, source] : lines)
    if (text.size() <= kLongest) width = std::max(width, text.size());
  const std::size_t label = number_label(first + std::max<std::size_t>(lines.size(), 1) - 1).size();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    out << "  " << padded(number_label(first + i), label) << "  ";
    const std::string text = broken(lines[i].first, label + 4, label + 6);
    if (lines[i].second.empty()) {
      out << text << "\n";
    } else {
      out << padded(text, width) << "   % " << lines[i].second << "\n";
    }
  }
}

std::vector<std::pair<std::string, std::string>> relation_lines(
    const std::vector<TrigonometricSystem::Equation>& relations) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const auto& relation : relations) lines.emplace_back(relation.relation.text(), relation.source);
  return lines;
}

std::string range_line(const Coordinate& c) {
  return "  " + c.name + (c.kind == CoordinateKind::angle ? " ~ " : " : ") + c.range_text() +
         (c.has_range ? "" : "   % found from the equations") + "\n";
}

std::string unknown_lines(const TrigonometricSystem& system) {
  std::string lines;
  for (const auto* names : {&system.kernel_unknowns, &system.second_unknowns})
    for (const std::string& name : *names) lines += "  " + name + " : [-1, 1]\n";
  for (const auto& [name, lower, upper] : system.further_unknowns)
    lines += "  " + name + " : [" + std::to_string(lower) + ", " + std::to_string(upper) + "]\n";
  return lines;
}

std::vector<TrigonometricSystem::Equation> relations(const TrigonometricSystem& system) {
  std::vector<TrigonometricSystem::Equation> all = system.equations;
  all.insert(all.end(), system.inequalities.begin(), system.inequalities.end());
  return all;
}

// What a system has in common with the first one of its set, and what it has for itself.
struct Comparison {
  std::vector<std::size_t> common;  // relations of the first one
  std::vector<TrigonometricSystem::Equation> own;
};

Comparison compare(const std::vector<TrigonometricSystem::Equation>& first, const TrigonometricSystem& system) {
  Comparison result;
  std::size_t next = 0;
  for (const TrigonometricSystem::Equation& e : relations(system)) {
    std::size_t k = next;
    while (k < first.size() && !same_relation(first[k].relation, e.relation)) ++k;
    if (k == first.size()) {
      result.own.push_back(e);
    } else {
      result.common.push_back(k);
      next = k + 1;
    }
  }
  return result;
}

// "(1) to (11), (13)": of which there is one at least.
std::string ranges_of_numbers(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0, last = 0; i < numbers.size(); i = last + 1) {
    last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += (text.empty() ? "" : ", ") + number_label(numbers[i]);
    if (last > i) text += (last > i + 1 ? " to " : ", ") + number_label(numbers[last]);
  }
  return text;
}

// ---- LaTeX

std::string latex(const Relation& relation, const std::string& align) {
  const char* const sign = relation.kind == Relation::Kind::equal        ? "="
                           : relation.kind == Relation::Kind::less_equal ? "\\le"
                                                                         : "\\ge";
  return relation.lhs.latex() + " " + align + sign + " " + relation.rhs.latex();
}

void print_latex_matrix(std::ostream& out, const std::string& symbol, const ExpressionMatrix& matrix) {
  out << "% columns:";
  for (const std::string& column : matrix.columns) out << " " << column;
  out << "\n\\[ " << symbol << " = \\begin{pmatrix}\n";
  for (const auto& row : matrix.rows) {
    out << "  ";
    for (std::size_t j = 0; j < row.size(); ++j) out << (j ? " & " : "") << row[j].latex();
    out << " \\\\\n";
  }
  out << "\\end{pmatrix} \\]\n";
}

void print_latex_lines(std::ostream& out, const std::vector<std::string>& lines) {
  out << "\\begin{align}\n";
  for (std::size_t i = 0; i < lines.size(); ++i) out << "  " << lines[i] << (i + 1 < lines.size() ? " \\\\\n" : "\n");
  out << "\\end{align}\n";
}

// ---- cuik

std::string constant_text(const ExactNumber& x) { return x.decimal().value_or(x.text()); }

std::string monomial_text(const Monomial& monomial, const System& system, bool first) {
  // The sign goes before the term; a coefficient that is a sum needs parentheses unless it stands alone.
  std::string coefficient = constant_text(monomial.coefficient);
  bool negative = false;
  const bool sum = coefficient.find_first_of("+-", 1) != std::string::npos && coefficient.find(' ') != std::string::npos;
  if (!sum && coefficient[0] == '-') {
    negative = true;
    coefficient.erase(0, 1);
  }
  std::string factors;
  for (const Factor& factor : monomial.factors) {
    const std::string& name = system.variables[factor.variable].name;
    if (!factors.empty()) factors += "*";
    switch (factor.function) {
      case Function::identity: factors += name; break;
      case Function::sine: factors += "sin(" + name + ")"; break;
      case Function::cosine: factors += "cos(" + name + ")"; break;
    }
    if (factor.power > 1) factors += "^" + std::to_string(factor.power);
  }
  if (sum) coefficient = "(" + coefficient + ")";
  const std::string body = factors.empty() ? coefficient : coefficient == "1" ? factors : coefficient + "*" + factors;
  return (first ? (negative ? "-" : "") : negative ? " - " : " + ") + body;
}

std::string polynomial_text(const Polynomial& polynomial, const System& system) {
  std::string out;
  for (const Monomial& monomial : polynomial.monomials) out += monomial_text(monomial, system, out.empty());
  return out.empty() ? "0" : out;
}

void print_cuik_polynomials(std::ostream& out, const std::vector<Polynomial>& polynomials, const char* relation,
                            const System& system) {
  for (const Polynomial& polynomial : polynomials) {
    if (!polynomial.source.empty()) out << "% " << one_line(polynomial.source) << "\n";
    out << polynomial_text(polynomial, system) << relation << ";\n";
  }
}

void print_system(std::ostream& out, const TrigonometricSystem& system) {
  for (const Coordinate& coordinate : system.coordinates) out << range_line(coordinate);
  out << unknown_lines(system);
  print_numbered(out, relation_lines(relations(system)));
  if (system.claimed.empty()) return;
  out << "\nImplied: rows that shrink boxes\n";
  print_numbered(out, relation_lines(system.claimed));
}

// Of a part that is not the first one. Parts by limits are hundreds, and most have the same equations.
void print_difference(std::ostream& out, const TrigonometricSystem& first, const TrigonometricSystem& system) {
  const auto named_as = [](const Coordinate& c, const TrigonometricSystem& in) {
    const auto place = std::ranges::find(in.coordinates, c.name, &Coordinate::name);
    return place == in.coordinates.end() ? nullptr : &*place;
  };
  for (const Coordinate& c : system.coordinates)
    if (const Coordinate* same = named_as(c, first); !same || range_line(*same) != range_line(c)) out << range_line(c);
  std::vector<std::string> left_out;
  for (const Coordinate& c : first.coordinates)
    if (!named_as(c, system)) left_out.push_back(c.name);
  if (!left_out.empty()) out << broken(fmt::format("  without {}", fmt::join(left_out, ", ")), 0, 4) << "\n";
  if (const std::string unknowns = unknown_lines(system); unknowns != unknown_lines(first)) out << unknowns;
  const std::vector<TrigonometricSystem::Equation> of_first = relations(first);
  const Comparison compared = compare(of_first, system);
  if (!compared.common.empty()) out << broken("  of the first system: " + ranges_of_numbers(compared.common), 0, 4) << "\n";
  print_numbered(out, relation_lines(compared.own), of_first.size());
}

}  // namespace

std::string to_text(const Derivation& derivation, std::span<const TrigonometricSystem> systems) {
  std::ostringstream out;
  out << "Φ(q) = 0\n";
  std::vector<std::pair<std::string, std::string>> phi_lines;
  for (const Expression& phi : derivation.phi) phi_lines.emplace_back(phi.text() + " = 0", "");
  print_numbered(out, phi_lines);
  out << "\n";
  print_matrix(out, derivation.velocity.given ? "L (given)" : "Φ_q", derivation.velocity.matrix);
  for (const SetDefinition& set : set_definitions()) {
    if (set.locked.empty() || !set.is_usual()) continue;
    out << "\n";
    print_matrix(out, set.matrix, derivation.velocity.without(set.locked));
    print_ties(out, std::string(to_string(set.locked.front())) + "s", derivation.velocity.dependencies(set.locked));
  }
  for (const TrigonometricSystem& system : systems) {
    out << "\nSystem " << system.name << "\n";
    &system == &systems.front() ? print_system(out, system) : print_difference(out, systems.front(), system);
  }
  return out.str();
}

std::string to_latex(const Derivation& derivation, std::span<const TrigonometricSystem> systems) {
  std::ostringstream out;
  std::vector<std::string> lines;
  out << "% Assembly constraints\n";
  for (const Expression& phi : derivation.phi) lines.push_back(latex(phi == Expression(0), "&"));
  print_latex_lines(out, lines);
  if (derivation.velocity.given) out << "% The velocity equation L m = 0 as the model gives it\n";
  print_latex_matrix(out, derivation.velocity.given ? "L" : "\\Phi_q", derivation.velocity.matrix);
  for (const SetDefinition& set : set_definitions())
    if (!set.locked.empty() && set.is_usual()) print_latex_matrix(out, set.matrix, derivation.velocity.without(set.locked));
  std::vector<TrigonometricSystem::Equation> of_first;
  for (const TrigonometricSystem& system : systems) {
    out << "% System " << one_line(system.name) << "\n";
    const Comparison compared = compare(of_first, system);
    if (!compared.common.empty())
      out << "% of the first system, counted from 1: " << ranges_of_numbers(compared.common) << "\n";
    lines.clear();
    for (const auto& e : compared.own) lines.push_back(latex(e.relation, "&"));
    if (!lines.empty()) print_latex_lines(out, lines);
    if (of_first.empty()) of_first = relations(system);
  }
  return broken_latex(out.str());
}

std::string to_cuik(const System& system) {
  std::ostringstream out;
  out << "% " << one_line(system.name) << ": polynomial equations\n";
  for (const Angle& angle : system.angles) {
    out << "% " << system.variables[angle.cosine].name << " = cos(" << angle.name << "), "
        << system.variables[angle.sine].name << " = sin(" << angle.name << "), " << angle.name << " in [" << angle.range.lo()
        << ", " << angle.range.hi() << "] rad\n";
  }
  out << "\n[SYSTEM VARS]\n";
  std::size_t width = 0;
  for (const Variable& variable : system.variables) width = std::max(width, variable.name.size());
  for (std::size_t i = 0; i < system.variables.size(); ++i) {
    const Variable& variable = system.variables[i];
    const bool first = i == 0 || system.variables[i - 1].kind != variable.kind;
    if (first && variable.kind == VariableKind::kernel) out << "% the kernel vector\n";
    if (first && variable.kind == VariableKind::auxiliary) out << "\n[DUMMY VARS]\n";
    out << padded(variable.name, width) << " : [" << constant_text(variable.lower) << ", " << constant_text(variable.upper)
        << "]\n";
  }
  out << "\n[SYSTEM EQS]\n";
  print_cuik_polynomials(out, system.equations, " = 0", system);
  print_cuik_polynomials(out, system.inequalities, " >= 0", system);
  if (!system.claimed.empty()) {
    out << "\n[IMPLIED EQS]\n";
    print_cuik_polynomials(out, system.claimed, " = 0", system);
  }
  return out.str();
}

}  // namespace corank::symbolic
