#include "corank/report/html/page_words.h"

#include <fmt/format.h>

#include "corank/report/pictures/drawn_boxes.h"
#include "corank/report/pictures/set_look.h"
#include "corank/result/values/sentences.h"
#include "corank/result/values/summary.h"
#include "corank/result/values/tallies.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/model/display_name.h"
#include "corank/symbolic/model/set_definition.h"
#include "corank/symbolic/writing/mathml.h"

namespace corank::report {
namespace {

using result::how_many;
using result::joined;

std::string counted(std::size_t n, const std::string& word) { return grouped(n) + " " + result::noun(n, word); }
std::string boxes_text(std::size_t n) { return counted(n, "box"); }
std::string boxes_are(std::size_t n) { return n == 1 ? "One box is" : grouped(n) + " boxes are"; }

std::string meaning(const SetLook& set, int corank, bool given) {
  const char* const one = given && set.given_meaning ? set.given_meaning : set.meaning;
  const char* const more = given && set.given_of_corank ? set.given_of_corank : set.of_corank;
  return corank == 1 ? one : fmt::format(fmt::runtime(more), corank);
}

std::string shape(int dimension) {
  switch (dimension) {
    case 0: return "Isolated points";
    case 1: return "Curves";
    case 2: return "Surfaces";
    default: return fmt::format("Dimension {}", dimension);
  }
}

/// Sets of larger dimension than expected, proven or not.
void say_larger_sets(const result::Result& result, SetWords& words) {
  const Cover& cover = result.cover;
  for (std::size_t k = 0; k < cover.self_motions.size(); ++k) {
    const std::string sentence = motion_sentence(result, k);
    const std::size_t colon = sentence.find(':');
    words.proven.push_back(fmt::format("In {} there is a set of larger dimension than expected, {}.",
                                       boxes_text(result::boxes_on(cover, k)),
                                       sentence.substr(0, colon) + with_minus(sentence.substr(colon))));
  }
  const std::size_t along = how_many(
      cover.boxes, [](const auto& b) { return b.verdict == Verdict::undecided && b.reason == Reason::degenerate_set; });
  if (along > 0) words.unproven.push_back(fmt::format("{} undecided {}.", boxes_are(along), result::along_set_text(result)));
}

void say_points(const result::Result& result, SetWords& words) {
  const Cover& cover = result.cover;
  const auto points = [&cover](Verdict verdict) {
    return how_many(cover.points, [=](const CoverBox& p) { return p.verdict == verdict; });
  };
  const std::size_t isolated = points(Verdict::isolated), exact = points(Verdict::exact), border = points(Verdict::boundary),
                    others = cover.points.size() - isolated - exact - border;
  words.finding = isolated + exact == 0 ? "No point is proven to exist" : counted(isolated + exact, "point");
  if (const std::size_t on_sets = how_many(cover.boxes, [](const auto& b) { return b.motion >= 0; }); on_sets > 0) {
    const std::string also = isolated + exact == 0 ? "" : " and " + words.finding;
    words.finding = fmt::format("{} of larger dimension than expected, in {}{}", counted(cover.self_motions.size(), "set"),
                                boxes_text(on_sets), also);
  }
  if (border > 0) words.finding += fmt::format(", {} at the border of the search domain", border);
  if (others > 0) words.finding += fmt::format(" and {}", counted(others, "undecided place"));
  if (isolated > 0)
    words.proven.push_back(isolated == 1 ? "One small box holds exactly one solution."
                                         : grouped(isolated) + " small boxes hold exactly one solution each, all distinct.");
  if (exact > 0)
    words.proven.push_back(fmt::format("{} known exactly.", exact == 1 ? "One point is" : grouped(exact) + " points are"));
  if (border > 0)
    words.unproven.push_back(
        fmt::format("It is not proven that {} inside the search domain.",
                    border == 1 ? "the solution at its border lies" : "the solutions at its border lie"));
  if (others > 0)
    words.unproven.push_back(
        fmt::format("At {} nothing is proven: {} may hold any number of solutions, or none. A double solution looks like "
                    "this.",
                    counted(others, "place"), others == 1 ? "it" : "each"));
}

/// Ranges that cut the set, and what keeps boxes at the border.
void say_domain(const result::DomainNotes& notes, SetWords& words) {
  for (const std::string& sentence : result::range_end_sentences(notes))
    words.unproven.push_back(result::capitalized(sentence) + ".");
  if (notes.boundary.empty()) return;
  words.unproven.push_back(
      fmt::format("Boxes at the border may reach beyond {}.", joined(notes.boundary, [](const auto& reason) {
                    return fmt::format("{} ({})", reason.text, boxes_text(reason.boxes));
                  })));
}

/// Where the kernel's dimension is known.
void say_kernel(const Cover& cover, SetWords& words) {
  if (how_many(cover.boxes, [](const auto& b) { return b.kernel_at_most >= 0; }) == 0) return;
  words.proven.push_back(fmt::format("The kernel has dimension 1 at every solution in {} of {} boxes.",
                                     grouped(how_many(cover.boxes, [](const auto& b) { return b.kernel_at_most == 1; })),
                                     grouped(cover.boxes.size())));
  const std::size_t larger = how_many(cover.exact_points, [](const auto& p) { return p.corank > 1; });
  if (larger > 0)
    words.proven.push_back(fmt::format("At {} it has dimension 2 or more; {} known exactly.", counted(larger, "point"),
                                       larger == 1 ? "it is" : "they are"));
}

/// Of a workspace boundary: where the output can pass.
void say_passages(const result::Result& result, SetWords& words) {
  if (result.outputs.empty()) return;
  const auto counts = result::passages(result.cover);
  const auto boxes = [&](Passage passage) { return counts[static_cast<std::size_t>(passage)]; };
  words.proven.push_back(
      fmt::format("If no further limit is reached, the output stays on one side near the configurations in {}, and can "
                  "pass at those in {}.",
                  boxes_text(boxes(Passage::barrier)), boxes_text(boxes(Passage::traversable))));
  if (boxes(Passage::unproven) > 0)
    words.unproven.push_back(
        fmt::format("In {} it is open whether the output can pass.", boxes_text(boxes(Passage::unproven))));
}

/// Of a product, and of a union.
void say_parts(const result::Result& result, SetWords& words) {
  if (!result.free_coordinates.empty())
    words.proven.push_back(fmt::format("The set is a product: solutions stay solutions for every {}.",
                                       result::listed(result.free_coordinates)));
  if (result.parts.size() < 2 || !result.outputs.empty()) return;
  const auto part = [](const result::Result& r) {
    return fmt::format("{} ({}{})", r.part, boxes_text(r.cover.boxes.size()), result::free_text(r));
  };
  words.proven.push_back(
      fmt::format("The set is the union of {} parts: {}.", result.parts.size(), joined(result.parts, part, "; ")));
}

void say_pieces(const result::Result& result, const Components& found, SetWords& words) {
  const Cover& cover = result.cover;
  words.finding = fmt::format("{}: {}", shape(cover.dimension), boxes_text(cover.boxes.size()));
  if (found.counted) words.finding += fmt::format(" in {} of touching boxes", counted(found.count, "component"));
  const auto counts = cover.counts();
  const auto count = [&](Verdict verdict) { return counts[index(verdict)]; };
  const std::size_t regular = count(Verdict::regular), boundary = count(Verdict::boundary);
  std::size_t some = 0;  // of the regular ones: with parts of sheets
  const std::vector<bool> parts = result::on_parts_of_sheets(result);
  for (std::size_t i = 0; i < parts.size(); ++i) some += parts[i] && cover.boxes[i].verdict == Verdict::regular;
  const std::size_t sheets = regular - some;
  const std::string coordinates = result::counted(cover.dimension, "free coordinate"),
                    of = result.parts.size() > 1 ? "one of its parts" : "the set";
  if (sheets > 0)
    words.proven.push_back(
        fmt::format("In {} of {} boxes ({}) {} is one smooth piece: for every value of {} there is exactly one solution.",
                    grouped(sheets), grouped(cover.boxes.size()), percentage(sheets, cover.boxes.size()), of, coordinates));
  if (some > 0)
    words.proven.push_back(fmt::format(
        "In {} {} is smooth, but may leave the box: for each value of {} there is at most one solution, and for some values "
        "there is one.",
        boxes_text(some), of, coordinates));
  if (boundary > 0)
    words.proven.push_back(
        fmt::format("In {} {} is smooth, but may reach beyond the search domain: within, for each value of {} there is at "
                    "most one solution.",
                    boxes_text(boundary), of, coordinates));
  if (found.count > 1 && count(Verdict::pending) == 0)
    words.proven.push_back(fmt::format("No two of the {} components are connected; {} of them {} proven to hold solutions.",
                                       found.count, found.with_proven_solution,
                                       found.with_proven_solution == 1 ? "is" : "are"));
  words.unproven.push_back(found.counted ? "It is not proven that the solutions in one component form one piece: components "
                                           "are counted by boxes that touch."
                                         : "The components were not counted, because the run was ended.");
  if (const std::size_t partial = count(Verdict::partial); partial > 0)
    words.unproven.push_back(
        fmt::format("In {} only independent equations are proven to hold, the others within a tolerance of {:g}.",
                    boxes_text(partial), cover.tolerance));
  say_kernel(cover, words);
  say_passages(result, words);
  say_parts(result, words);
  const std::size_t explained =
      how_many(cover.boxes, [](const auto& b) { return b.verdict == Verdict::undecided && b.point >= 0; });
  const std::size_t open = count(Verdict::undecided) - explained;
  if (explained > 0)
    words.unproven.push_back(
        fmt::format("{} undecided around a point that is known exactly: it is open whether {} anything else.",
                    boxes_are(explained), explained == 1 ? "it holds" : "they hold"));
  if (open > 0)
    words.unproven.push_back(fmt::format("{} undecided: it is open whether there are solutions.", boxes_are(open)));
}

const char* meaning_of(SingularityType type) {
  switch (type) {
    case SingularityType::ro: return "redundant output: with the actuators locked the output can still move";
    case SingularityType::rpm:
      return "redundant passive motion: with actuators and output locked passive joints can still move";
    case SingularityType::ii: return "impossible input: the actuators cannot achieve some velocity";
    case SingularityType::ri: return "redundant input: the actuators can move while the output stands still";
    case SingularityType::io: return "impossible output: the output cannot achieve some velocity";
    case SingularityType::iim: return "increased instantaneous mobility: more ways to move than the mobility says";
  }
  return "";
}

// One sentence for each type, with the boxes in which it is so; to first order, as all types are.
void say_types(const Cover& cover, SetWords& words) {
  const result::TypeTally tally = result::type_tally(cover);
  for (const auto& [type, n] : tally.proven)
    if (n > 0)
      words.proven.push_back(
          fmt::format("Every solution in {} has the type {} ({}).", boxes_text(n), to_string(type), meaning_of(type)));
  if (tally.proven.empty() || tally.unproven == 0) return;
  words.unproven.push_back(
      fmt::format("In {} it is open which types there are, or whether there is a solution.", boxes_text(tally.unproven)));
}

void say_none(const result::Result& result, const char* none, SetWords& words) {
  words.finding = "None";
  words.proven.emplace_back(result.options.corank == 1 ? none : look(symbolic::definition(std::nullopt)).none);
  for (const std::string& sentence : result::assembly_sentences(result)) {
    const bool proven = result::assembled(result) && sentence.starts_with("the robot");
    (proven ? words.proven : words.unproven).push_back(result::capitalized(sentence) + ".");
  }
}

}  // namespace

std::string percentage(std::size_t part, std::size_t whole) {
  if (part == whole) return "100 %";
  const double share = 100 * static_cast<double>(part) / static_cast<double>(whole);
  return share > 99.9 ? "over 99.9 %" : fmt::format("{:.1f} %", share);
}

std::string grouped(std::uint64_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, "\u202F");
  return digits;
}

