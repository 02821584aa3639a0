#include <fmt/format.h>

#include <algorithm>

#include "corank/report/html/page.h"
#include "corank/report/html/page_words.h"
#include "corank/result/values/tallies.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/model/display_name.h"
#include "corank/symbolic/writing/mathml.h"

namespace corank::report {
namespace {

using result::joined;
using result::Value;

std::string typeset(const std::string& text) { return symbolic::math(symbolic::mathml(symbolic::Expression(text))); }

/// "−3/5" or "√3/2" typeset; nothing where there is no short text.
std::string exact_html(const ExactPoint& point, int variable) {
  const auto text = result::exact_coordinate(point, variable);
  return text ? typeset(*text) : "";
}

/// "3π/4", or "cos: 3/5, sin: 4/5" behind the digits of the angle.
std::string exact_angle_html(const ExactPoint& point, const Value& v) {
  if (const auto text = result::multiple_of_pi(point, *v.angle, v.value)) return typeset(*text);
  const std::string cosine = exact_html(point, v.angle->cosine), sine = exact_html(point, v.angle->sine);
  if (cosine.empty() || sine.empty()) return digits_text(v.value);
  return digits_text(v.value) + " <small>cos: " + cosine + ", sin: " + sine + "</small>";
}

/// The coordinate of a point as well as it is known: exactly, in decimals, or between bounds.
std::string cell(const result::Result& result, const Value& v, std::size_t number) {
  const Cover& cover = result.cover;
  const ExactPoint* const point = exact_point(result, cover.points[number]);
  if (v.angle) return point ? exact_angle_html(*point, v) : digits_text(v.value);
  const bool has_decimals = number < cover.decimals.size() && !cover.decimals[number].empty();
  const std::string value =
      has_decimals ? symbolic::html_text(with_minus(cover.decimals[number][v.variable])) : digits_text(v.value);
  const std::string exact = point ? exact_html(*point, v.variable) : "";
  if (exact.empty()) return value;
  const bool is_decimal = value.find('[') == std::string::npos && value.find('.') == std::string::npos;
  return is_decimal ? exact : exact + " <small>" + value + "</small>";  // an integer needs no decimals
}

std::string exact_cell(const Value& v, const ExactPoint& point) {
  const auto text = [&point](int variable) {
    const std::string html = exact_html(point, variable);
    return html.empty() ? fmt::format("a number of degree {}", point.polynomial.size() - 1) : html;
  };
  return v.angle ? fmt::format("cos: {}, sin: {}", text(v.angle->cosine), text(v.angle->sine)) : text(v.variable);
}

std::string heads(const std::vector<Value>& shown) {
  return joined(
      shown, [](const Value& v) { return "<th>" + symbolic::html_name(v.name) + "</th>"; }, "");
}

/// Points where the kernel has dimension 2 or more.
std::string kernel_points_html(const result::Result& result, const std::vector<Value>& shown) {
  std::string rows;
  int number = 0;
  for (const ExactPoint& point : result.cover.exact_points) {
    if (point.corank < 2) continue;
    rows += fmt::format("<tr><td>{}</td>{}<td>{}</td></tr>", ++number,
                        joined(
                            shown, [&](const Value& v) { return "<td>" + exact_cell(v, point) + "</td>"; }, ""),
                        point.corank);
  }
  if (rows.empty()) return "";
  return fmt::format(
      "<p>At these points the kernel has a larger dimension. They are known exactly, and proven in exact arithmetic.</p>"
      "<div class=\"scroll\"><table><thead><tr><th>point</th>{}<th>kernel’s dimension</th></tr></thead><tbody>{}</tbody>"
      "</table></div>",
      heads(shown), rows);
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
  const std::vector<Value> shown = own_coordinates(result, result.configuration_size);
  std::string html = fmt::format("<section class=\"points\" data-set=\"{}\"><h3>{}</h3>", view.set->name, view.words.title);
  const std::vector<CoverBox>& points = result.cover.points;
  if (!points.empty()) {
    const bool types = result.cover.types.asked != 0;
    html += fmt::format("<div class=\"scroll\"><table><thead><tr><th>point</th>{}{}<th>verdict</th></tr></thead><tbody>",
                        heads(shown), types ? "<th>types</th>" : "");
    for (std::size_t k = 0; k < points.size(); ++k)
      html += fmt::format(
          "<tr data-point=\"{0}\"><td><button type=\"button\" class=\"show-point\">{1}</button></td>{2}{3}"
          "<td><span class=\"verdict {4}\">{4}</span></td></tr>",
          k, k + 1,
          joined(
              values(result, points[k], result.configuration_size),
              [&](const Value& v) { return "<td>" + cell(result, v, k) + "</td>"; }, ""),
          types ? types_cell(result.cover, points[k]) : "", to_string(points[k].verdict));
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
    const bool kernels = std::ranges::any_of(cover.exact_points, [](const ExactPoint& point) { return point.corank > 1; });
    if (isolated || kernels) html += table_html(view);
  }
  return html.empty() ? "<p>No set of this mechanism consists of isolated points.</p>" : html;
}

}  // namespace corank::report
