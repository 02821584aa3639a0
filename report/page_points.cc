#include "corank/report/page_points.h"

#include <fmt/format.h>

#include <algorithm>

#include "corank/certify/angle.h"
#include "corank/report/page_words.h"
#include "corank/result/exact_angle.h"
#include "corank/result/tallies.h"
#include "corank/symbolic/display_name.h"
#include "corank/symbolic/mathml.h"

namespace corank::report {
namespace {

/// A coordinate of the model: a variable, or an angle with its cosine and sine.
struct Column {
  std::string name;
  int variable, sine = -1;
  Interval range{};
};

std::vector<Column> columns(const result::Result& result) {
  std::vector<Column> list;
  for (int i = 0; i < result.configuration_size; ++i) {
    const auto angle = std::find_if(result.angles.begin(), result.angles.end(),
                                    [i](const Angle& a) { return a.cosine == i || a.sine == i; });
    if (angle == result.angles.end()) {
      list.push_back({result.variables[static_cast<std::size_t>(i)].name, i});
    } else if (i == std::min(angle->cosine, angle->sine)) {
      list.push_back({angle->name, angle->cosine, angle->sine, angle->range});
    }
  }
  return list;
}

/// "−3/5" or "√3/2" typeset; nothing where there is no short text.
std::string exact_html(const ExactPoint& point, int variable) {
  const auto text = result::exact_coordinate(point, variable);
  return text ? symbolic::math(symbolic::mathml(symbolic::Expression(*text))) : "";
}

/// "3π/4", or "cos: 3/5, sin: 4/5" behind the digits of the angle.
std::string exact_angle_html(const ExactPoint& point, const Column& column, const Interval& angle) {
  const Angle as{column.name, column.variable, column.sine, column.range};
  if (const auto text = result::multiple_of_pi(point, as, angle))
    return symbolic::math(symbolic::mathml(symbolic::Expression(*text)));
  const std::string cosine = exact_html(point, column.variable), sine = exact_html(point, column.sine);
  if (cosine.empty() || sine.empty()) return digits_text(angle);
  return digits_text(angle) + " <small>cos: " + cosine + ", sin: " + sine + "</small>";
}

/// The coordinate of a point as well as it is known: exactly, in decimals, or between bounds.
std::string cell(const result::Result& result, const Column& column, std::size_t number) {
  const Cover& cover = result.cover;
  const CoverBox& point = cover.points[number];
  const auto at = [&point](int v) { return point.box[static_cast<std::size_t>(v)]; };
  if (column.sine >= 0) {
    const Interval angle = certify::angle_enclosure(at(column.variable), at(column.sine), column.range);
    return point.point < 0 ? digits_text(angle)
                           : exact_angle_html(cover.exact_points[static_cast<std::size_t>(point.point)], column, angle);
  }
  std::string exact, value = digits_text(at(column.variable));
  if (point.point >= 0) exact = exact_html(cover.exact_points[static_cast<std::size_t>(point.point)], column.variable);
  const bool has_decimals = number < cover.decimals.size() && !cover.decimals[number].empty();
  if (has_decimals)
    value = symbolic::html_text(with_minus(cover.decimals[number][static_cast<std::size_t>(column.variable)]));
  if (exact.empty()) return value;
  const bool is_decimal = value.find('[') == std::string::npos && value.find('.') == std::string::npos;
  return is_decimal ? exact : exact + " <small>" + value + "</small>";  // an integer needs no decimals
}

std::string exact_cell(const Column& column, const ExactPoint& point) {
  const auto text = [&point](int v) {
    const std::string html = exact_html(point, v);
    return html.empty() ? fmt::format("a number of degree {}", point.polynomial.size() - 1) : html;
  };
  if (column.sine < 0) return text(column.variable);
  return fmt::format("cos: {}, sin: {}", text(column.variable), text(column.sine));
}

/// Points where the kernel has dimension 2 or more.
std::string kernel_points_html(const result::Result& result, const std::vector<Column>& shown) {
  std::string rows;
  int number = 0;
  for (const ExactPoint& point : result.cover.exact_points) {
    if (point.corank < 2) continue;
    rows += fmt::format("<tr><td>{}</td>", ++number);
    for (const Column& column : shown) rows += "<td>" + exact_cell(column, point) + "</td>";
    rows += fmt::format("<td>{}</td></tr>", point.corank);
  }
  if (rows.empty()) return "";
  std::string head;
  for (const Column& column : shown) head += "<th>" + symbolic::html_name(column.name) + "</th>";
  return fmt::format(
      "<p>At these points the kernel has a larger dimension. They are known exactly, and proven in exact "
      "arithmetic.</p><div "
      "class=\"scroll\"><table>"
      "<thead><tr><th>point</th>{}<th>kernel’s dimension</th></tr></thead><tbody>{}</tbody></table></div>",
      head, rows);
}

// The types of singularity that are proven of it; a question mark where one that makes up the set is not settled.
std::string types_cell(const Cover& cover, const CoverBox& point) {
  const bool known = holds_a_solution(point);
  std::string text = known ? fmt::format("{}", fmt::join(result::type_names(point.types.proven), ", ")) : "";
  if (!known || !point.types.settle(cover.types.of_set)) text += text.empty() ? "?" : ", ?";
  return "<td>" + text + "</td>";
}

std::string table_html(const SetView& view) {
  const result::Result& result = view.result;
  const std::vector<Column> shown = columns(result);
  std::string html = fmt::format("<section class=\"points\" data-set=\"{}\"><h3>{}</h3>", view.set->name, view.words.title);
  if (!result.cover.points.empty()) {
    html += "<div class=\"scroll\"><table><thead><tr><th>point</th>";
    for (const Column& column : shown) html += "<th>" + symbolic::html_name(column.name) + "</th>";
    const bool types = result.cover.types.asked != 0;
    html += std::string(types ? "<th>types</th>" : "") + "<th>verdict</th></tr></thead><tbody>";
    std::size_t number = 0;
    for (const CoverBox& point : result.cover.points) {
      html += fmt::format("<tr data-point=\"{}\"><td><button type=\"button\" class=\"show-point\">{}</button></td>", number,
                          number + 1);
      for (const Column& column : shown) html += "<td>" + cell(result, column, number) + "</td>";
      if (types) html += types_cell(result.cover, point);
      html += fmt::format("<td><span class=\"verdict {0}\">{0}</span></td></tr>", to_string(point.verdict));
      ++number;
    }
    html += "</tbody></table></div>";
  }
  return html + kernel_points_html(result, shown) + "</section>";
}

}  // namespace

std::string points_html(const std::vector<SetView>& views) {
  std::string html;
  for (const SetView& view : views) {
    const Cover& cover = view.result.cover;
    const bool isolated = cover.dimension == 0 && !cover.points.empty();
    const bool kernels = std::any_of(cover.exact_points.begin(), cover.exact_points.end(),
                                     [](const ExactPoint& point) { return point.corank > 1; });
    if (isolated || kernels) html += table_html(view);
  }
  return html.empty() ? "<p>No set of this mechanism consists of isolated points.</p>" : html;
}

}  // namespace corank::report