std::string with_minus(std::string text) {
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at + 3)) text.replace(at, 1, "−");
  return text;
}

std::string names_html(const std::vector<std::string>& names) { return joined(names, symbolic::html_name); }

std::string chosen_html(const symbolic::Mechanism& mechanism, symbolic::Role role) {
  const std::vector<std::string>& names = role == symbolic::Role::input ? mechanism.inputs() : mechanism.outputs();
  std::vector<std::string> rates;
  for (const symbolic::Rate& rate : mechanism.rates())
    if (rate.role == role) rates.push_back(rate.name);
  if (rates.empty() || rates.size() == names.size()) return names_html(names);
  return names_html(rates) + " <small>rates</small>";
}

// The name in HTML, whose subscripts do not depend on the reader having a font for mathematics.
std::string constant_html(const symbolic::Constant& c) {
  const auto text = [](const symbolic::Expression& e) { return symbolic::math(symbolic::mathml(e)); };
  const std::string tolerance =
      c.tolerance ? " <small>in [" + text(c.tolerance->lower) + ", " + text(c.tolerance->upper) + "]</small>" : "";
  return "<span class=\"constant\">" + symbolic::html_name(c.name) + " = " + text(c.value) + tolerance + "</span>";
}

std::string constants_html(const symbolic::Mechanism& mechanism, const std::string& except) {
  std::vector<symbolic::Constant> shown = mechanism.constants();
  std::erase_if(shown, [&](const symbolic::Constant& c) { return c.name == except; });
  return shown.empty() ? "none" : joined(shown, constant_html);
}

