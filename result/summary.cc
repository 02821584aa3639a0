#include "corank/result/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "corank/certify/algebraic_number.h"
#include "corank/certify/angle.h"
#include "corank/result/domain_notes.h"
#include "corank/result/exact_angle.h"
#include "corank/result/motion_words.h"
#include "corank/symbolic/singularity_system.h"

namespace corank::result {
namespace {
using Json = nlohmann::ordered_json;

constexpr std::array kVerdictsInOrder{Verdict::regular, Verdict::isolated,  Verdict::exact,  Verdict::boundary,
                                      Verdict::partial, Verdict::undecided, Verdict::pending};
static_assert(kVerdictsInOrder.size() == kVerdicts);

// glibc's printf rounds decimals in the current rounding mode (exactly, at any number of digits).
std::string decimal(double x, int digits, int rounding_mode) {
  const int former = std::fegetround();
  std::fesetround(rounding_mode);
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.*g", digits, x == 0 ? 0.0 : x);
  std::fesetround(former);
  return text.data();
}

struct Value {
  std::string name;
  Interval value;
  int variable;  ///< −1: an angle
  const Angle* angle = nullptr;
};

const ExactPoint* exact_point(const Result& result, const CoverBox& box) {
  return box.point < 0 ? nullptr : &result.cover.exact_points[static_cast<std::size_t>(box.point)];
}

// The box in the model's own coordinates: an angle stands in place of its cosine and sine, in the order of the variables.
std::vector<Value> values(const Result& result, const CoverBox& box, int variables) {
  std::vector<Value> values;
  for (int i = 0; i < variables; ++i) {
    const auto has = [i](const Angle& a) { return a.cosine == i || a.sine == i; };
    const auto angle = std::find_if(result.angles.begin(), result.angles.end(), has);
    const auto at = [&box](int v) { return box.box[static_cast<std::size_t>(v)]; };
    if (angle == result.angles.end()) {
      values.push_back({result.variables[static_cast<std::size_t>(i)].name, at(i), i});
    } else if (i == std::min(angle->cosine, angle->sine)) {
      values.push_back(
          {angle->name, certify::angle_enclosure(at(angle->cosine), at(angle->sine), angle->range), -1, &*angle});
    }
  }
  return values;
}

std::string plural(std::size_t n, const std::string& word) {
  const std::string many = word.back() == 'y'   ? word.substr(0, word.size() - 1) + "ies"
                           : word.back() == 'x' ? word + "es"
                                                : word + "s";
  return fmt::format("{} {}", n, n == 1 ? word : many);
}

// A coordinate of an exact point as well as a short text can say it.
std::string exact_text(const ExactPoint& point, const Value& v, int digits) {
  if (v.angle) return exact_angle(point, *v.angle, v.value).value_or(outward_text(v.value, digits));
  if (const auto text = exact_coordinate(point, v.variable)) return *text;
  const RationalPolynomial& x = point.coordinates[static_cast<std::size_t>(v.variable)];
  if (x.empty()) return outward_text(v.value, digits);
  try {
    return outward_text(certify::AlgebraicNumber(point.polynomial, point.lower, point.upper).enclose(x), digits);
  } catch (const std::invalid_argument&) {  // what a file says of it defines no number
    return outward_text(v.value, digits);
  } catch (const std::domain_error&) {  // numbers of too many bits
    return outward_text(v.value, digits);
  }
}

std::string points_table(const Result& result) {
  constexpr int kDigits = 9;
  constexpr std::size_t kMostRows = 1000;
  std::vector<std::vector<std::string>> rows(1);
  rows[0].push_back("point");
  for (const CoverBox& point : result.cover.points) {
    if (rows.size() > kMostRows) break;
    rows.push_back({std::to_string(rows.size())});
    for (const Value& v : values(result, point, result.configuration_size)) {
      if (rows.size() == 2) rows[0].push_back(v.name);
      const ExactPoint* exact = exact_point(result, point);
      rows.back().push_back(exact ? exact_text(*exact, v, kDigits) : outward_text(v.value, kDigits));
    }
    rows.back().push_back(to_string(point.verdict));
  }
  rows[0].push_back("verdict");
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("  {:>{}}", row[0], widths[0]);
    for (std::size_t c = 1; c + 1 < row.size(); ++c) text += fmt::format("  {:<{}}", row[c], widths[c]);
    text += fmt::format("  {}\n", row.back());
  }
  if (const std::size_t shown = rows.size() - 1; shown < result.cover.points.size())
    text +=
        fmt::format("  and {} more, which the result file and the JSON summary hold\n", result.cover.points.size() - shown);
  return text;
}

// Each point's configuration in proven decimals.
std::string decimals_text(const Result& result) {
  const Cover& cover = result.cover;
  std::string text = "\ndecimals, each wrong by less than a unit of its last digit\n";
  for (std::size_t i = 0; i < cover.decimals.size(); ++i) {
    text += fmt::format("  point {}\n", i + 1);
    if (cover.decimals[i].empty()) text += "    not proven\n";
    for (int v = 0; v < result.configuration_size && !cover.decimals[i].empty(); ++v)
      text += fmt::format("    {} = {}\n", result.variables[static_cast<std::size_t>(v)].name,
                          cover.decimals[i][static_cast<std::size_t>(v)]);
  }
  return text;
}

// Boxes by the bound of the kernel's dimension; without the undecided boxes that may hold no solution.
struct KernelTally {
  std::map<int, std::size_t> at_most;
  std::size_t larger = 0;     // with a bound above the corank that was asked for
  std::size_t explained = 0;  // of these, with a point where the dimension is known to be above 1
  std::size_t known = 0;      // of the others, likewise: the corank asked for was above 1
};

KernelTally kernel_tally(const Result& result) {
  KernelTally tally;
  for (const CoverBox& box : result.cover.boxes) {
    const ExactPoint* point = exact_point(result, box);
    if (box.corank < 0 || (box.verdict == Verdict::undecided && !point)) continue;
    ++tally.at_most[box.corank];
    const bool larger = box.corank > result.options.corank;
    tally.larger += larger;
    if (point && point->corank > 1) ++(larger ? tally.explained : tally.known);
  }
  return tally;
}

// What is known of the kernel's dimension, and the points where it is 2 or more.
std::string kernel_text(const Result& result) {
  const auto [at_most, larger, explained, known] = kernel_tally(result);
  const int least = result.options.corank;
  if (at_most.empty()) return "";
  std::string text = "\nkernel:";
  const char* between = "";
  for (const auto& [bound, n] : at_most) {
    text += bound <= least ? fmt::format(" dimension {} in {}", least, plural(n, "box"))
                           : fmt::format("{} at most {} in {}", between, bound, n);
    between = ",";
  }
  text += "\n";
  const auto points = std::count_if(result.cover.exact_points.begin(), result.cover.exact_points.end(),
                                    [](const ExactPoint& p) { return p.corank > 1; });
  if (known > 0) text += fmt::format("  a configuration where this is proven lies in {} of them:\n", known);
  if (explained > 0)
    text +=
        fmt::format("  {} of these hold {} where it is proven:\n", explained == larger ? "all" : std::to_string(explained),
                    points == 1 ? "the point" : fmt::format("one of {} points", points));
  int number = 0;
  for (const ExactPoint& point : result.cover.exact_points) {
    if (point.corank < 2) continue;
    text += fmt::format("  {}: dimension {} at", ++number, point.corank);
    const char* comma = " ";
    for (int v = 0; v < result.configuration_size; ++v) {
      text += fmt::format(
          "{}{} = {}", comma, result.variables[static_cast<std::size_t>(v)].name,
          exact_coordinate(point, v).value_or("a number of degree " + std::to_string(point.polynomial.size() - 1)));
      comma = ", ";
    }
    text += "\n";
  }
  if (larger > explained)
    text += fmt::format("  whether it is larger than {} anywhere in {} is not known\n", least,
                        plural(larger - explained, "other box"));
  return text;
}

std::string found_ranges_text(const Result& result) {
  constexpr int kDigits = 6;
  std::string text = "ranges found from the equations:";
  for (const int j : result.domain.found) {
    const ResultVariable& v = result.variables[static_cast<std::size_t>(j)];
    text += fmt::format("{} {} in [{:.{}g}, {:.{}g}]", j == result.domain.found.front() ? "" : ",", v.name, v.domain.lo(),
                        kDigits, v.domain.hi(), kDigits);  // few digits by themselves, enclosed
  }
  return text + "\n";
}

// What keeps `boundary` boxes from being regular or isolated.
std::string boundary_text(const DomainNotes& notes) {
  std::string text = "  boundary: not shown to be inside";
  for (const DomainNotes::Reason& reason : notes.boundary)
    text += fmt::format("{} {} ({})", &reason == notes.boundary.data() ? "" : ",", reason.text, reason.boxes);
  return text + "\n";
}

std::string seconds_text(const Cover& cover) {
  const Statistics& s = cover.statistics;
  return fmt::format("\n{:.3f} s: search {:.3f} s, certify {:.3f} s\n", s.seconds_total, s.seconds_search,
                     s.seconds_certify);
}

}  // namespace

