#include "corank/report/html/path_page.h"

#include <fmt/format.h>

#include <numbers>

#include "corank/result/values/tallies.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/model/display_name.h"

namespace corank::report {
namespace {

using analyze::Avoid;
using analyze::Path;
using symbolic::html_name;

/// "forward or inverse singularity".
std::string one_avoided(Avoid avoid) {
  if (avoid == Avoid::requirements) return "limit of a requirement";
  return std::string(avoid == Avoid::both ? "forward or inverse" : to_string(avoid)) + " singularity";
}

std::string number(double value, int digits = 4) { return with_minus(fmt::format("{:.{}g}", value, digits)); }

/// What bounds the configurations, but for what the equations imply: "the limits of θ₂, the ranges of J_3x and 2
/// inequalities".
std::string bounds_of(const symbolic::Mechanism& mechanism, const System& system) {
  std::vector<std::string> limits, ranges, parts;
  for (const symbolic::Limit& limit : mechanism.limits()) limits.push_back(limit.coordinate);
  for (const Variable& v : system.variables)
    if (v.kind == VariableKind::length && !v.auxiliary && !(v.lower_implied && v.upper_implied)) ranges.push_back(v.name);
  for (const Angle& a : system.angles)
    if (a.range.width() < 2 * std::numbers::pi - 1e-9) ranges.push_back(a.name);
  if (!limits.empty()) parts.push_back("the limits of " + names_html(limits));
  if (!ranges.empty()) parts.push_back("the ranges of " + names_html(ranges));
  const std::size_t inequalities = result::how_many(mechanism.constraints(), [](const symbolic::Constraint& c) {
    return c.relation.kind != symbolic::Relation::Kind::equal;
  });
  if (inequalities > 0) parts.push_back(result::counted(inequalities, "inequality"));
  return result::listed(parts);
}

std::string kept_rank(Avoid avoid) {
  const std::string y = "<i>L<sub>y</sub></i>", z = "<i>L<sub>z</sub></i>";
  if (avoid == Avoid::requirements) return "<i>R</i>";
  return avoid == Avoid::forward ? y : avoid == Avoid::inverse ? z : y + " and " + z;
}

/// Where the model's own coordinates stand among the view's.
std::vector<std::size_t> shown_in(const PathView& view, const symbolic::Mechanism& mechanism) {
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < view.names.size(); ++k)
    for (const symbolic::Coordinate& c : mechanism.coordinates())
      if (c.name == view.names[k] && !c.auxiliary) shown.push_back(k);
  return shown;
}

void say_of_a_path(const symbolic::Mechanism& mechanism, const PathView& view, PathWords& words) {
  const Tube& tube = *view.path.tube;
  const std::size_t n = tube.pieces.size();
  words.finding = "There is a path, proven from end to end.";
  if (view.cuspidal) {
    const char* const ends =
        view.avoid == Avoid::forward ? "two poses for the same values of its motors" : "two postures at the same pose";
    words.finding = fmt::format("This robot is cuspidal: a path joins {}, proven from end to end.", ends);
  }
  const std::string test = "a Newton test with one parameter proves one lift onto C-space";
  words.proven.push_back("The path is unbroken from the start to the end: " +
                         (n == 1 ? test : fmt::format("it has {} pieces that meet, and in each {}", grouped(n), test)) +
                         ".");
  words.proven.push_back(fmt::format("The path meets no {}: {} full rank on all of it.", one_avoided(view.avoid),
                                     kept_rank(view.avoid) + (view.avoid == Avoid::both ? " have" : " has")));
  if (const std::string bounds = bounds_of(mechanism, view.system); !bounds.empty())
    words.proven.push_back(fmt::format("It keeps to {}.", bounds));
  if (const double radius = tube.radius(); radius > 0) {
    const std::optional<double> length = analyze::length_size(view.system, tube);
    words.proven.push_back(fmt::format(
        "The same holds around the path: for every configuration whose sines and cosines of angles differ by at most {} "
        "from those of a point of the path{}.",
        number(radius, 3), length ? ", and whose lengths differ by at most " + number(radius * *length, 3) : ""));
  }
  if (view.radius_asked > tube.radius())
    words.unproven.push_back(fmt::format("The path does not have the requested radius, {}.", number(view.radius_asked, 3)));
  words.unproven.push_back(
      "The path may not be the shortest, and the distance from singularities may be larger than the radius.");
}

}  // namespace

