#include "corank/result/values/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "corank/certify/algebraic_number.h"
#include "corank/result/values/sentences.h"
#include "corank/result/values/tallies.h"
#include "corank/result/values/words.h"

namespace corank::result {
namespace {

// A coordinate of an exact point as well as a short text can say it.
std::string exact_text(const ExactPoint& point, const Value& v, int digits) {
  if (v.angle) return exact_angle(point, *v.angle, v.value).value_or(outward_text(v.value, digits));
  if (const auto text = exact_coordinate(point, v.variable)) return *text;
  const RationalPolynomial& x = point.coordinates[v.variable];
  try {
    if (!x.empty())
      return outward_text(certify::AlgebraicNumber(point.polynomial, point.lower, point.upper).enclose(x), digits);
  } catch (const std::invalid_argument&) {  // what a file says of it defines no number
  } catch (const std::domain_error&) {      // numbers of too many bits
  }
  return outward_text(v.value, digits);
}

// "types: RO in 8 boxes, RPM in 4 boxes; unproven in 0".
std::string types_text(const Cover& cover) {
  const TypeTally tally = type_tally(cover);
  if (tally.proven.empty() || cover.boxes.empty()) return "";
  std::vector<std::string> found;
  for (const auto& [type, n] : tally.proven)
    if (n > 0) found.push_back(fmt::format("{} in {}", to_string(type), counted(n, "box")));
  if (tally.unproven > 0) found.push_back("unproven in " + counted(tally.unproven, "box"));
  if (found.empty()) found.push_back("no box has one of the requested types");
  std::string text = fmt::format("\ntypes: {}\n", fmt::join(found, ", "));
  if (cover.types.left_out > 0)
    text += fmt::format("  {} of the kernel's set left out: no solution in {} has the set's type\n",
                        counted(cover.types.left_out, "box"), cover.types.left_out == 1 ? "it" : "them");
  return text;
}

// Of a set of dimension 0.
std::string types_of(const Cover& cover, const CoverBox& point) {
  if (!holds_a_solution(point)) return "?";
  const std::string names = fmt::format("{}", fmt::join(type_names(point.types.proven), " "));
  return names + (point.types.settle(cover.types.of_set) ? "" : names.empty() ? "?" : " ?");
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
    if (result.cover.types.asked != 0) rows.back().push_back(types_of(result.cover, point));
    rows.back().push_back(to_string(point.verdict));
  }
  if (result.cover.types.asked != 0) rows[0].push_back("types");
  rows[0].push_back("verdict");
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("  {:>{}}", row[0], widths[0]);
    for (std::size_t c = 1; c + 1 < row.size(); ++c) text += fmt::format("  {:<{}}", row[c], widths[c]);
    text += fmt::format("  {}\n", row.back());
  }
  if (const std::size_t shown = rows.size() - 1; shown < result.cover.points.size())
    text += fmt::format("  and {} more: see the result file or the JSON summary\n", result.cover.points.size() - shown);
  return text;
}

// Each point's configuration in proven decimals.
std::string decimals_text(const Result& result) {
  const Cover& cover = result.cover;
  std::string text = "\ndecimals, each wrong by less than a unit of its last digit\n";
  for (std::size_t i = 0; i < cover.decimals.size(); ++i) {
    text += fmt::format("  point {}\n", i + 1);
    if (cover.decimals[i].empty()) text += "    not proven\n";
    const std::size_t shown = cover.decimals[i].empty() ? 0 : result.configuration_size;
    for (std::size_t v = 0; v < shown; ++v)
      text += fmt::format("    {} = {}\n", result.variables[v].name, cover.decimals[i][v]);
  }
  return text;
}