std::string outward_text(const Interval& x, int digits) {
  constexpr double kNothing = 1e-12;  // nobody wants to read 9.88131292e-324
  const auto outward = [](double far) { return 0 < far && far < kNothing ? kNothing : far; };
  const auto inward = [](double near) { return 0 < near && near < kNothing ? 0 : near; };
  const double lo = x.lo() < 0 ? -outward(-x.lo()) : inward(x.lo()), hi = x.hi() > 0 ? outward(x.hi()) : -inward(-x.hi());
  const std::string lower = decimal(lo, digits, FE_DOWNWARD), upper = decimal(hi, digits, FE_UPWARD);
  return lower == upper ? lower : "[" + lower + ", " + upper + "]";
}

std::map<Reason, std::size_t> undecided_reasons(const Cover& cover) {
  std::map<Reason, std::size_t> reasons;
  for (const CoverBox& box : cover.boxes)
    if (box.verdict == Verdict::undecided) ++reasons[box.reason];
  return reasons;
}

namespace {

std::string sigma_text(const Sigma& sigma) {
  if (sigma.length == sigma.angle) return fmt::format("sigma {:g}", sigma.length);
  return fmt::format("sigma {:g} in lengths, {:g} in sines and cosines", sigma.length, sigma.angle);
}

}  // namespace

