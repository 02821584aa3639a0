#include <fmt/format.h>

#include <boost/algorithm/string.hpp>

#include "corank/report/html/page.h"
#include "corank/report/html/page_words.h"
#include "corank/result/files/verification.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/model/display_name.h"
#include "corank/symbolic/sets/singularity_system.h"
#include "corank/symbolic/writing/mathml.h"

namespace corank::report {
namespace {

using symbolic::math;
using symbolic::mathml;

std::string numbered(const std::vector<std::string>& equations, const std::vector<std::string>& sources) {
  std::string html = "<ol class=\"equations\">";
  for (std::size_t i = 0; i < equations.size(); ++i) {
    html += "<li>" + math(equations[i]);
    if (i < sources.size() && !sources[i].empty())
      html += "<span class=\"source\">" + symbolic::html_text(sources[i]) + "</span>";
    html += "</li>";
  }
  return html + "</ol>";
}

std::string symbol(const std::string& base, const std::string& subscript) {
  if (subscript.empty()) return "<mi>" + base + "</mi>";
  return "<msub><mi>" + base + "</mi><mi>" + subscript + "</mi></msub>";
}

std::string matrix_html(const std::string& base, const std::string& subscript, const std::string& words,
                        const symbolic::ExpressionMatrix& matrix) {
  const std::string columns = names_html(matrix.columns);
  return fmt::format(
      "<figure class=\"matrix\"><figcaption>{} · columns {}</figcaption><div class=\"scroll\">{}</div></figure>", words,
      columns.empty() ? "none" : columns, math(symbol(base, subscript) + "<mo>=</mo>" + mathml(matrix)));
}

std::string system_html(const symbolic::TrigonometricSystem& system, const SetView& view) {
  const std::string& kernel = view.result.options.kernel;
  std::vector<std::string> equations, sources;
  for (const auto* list : {&system.equations, &system.inequalities}) {
    for (const auto& equation : *list) {
      equations.push_back(mathml(equation.relation));
      sources.push_back(equation.source);
    }
  }
  return fmt::format("<details><summary>{}: {}{}</summary><div class=\"scroll\">{}</div></details>", view.words.title,
                     result::counted(system.equations.size(), "equation"),
                     kernel.empty() ? "" : ", " + symbolic::html_text(kernel) + " kernel", numbered(equations, sources));
}

// "d1 = 0, d2 = 0" as formulas.
std::string relations_html(const std::string& text) {
  std::vector<std::string> formulas, relations;
  boost::split(relations, text, boost::is_any_of(","));
  for (const std::string& relation : relations) {
    const std::size_t equals = relation.find(" = ");
    if (equals == std::string::npos) return math(mathml(symbolic::Expression(text)));
    formulas.push_back(
        math(mathml(symbolic::Expression(relation.substr(0, equals)) == symbolic::Expression(relation.substr(equals + 3)))));
  }
  return fmt::format("{}", fmt::join(formulas, ", "));
}

std::string part_html(const result::Result& part, const symbolic::SetDefinition& set) {
  const std::string name = symbolic::html_text(part.part);
  if (!part.condition.empty())
    return fmt::format("<li>{}<span class=\"source\">{}</span></li>", relations_html(part.condition),
                       part.part == part.condition ? "" : name);
  if (set.of_requirements || (set.of_parts && part.options.kernel.empty())) return "<li>" + name + "</li>";
  return "<li>" + name + (set.of_parts ? ": with multipliers" : ": singular, with a kernel vector of its own") + "</li>";
}

std::string union_html(const SetView& view) {
  std::string list;
  std::size_t empty = 0;  // of hundreds of choices of limits most are
  for (const result::Result& part : view.result.parts) {
    const bool shown = !view.set->of_parts || !part.cover.boxes.empty();
    if (shown) list += part_html(part, *view.set);
    empty += !shown;
  }
  if (empty > 0) list += fmt::format("<li>{} without a solution</li>", result::counted(empty, "part"));
  return fmt::format(
      "<details><summary>{}: the union of {}</summary><p>The assembly constraints and one of these{}:</p><div "
      "class=\"scroll\"><ol class=\"equations\">{}</ol></div></details>",
      view.words.title, result::counted(view.result.parts.size(), "part"),
      view.set->of_requirements ? " requirements at its limit"
      : view.set->of_parts      ? ", within the limits"
                                : " equations, in which the determinant of the block above factors",
      list);
}

}  // namespace

std::string derivation_html(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation,
                            const std::vector<SetView>& views) {
  std::string html = "<h3>Assembly constraints " +
                     math("<mi mathvariant=\"normal\">Φ</mi><mo>(</mo><mi>q</mi><mo>)</mo><mo>=</mo><mn>0</mn>") + "</h3>";
  std::vector<std::string> phi;
  for (const symbolic::Expression& e : derivation.phi) phi.push_back(mathml(e == symbolic::Expression(0)));
  html += "<div class=\"scroll\">" + numbered(phi, {}) + "</div><h3>" +
          std::string(derivation.velocity.given ? "Velocity equation and its blocks" : "Jacobian blocks") + "</h3>";
  if (derivation.velocity.given) {
    html += matrix_html("L", "", "given by the model, in rates of its own", derivation.velocity.matrix);
  } else {
    html += matrix_html("Φ", "q", "all coordinates", derivation.velocity.matrix);
  }
  for (const symbolic::SetDefinition& set : symbolic::set_definitions())
    if (!set.locked.empty() && set.is_usual())
      html += matrix_html(
          "L", set.matrix + 2,
          fmt::format("without the {}s; rank deficient at {} singularities", to_string(set.locked.front()), set.name),
          derivation.velocity.without(set.locked));
  html +=
      "<h3>Systems solved</h3><p>In the search, the cosine c and the sine s of an angle are variables of their own, with "
      "the equation c² + s² = 1.</p>";
  for (const SetView& view : views)
    html += view.result.parts.empty()
                ? system_html(result::equations_of(mechanism, view.set->set.value(), view.result.options), view)
                : union_html(view);
  return html;
}

}  // namespace corank::report