PathWords path_words(const symbolic::Mechanism& mechanism, const PathView& view) {
  PathWords words;
  words.kicker = fmt::format("{} without {}", view.cuspidal ? "Cuspidal: a path" : "A path", in_words(view.avoid));
  const std::string& reason = symbolic::html_text(view.path.reason);
  switch (view.path.status) {
    case Path::Status::path: say_of_a_path(mechanism, view, words); break;
    case Path::Status::separated:
      words.finding = "It is proven that there is no such path.";
      words.proven.push_back(fmt::format("The two configurations lie in different pieces of C-space without {}: {}.",
                                         in_words(view.avoid), reason));
      words.proven.push_back(fmt::format("Every motion from one to the other passes {} {}, or leaves the ranges.",
                                         view.avoid == Avoid::inverse ? "an" : "a", one_avoided(view.avoid)));
      break;
    case Path::Status::unknown:
      words.finding = "corank found neither a path nor a proof that there is no path.";
      words.unproven.push_back(fmt::format("It is open whether a path joins the two configurations: {}.", reason));
      break;
  }
  return words;
}

std::string values_html(const PathView& view, const std::vector<double>& values, const symbolic::Mechanism& mechanism) {
  return result::joined(shown_in(view, mechanism), [&](std::size_t k) {
    return fmt::format("<span class=\"constant\">{} = {}</span>", html_name(view.names[k]), number(values[k]));
  });
}

std::string signs_html(const PathView& view) {
  if (view.signs[0].empty()) return "";
  const auto sign = [](int s) { return s > 0 ? "+" : s < 0 ? "−" : "not proven"; };
  std::string html =
      "<div class=\"scroll\"><table class=\"signs\"><thead><tr><th>function</th><th>start</th><th>end</th></tr></thead>"
      "<tbody>";
  for (std::size_t k = 0; k < view.signs[0].size(); ++k) {
    const auto &a = view.signs[0][k], &b = view.signs[1][k];
    const std::string matrix = a.of == Avoid::requirements ? "det <i>R</i>"
                               : a.of == Avoid::forward    ? "det <i>L<sub>y</sub></i>"
                                                           : "det <i>L<sub>z</sub></i>";
    const std::string meaning = a.of == Avoid::requirements ? " <small>0 where a requirement reaches its limit</small>" : "";
    const bool unlike = a.sign * b.sign < 0;
    html += fmt::format("<tr{}><th>{}</th><td>{}</td><td>{}</td></tr>", unlike ? " class=\"unlike\"" : "",
                        a.factor.empty() ? matrix + meaning
                                         : fmt::format("<code>{}</code> <small>a factor of {}</small>",
                                                       symbolic::html_text(a.factor), matrix),
                        sign(a.sign), sign(b.sign));
  }
  return html + "</tbody></table></div>";
}

std::string waypoints_html(const PathView& view, const symbolic::Mechanism& mechanism) {
  if (view.nodes.empty()) return "";
  const std::vector<std::size_t> shown = shown_in(view, mechanism);
  std::string html = "<div class=\"scroll\"><table class=\"waypoints\"><thead><tr><th></th>";
  html += result::joined(
      shown, [&](std::size_t k) { return "<th>" + html_name(view.names[k]) + "</th>"; }, "");
  html += "<th>radius of the piece that follows</th></tr></thead><tbody>";
  for (std::size_t i = 0; i < view.nodes.size(); ++i) {
    html += fmt::format("<tr data-node=\"{}\"><th>{}</th>", i, i + 1);
    for (const std::size_t k : shown) html += "<td>" + number(view.nodes[i][k]) + "</td>";
    const std::vector<double>& radii = view.path.tube->radii;
    html += fmt::format("<td>{}</td></tr>", i < radii.size() ? number(radii[i], 3) : "");
  }
  return html + "</tbody></table></div>";
}

}  // namespace corank::report