std::string along_set_text(const Cover& cover) {
  if (cover.observed_dimension <= cover.dimension) return "along a curve, or a larger set, of degenerate solutions";
  return fmt::format("along a set of dimension {}, as samples show, larger than expected; not proven: {}",
                     cover.observed_dimension,
                     cover.self_motions.empty() ? "no linear relations were found on it that make its equations dependent"
                                                : "the linear relations that were found do not prove it there");
}

namespace {

std::string in_words(Reason reason, const Cover& cover) {
  using enum Reason;
  switch (reason) {
    case none: break;
    case degenerate_point: return "next to a degenerate solution, where the Jacobian has not its full rank";
    case degenerate_set: return along_set_text(cover);
    case tolerance: return "the coefficients' tolerance moves the solutions too far";
    case precision: return "doubles divide them no further";
    case limit: return "a limit ended the search before they were divided further";
  }
  return "reason unknown";
}

std::size_t boxes_on(const Cover& cover, std::size_t motion) {
  return static_cast<std::size_t>(std::count_if(cover.boxes.begin(), cover.boxes.end(), [motion](const CoverBox& box) {
    return box.motion == static_cast<int>(motion);
  }));
}

std::string motions_text(const Result& result) {
  std::string text;
  for (std::size_t k = 0; k < result.cover.self_motions.size(); ++k)
    text += fmt::format("larger than expected, in {}: {}\n", plural(boxes_on(result.cover, k), "box"),
                        motion_sentence(result, k));
  return text;
}

std::string reasons_text(const Cover& cover) {
  std::string text;
  for (const auto& [reason, n] : undecided_reasons(cover))
    text += fmt::format("  undecided, {}: {}\n", n, in_words(reason, cover));
  return text;
}

}  // namespace