// What is known of the kernel's dimension, and the points where it is 2 or more.
std::string kernel_text(const Result& result) {
  const auto [at_most, larger, explained, known] = kernel_tally(result);
  const int least = result.options.corank;
  if (at_most.empty()) return "";
  std::string text = fmt::format("\nkernel: {}\n", joined(at_most, [least](const auto& tally) {
                                   const auto& [bound, n] = tally;
                                   return bound <= least ? fmt::format("dimension {} in {}", least, counted(n, "box"))
                                                         : fmt::format("at most {} in {}", bound, n);
                                 }));
  const std::size_t points = how_many(result.cover.exact_points, [](const ExactPoint& p) { return p.corank > 1; });
  if (known > 0) text += fmt::format("  in {} of them dimension {} is proven at a point:\n", known, least);
  if (explained > 0) {
    const std::string holds = larger == 1           ? "this box holds"
                              : explained == larger ? fmt::format("each of these {} boxes holds", larger)
                                                    : fmt::format("{} of these {} boxes hold", explained, larger);
    text += fmt::format("  {} {} where a larger dimension is proven:\n", holds,
                        points == 1 ? "the point" : fmt::format("one of {} points", points));
  }
  int number = 0;
  for (const ExactPoint& point : result.cover.exact_points) {
    if (point.corank < 2) continue;
    const auto coordinate = [&](const ResultVariable& v) {
      const auto exact = exact_coordinate(point, static_cast<int>(&v - result.variables.data()));
      return v.name + " = " + exact.value_or("a number of degree " + std::to_string(point.polynomial.size() - 1));
    };
    text += fmt::format("  {}: dimension {} at {}\n", ++number, point.corank,
                        joined(std::span(result.variables).first(result.configuration_size), coordinate));
  }
  if (larger > explained)
    text += fmt::format("  it is not known whether the dimension is larger than {} anywhere in {}\n", least,
                        counted(larger - explained, "other box"));
  return text;
}

std::string found_ranges_text(const Result& result) {
  return "ranges found from the equations: " +
         joined(result.domain.found,
                [&](int j) {
                  const ResultVariable& v = result.variables[j];
                  return fmt::format("{} in [{:.6g}, {:.6g}]", v.name, v.domain.lo(), v.domain.hi());
                }) +
         "\n";
}

// What keeps `boundary` boxes from being regular or isolated.
std::string boundary_text(const DomainNotes& notes) {
  return "  boundary: may reach beyond " +
         joined(notes.boundary,
                [](const DomainNotes::Reason& reason) { return fmt::format("{} ({})", reason.text, reason.boxes); }) +
         "\n";
}

// Of a workspace boundary: where the output can pass.
std::string passages_text(const Result& result) {
  if (result.outputs.empty()) return "";
  const auto counts = passages(result.cover);
  const std::array kinds{Passage::barrier, Passage::traversable, Passage::unproven};
  return fmt::format("\nin the space of {}: {} {}\n", fmt::join(result.outputs, ", "),
                     joined(kinds,
                            [&](Passage passage) {
                              return fmt::format("{} in {}", to_string(passage), counts[static_cast<std::size_t>(passage)]);
                            }),
                     noun(counts[static_cast<std::size_t>(Passage::unproven)], "box"));
}

// What of each part of a set was found.
std::string parts_text(const Result& result) {
  if (result.parts.empty()) return "";
  std::string text;  // those of a boundary stand below its passages
  if (result.outputs.empty())
    text = result.parts.size() == 1 && result.parts[0].condition.empty() && !left_out(result.parts[0]).empty()
               ? "\nin the joints alone:\n"
           : result.parts.size() == 1 ? "\nby one equation in place of a kernel vector:\n"
                                      : fmt::format("\nthe union of {} parts:\n", result.parts.size());
  std::size_t width = 0, empty = 0;
  for (const Result& part : result.parts) width = std::max(width, part.cover.boxes.empty() ? 0 : part.part.size());
  for (const Result& part : result.parts) {
    const std::size_t boxes = part.cover.boxes.size(), open = part.cover.count(Verdict::undecided);
    empty += boxes == 0;
    if (boxes > 0)
      text += fmt::format("  {:<{}}  {:>8}{}{}{}\n", part.part, width, counted(boxes, "box"),
                          open > 0 ? fmt::format(", {} undecided", open) : "", part.cover.complete() ? "" : ", INCOMPLETE",
                          free_text(part));
  }
  return text + (empty > 0 ? fmt::format("  {} without a solution\n", counted(empty, "part")) : "");
}