std::string digits_text(const Interval& x) { return with_minus(result::outward_text(x, 9)); }

SetWords set_words(const result::Result& result, const Components& found, bool given_velocity_equation) {
  const Cover& cover = result.cover;
  SetWords words;
  const SetLook& called = look(symbolic::definition(result.set));
  const int corank = result.options.corank;
  words.title = called.title + (corank == 1 ? "" : fmt::format(" of corank {}", corank));
  words.meaning = meaning(called, corank, given_velocity_equation);
  if (const std::size_t in_one = boxes_in_one(result, found); in_one > 1)
    words.meaning += fmt::format("; drawn here: hulls of up to {} neighbouring boxes with the same verdict", in_one);
  if (const auto parameters = result::parameters_of(result); !parameters.empty())
    words.proven.push_back(fmt::format("All of this holds for every robot within the {} of {}.",
                                       result::noun(parameters.size(), "tolerance"),
                                       joined(parameters, [](const auto* v) { return v->name; })));
  if (cover.boxes.empty()) {
    say_none(result, given_velocity_equation && called.given_none ? called.given_none : called.none, words);
    return words;
  }
  if (const std::string locus = result::locus_sentence(result); !locus.empty())
    (cover.dimension == 0 ? words.proven : words.unproven).push_back(result::capitalized(locus) + ".");
  if (cover.complete()) {
    words.proven.push_back(
        "Every solution in the search domain lies in a box: the rest of the domain is excluded with outward rounding.");
  } else {
    words.unproven.push_back(fmt::format("The search {} and left {} unsearched, which may hold solutions.",
                                         result.stopped.empty() ? "ended early" : "was stopped by " + result.stopped,
                                         boxes_text(cover.count(Verdict::pending))));
  }
  if (cover.complete() && !result.stopped.empty())
    words.unproven.push_back(
        fmt::format("The work on this set was stopped by {}: more could be proven about its boxes.", result.stopped));
  if (cover.dimension == 0) {
    say_points(result, words);
  } else {
    say_pieces(result, found, words);
  }
  say_types(cover, words);
  say_larger_sets(result, words);
  say_domain(result.domain, words);
  if (!cover.complete()) words.finding += ", incomplete";
  return words;
}

}  // namespace corank::report