std::string to_table(const Result& result) {
  const Cover& cover = result.cover;
  std::string text = fmt::format(
      "{}, {}: {}, {}, {}; dimension {}\n", result.model, symbolic::set_with_corank(result.set, result.options.corank),
      plural(result.variables.size(), "variable"), plural(static_cast<std::size_t>(result.equations), "equation"),
      plural(static_cast<std::size_t>(result.inequalities), "inequality"), cover.dimension);
  text += fmt::format("{}{}{}\n", sigma_text(cover.sigma), result.options.kernel.empty() ? "" : ", kernel ",
                      result.options.kernel);
  if (!result.domain.found.empty()) text += found_ranges_text(result);
  text += cover.complete() ? "complete: every solution in the search domain is in a box\n"
                           : "INCOMPLETE: the search ended early; solutions may also be in the pending boxes\n";
  if (!result.stopped.empty()) text += fmt::format("stopped by {}\n", result.stopped);
  for (const std::string& sentence : range_end_sentences(result.domain)) text += sentence + "\n";
  if (cover.boxes.empty()) {
    text += fmt::format("\nnone: there is no solution in the search domain   ({} processed)\n", cover.statistics.processed);
    return text + seconds_text(cover);
  }
  text += fmt::format("\n  {:<10}  {:>10}\n", "verdict", "boxes");
  const auto boxes_with = cover.counts();
  for (const Verdict verdict : kVerdictsInOrder) {
    if (const std::size_t n = boxes_with[static_cast<std::size_t>(verdict)]; n > 0)
      text += fmt::format("  {:<10}  {:>10}\n", to_string(verdict), n);
  }
  text += fmt::format("  {:<10}  {:>10}   ({} processed)\n", "all", cover.boxes.size(), cover.statistics.processed);
  text += reasons_text(cover);
  if (result.seems_of_corank > result.options.corank)
    text += fmt::format("    the kernel there seems to have dimension {0}: try --corank {0}\n", result.seems_of_corank);
  text += motions_text(result);
  if (!result.domain.boundary.empty()) text += boundary_text(result.domain);
  if (const std::size_t wide = cover.wider_than_sigma; wide > 0) {
    text += fmt::format("  {} wider than sigma: {}\n", wide,
                        !result.stopped.empty() ? "the search ended before they were cut"
                        : cover.tolerance > 0
                            ? "the tolerance keeps proven boxes from narrowing"
                            : "cutting them makes them no narrower, they are at the end of what doubles resolve");
  }
  if (cover.tolerance > 0) {
    const bool over_determined = static_cast<std::size_t>(result.equations) > result.variables.size();
    text += fmt::format(
        "\n{} within a relative tolerance of {:g};\n",
        over_determined ? "more equations than variables: coefficients that are no integers are taken as they are written\n"
                          "where the equations then fit each other, else"
                        : "coefficients that are no integers are taken",
        cover.tolerance / kPartialTolerance);
    text += over_determined ? fmt::format(
                                  "partial: proven for independent equations, on the piece the others hold within {:g} "
                                  "(relative to their coefficients)\n",
                                  cover.tolerance)
                            : "what a verdict says holds for every choice of them\n";
  }
  if (cover.dimension == 0) {
    std::array<std::size_t, kVerdicts> points_with{};
    for (const CoverBox& point : cover.points) ++points_with[static_cast<std::size_t>(point.verdict)];
    std::string kinds;
    for (const Verdict verdict : kVerdictsInOrder) {
      const std::size_t n = points_with[static_cast<std::size_t>(verdict)];
      if (n > 0) kinds += fmt::format("{}{} {}", kinds.empty() ? ": " : ", ", n, to_string(verdict));
    }
    text += fmt::format("\n{}{}\n", plural(cover.points.size(), "point"), kinds);
    if (!cover.points.empty()) text += points_table(result);
    if (!cover.decimals.empty()) text += decimals_text(result);
  }
  text += kernel_text(result);
  return text + seconds_text(cover);
}

namespace {

// The coordinates of an exact point that have a short text.
Json exact_json(const Result& result, const ExactPoint& point) {
  Json json = Json::object();
  for (std::size_t v = 0; v < result.variables.size(); ++v)
    if (const auto text = exact_coordinate(point, static_cast<int>(v))) json[result.variables[v].name] = *text;
  return json;
}

// The same as kernel_text.
Json kernel_json(const Result& result) {
  const KernelTally tally = kernel_tally(result);
  if (tally.at_most.empty()) return Json();
  Json json = {{"at_most", Json::object()}, {"points", Json::array()}};
  for (const auto& [bound, n] : tally.at_most) json["at_most"][std::to_string(bound)] = n;
  for (const ExactPoint& point : result.cover.exact_points)
    if (point.corank > 1) json["points"].push_back({{"dimension", point.corank}, {"exact", exact_json(result, point)}});
  return json;
}

}  // namespace