std::string seconds_text(const Cover& cover) {
  const Statistics& s = cover.statistics;
  return fmt::format("\n{:.3f} s: search {:.3f} s, certify {:.3f} s\n", s.seconds_total, s.seconds_search,
                     s.seconds_certify);
}

}  // namespace

std::string sigma_text(const Sigma& sigma) {
  if (sigma.length != sigma.angle)
    return fmt::format("sigma {:g} in lengths, {:g} in sines and cosines", sigma.length, sigma.angle);
  return std::isinf(sigma.length) ? "sigma inf: boxes are not cut" : fmt::format("sigma {:g}", sigma.length);
}

std::string along_set_text(const Result& result) {
  const Cover& cover = result.cover;
  const bool some_found = !cover.self_motions.empty() ||
                          std::ranges::any_of(result.parts, [](const Result& p) { return !p.cover.self_motions.empty(); });
  if (cover.observed_dimension <= cover.dimension) return "along a curve, or a larger set, of degenerate solutions";
  return fmt::format("along a set of dimension {}, larger than expected, as samples show; this is not proven: {}",
                     cover.observed_dimension,
                     some_found ? "the linear relations that were found do not prove it there"
                                : "no linear relations were found on it that make its equations dependent; --tolerance "
                                  "1e-6 proves boxes for independent equations among them (partial)");
}

namespace {

std::string in_words(Reason reason, const Result& result) {
  using enum Reason;
  switch (reason) {
    case none: break;
    case degenerate_point: return "next to a degenerate solution, where the Jacobian does not have full rank";
    case degenerate_set: return along_set_text(result);
    case tolerance:
      if (!parameters_of(result).empty()) return "within the tolerances, robots may differ here";
      return "the coefficients' tolerance moves the solutions too far, or it is not shown that redundant equations hold";
    case precision: return "doubles cannot divide them further";
    case limit: return "a limit ended the search before they were divided further";
  }
  return "reason unknown";
}

std::string motions_text(const Result& result) {
  std::string text;
  for (std::size_t k = 0; k < result.cover.self_motions.size(); ++k)
    if (const std::size_t boxes = boxes_on(result.cover, k); boxes > 0)
      text += fmt::format("a set larger than expected, in {}: {}\n", counted(boxes, "box"), motion_sentence(result, k));
  for (const Result& part : result.parts) text += motions_text(part);
  return text;
}

std::string reasons_text(const Result& result) {
  std::string text;
  for (const auto& [reason, n] : undecided_reasons(result.cover))
    text += fmt::format("  undecided, {}: {}\n", n, in_words(reason, result));
  return text;
}

}  // namespace

