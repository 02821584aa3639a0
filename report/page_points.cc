#include "corank/report/page_points.h"

#include <fmt/format.h>

#include <algorithm>

#include "corank/certify/angle.h"
#include "corank/report/page_words.h"
#include "corank/symbolic/display_name.h"

namespace corank::report {
namespace {

using certify::Interval;

/// A coordinate of the model: a variable, or an angle with its cosine and sine.
struct Column {
  std::string name;
  int variable, sine = -1;
  Interval range{};
};

std::vector<Column> columns(const Result& result) {
  std::vector<Column> list;
  for (int i = 0; i < result.configuration_size; ++i) {
    const auto angle = std::find_if(result.angles.begin(), result.angles.end(),
                                    [i](const certify::Angle& a) { return a.cosine == i || a.sine == i; });
    if (angle == result.angles.end()) {
      list.push_back({result.variables[static_cast<std::size_t>(i)].name, i});
    } else if (i == std::min(angle->cosine, angle->sine)) {
      list.push_back({angle->name, angle->cosine, angle->sine, angle->range});
    }
  }
  return list;
}

std::string cell(const Column& column, const certify::CoverBox& point) {
  const auto at = [&point](int v) { return point.box[static_cast<std::size_t>(v)]; };
  if (column.sine < 0) return digits_text(at(column.variable));
  return digits_text(certify::angle_enclosure(at(column.variable), at(column.sine), column.range));
}

/// p(t) in HTML: "t<sup>2</sup> − 1/2".
std::string polynomial_html(const certify::RationalPolynomial& p) {
  std::string html;
  for (std::size_t k = p.size(); k-- > 0;) {
    if (p[k].is_zero()) continue;
    std::string coefficient = p[k].text();
    const bool negative = coefficient[0] == '-';
    if (negative) coefficient.erase(0, 1);
    const std::string power = k == 0 ? "" : k == 1 ? "<i>t</i>" : fmt::format("<i>t</i><sup>{}</sup>", k);
    html += html.empty() ? (negative ? "−" : "") : (negative ? " − " : " + ");
    html += k > 0 && coefficient == "1" ? power : coefficient + (power.empty() ? "" : " " + power);
  }
  return html.empty() ? "0" : html;
}

bool is_rational(const certify::ExactPoint& point) {
  return std::all_of(point.coordinates.begin(), point.coordinates.end(), [](const auto& c) { return c.size() <= 1; });
}

std::string exact_cell(const Column& column, const certify::ExactPoint& point) {
  const auto text = [&point](int v) {
    const certify::RationalPolynomial& p = point.coordinates[static_cast<std::size_t>(v)];
    return p.empty() ? std::string("–") : polynomial_html(p);
  };
  if (column.sine < 0) return text(column.variable);
  return fmt::format("cos = {}, sin = {}", text(column.variable), text(column.sine));
}

std::string exact_html(const Result& result, const std::vector<Column>& shown) {
  if (result.cover.exact_points.empty()) return "";
  std::string html = "<h4>Known exactly</h4><div class=\"scroll\"><table><thead><tr><th>point</th>";
  for (const Column& column : shown) html += "<th>" + symbolic::html_name(column.name) + "</th>";
  html += "<th>corank</th><th>where</th></tr></thead><tbody>";
  std::size_t number = 0;
  for (const certify::ExactPoint& point : result.cover.exact_points) {
    html += fmt::format("<tr><td>{}</td>", ++number);
    for (const Column& column : shown) html += "<td>" + exact_cell(column, point) + "</td>";
    html +=
        fmt::format("<td>{}</td><td>{}</td></tr>", point.corank < 0 ? "–" : std::to_string(point.corank),
                    is_rational(point) ? "rational"
                                       : fmt::format("{} = 0, {} &lt; <i>t</i> &lt; {}", polynomial_html(point.polynomial),
                                                     point.lower.text(), point.upper.text()));
  }
  return html + "</tbody></table></div>";
}

std::string table_html(const Result& result) {
  const std::vector<Column> shown = columns(result);
  std::string html = fmt::format("<section class=\"points\" data-set=\"{}\"><h3>{}</h3>", result.set, set_title(result.set));
  if (!result.cover.points.empty()) {
    html += "<div class=\"scroll\"><table><thead><tr><th>point</th>";
    for (const Column& column : shown) html += "<th>" + symbolic::html_name(column.name) + "</th>";
    html += "<th>verdict</th></tr></thead><tbody>";
    std::size_t number = 0;
    for (const certify::CoverBox& point : result.cover.points) {
      html += fmt::format("<tr data-point=\"{}\"><td><button type=\"button\" class=\"show-point\">{}</button></td>", number,
                          number + 1);
      ++number;
      for (const Column& column : shown) html += "<td>" + cell(column, point) + "</td>";
      html += fmt::format("<td><span class=\"verdict {0}\">{0}</span></td></tr>", to_string(point.verdict));
    }
    html += "</tbody></table></div>";
  }
  return html + exact_html(result, shown) + "</section>";
}

}  // namespace

std::string points_html(const std::vector<Result>& results) {
  std::string html;
  for (const Result& result : results) {
    const bool isolated = result.cover.dimension == 0 && !result.cover.points.empty();
    if (isolated || !result.cover.exact_points.empty()) html += table_html(result);
  }
  return html.empty() ? "<p>None: no set of this mechanism consists of isolated points.</p>" : html;
}

}  // namespace corank::report