std::string to_json(const Result& result) {
  const Cover& cover = result.cover;
  Json json;
  json["model"] = result.model;
  json["set"] = result.set;
  json["corank"] = result.options.kernel.empty() ? Json() : Json(result.options.corank);
  json["system"] = {{"variables", result.variables.size()},
                    {"equations", result.equations},
                    {"inequalities", result.inequalities},
                    {"dimension", cover.dimension}};
  Json constants = Json::object();
  for (const ConstantOverride& c : result.options.constants) constants[c.name] = c.expression;
  json["options"] = {{"kernel", result.options.kernel.empty() ? Json() : Json(result.options.kernel)},
                     {"sigma", result.options.sigma.largest()},
                     {"sigma_length", result.options.sigma.length},
                     {"sigma_angle", result.options.sigma.angle},
                     {"kernel_scales", result.options.kernel_scales},
                     {"tolerance", result.options.tolerance},
                     {"threads", result.options.threads},
                     {"max_boxes", result.options.max_boxes},
                     {"max_solutions", result.options.max_solutions},
                     {"time_limit", result.options.time_limit},
                     {"constants", constants}};
  json["complete"] = cover.complete();
  json["stopped"] = result.stopped.empty() ? Json() : Json(result.stopped);
  json["boxes"]["processed"] = cover.statistics.processed;
  const auto counts = cover.counts();
  for (const Verdict verdict : kVerdictsInOrder)
    json["boxes"][to_string(verdict)] = counts[static_cast<std::size_t>(verdict)];
  json["undecided_reasons"] = Json::object();
  for (const auto& [reason, n] : undecided_reasons(cover)) json["undecided_reasons"][to_string(reason)] = n;
  json["observed_dimension"] = cover.observed_dimension > 0 ? Json(cover.observed_dimension) : Json();
  json["seems_of_corank"] = result.seems_of_corank > 0 ? Json(result.seems_of_corank) : Json();
  json["self_motions"] = Json::array();
  for (std::size_t k = 0; k < cover.self_motions.size(); ++k) {
    Json relations = Json::array();
    for (const Polynomial& f : cover.self_motions[k].relations) relations.push_back(relation_text(result, f));
    json["self_motions"].push_back({{"dimension", cover.self_motions[k].dimension},
                                    {"boxes", boxes_on(cover, k)},
                                    {"relations", relations},
                                    {"text", motion_sentence(result, k)}});
  }
  json["boundary_reasons"] = Json::array();
  for (const DomainNotes::Reason& reason : result.domain.boundary)
    json["boundary_reasons"].push_back({{"reason", reason.text}, {"boxes", reason.boxes}});
  json["range_ends"] = Json::array();
  for (const DomainNotes::End& end : result.domain.ends)
    json["range_ends"].push_back({{"variable", end.coordinate}, {"reached", end.reached}});
  json["ranges_found"] = Json::object();
  for (const int j : result.domain.found) {
    const ResultVariable& v = result.variables[static_cast<std::size_t>(j)];
    json["ranges_found"][v.name] = {{"lo", v.domain.lo()}, {"hi", v.domain.hi()}};
  }
  json["points"] = nullptr;
  if (cover.dimension == 0) {
    json["points"] = Json::array();
    for (const CoverBox& point : cover.points) {
      Json entry = {{"values", Json::object()}, {"verdict", to_string(point.verdict)}};
      for (const Value& v : values(result, point, static_cast<int>(result.variables.size()))) {
        entry["values"][v.name] = {{"lo", v.value.lo()}, {"hi", v.value.hi()}};
      }
      if (const ExactPoint* exact = exact_point(result, point)) entry["exact"] = exact_json(result, *exact);
      const std::size_t i = static_cast<std::size_t>(&point - cover.points.data());
      if (i < cover.decimals.size() && !cover.decimals[i].empty())
        for (std::size_t v = 0; v < result.variables.size(); ++v)
          entry["decimals"][result.variables[v].name] = cover.decimals[i][v];
      json["points"].push_back(std::move(entry));
    }
  }
  json["kernel"] = kernel_json(result);
  json["seconds"] = {{"total", cover.statistics.seconds_total},
                     {"search", cover.statistics.seconds_search},
                     {"certify", cover.statistics.seconds_certify}};
  json["version"] = result.version;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::result