std::string to_table(const Result& result) {
  const Cover& cover = result.cover;
  std::string text =
      fmt::format("{}, {}: {}, {}, {}; dimension {}\n", result.model,
                  symbolic::set_with_corank(result.set, result.options.corank), counted(result.variables.size(), "variable"),
                  counted(result.equations, "equation"), counted(result.inequalities, "inequality"), cover.dimension);
  text += fmt::format("{}{}{}\n", sigma_text(cover.sigma), result.options.kernel.empty() ? "" : ", kernel ",
                      result.options.kernel);
  if (const auto parameters = parameters_of(result); !parameters.empty())
    text += fmt::format("for every robot with {}\n", joined(parameters, [](const ResultVariable* v) {
                          return fmt::format("{} in [{:.10g}, {:.10g}]", v->name, v->domain.lo(), v->domain.hi());
                        }));
  if (!result.domain.found.empty()) text += found_ranges_text(result);
  text += cover.complete() ? "complete: every solution in the search domain is in a box\n"
                           : "INCOMPLETE: the search ended early; solutions may also be in the pending boxes\n";
  if (!result.stopped.empty()) text += fmt::format("stopped by {}\n", result.stopped);
  for (const std::string& sentence : range_end_sentences(result.domain)) text += sentence + "\n";
  if (!result.free_coordinates.empty() && !cover.boxes.empty())
    text += fmt::format("a product: solutions stay solutions for every {}\n", listed(result.free_coordinates));
  if (cover.boxes.empty()) {
    text += fmt::format("\nempty: there is no solution in the search domain   ({} processed)\n", cover.statistics.processed);
    if (const std::string meaning = locus_sentence(result); !meaning.empty()) text += meaning + "\n";
    for (const std::string& sentence : assembly_sentences(result)) text += sentence + "\n";
    return text + seconds_text(cover);
  }
  text += fmt::format("\n  {:<10}  {:>10}\n", "verdict", "boxes");
  const auto boxes_with = cover.counts();
  for (const Verdict verdict : kVerdictsInOrder) {
    if (const std::size_t n = boxes_with[static_cast<std::size_t>(verdict)]; n > 0)
      text += fmt::format("  {:<10}  {:>10}\n", to_string(verdict), n);
  }
  text += fmt::format("  {:<10}  {:>10}   ({} processed)\n", "all", cover.boxes.size(), cover.statistics.processed);
  if (const std::size_t some = parts_of_sheets(result); some > 0)
    text += fmt::format("  {} of these {} a part of a sheet: at most one solution for each value of the free variables\n",
                        some, some == 1 ? "holds" : "hold");
  text += reasons_text(result);
  if (result.seems_of_corank > result.options.corank)
    text += fmt::format("    the kernel there seems to have dimension {0}: try --corank {0}, or --kernel none\n",
                        result.seems_of_corank);
  text += motions_text(result);
  if (!result.domain.boundary.empty()) text += boundary_text(result.domain);
  if (const std::size_t wide = cover.wider_than_sigma; wide > 0)
    text += fmt::format("  {} wider than sigma: {}\n", wide,
                        !result.stopped.empty() ? "the search ended before they were cut"
                        : cover.tolerance > 0 || !parameters_of(result).empty()
                            ? "the tolerance keeps proven boxes from narrowing"
                            : "cutting does not make them narrower, since doubles resolve no more");
  if (cover.tolerance > 0) {
    const bool over_determined = static_cast<std::size_t>(result.equations) > result.variables.size();
    text += fmt::format("\n{} within a relative tolerance of {:g};\n",
                        over_determined
                            ? "more equations than variables: coefficients that are not integers are taken as written\n"
                              "if the equations then fit each other, else"
                            : "coefficients that are not integers are taken",
                        cover.tolerance / kPartialTolerance);
    text += over_determined ? fmt::format(
                                  "partial: proven for independent equations; on the piece, the others hold within {:g} "
                                  "(relative to their coefficients)\n",
                                  cover.tolerance)
                            : "each verdict holds for every choice of them\n";
  }
  if (cover.dimension == 0 && !cover.points.empty()) {
    std::vector<std::string> kinds;
    for (const Verdict verdict : kVerdictsInOrder)
      if (const auto n = how_many(cover.points, [&](const CoverBox& p) { return p.verdict == verdict; }); n > 0)
        kinds.push_back(fmt::format("{} {}", n, to_string(verdict)));
    text += fmt::format("\n{}: {}\n{}", counted(cover.points.size(), "point"), fmt::join(kinds, ", "), points_table(result));
    if (!cover.decimals.empty()) text += decimals_text(result);
  }
  if (const std::string meaning = locus_sentence(result); !meaning.empty()) text += "\n" + meaning + "\n";
  text += kernel_text(result) + types_text(cover) + passages_text(result) + parts_text(result);
  return text + seconds_text(cover);
}

}  // namespace corank::result
