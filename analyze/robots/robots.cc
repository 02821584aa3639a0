#include "corank/analyze/robots/robots.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "corank/analyze/robots/robots_words.h"
#include "corank/certify/implied.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::analyze {

study::Question with_common_ranges(study::Question question, std::vector<std::string>& own_ends) {
  const symbolic::Mechanism given = question.model;
  const System all = study::system(question);
  study::Question drawn = question;
  drawn.model = given.nominal();
  const System one = study::system(drawn);
  const std::vector<certify::ImpliedSides> implied = certify::implied_domains(one);
  const auto is_limited = [&](const symbolic::Coordinate& c) {
    return std::ranges::find(given.limits(), c.name, &symbolic::Limit::coordinate) != given.limits().end();
  };
  const auto number = [](const ExactNumber& x) { return symbolic::parse_expression(x.text(), "range"); };
  for (const symbolic::Coordinate& c : given.coordinates()) {
    const int j = one.find(c.name), k = all.find(c.name);
    if (j < 0 || k < 0 || !c.has_range || is_fixed(c) || is_limited(c) || !one.variables[j].is_plain_length()) continue;
    const Variable &v = one.variables[j], &wide = all.variables[k];
    const ExactNumber more = (v.upper - v.lower) / ExactNumber::rational("50");
    const auto end = [&](const symbolic::Expression& given_end, bool is_implied, const ExactNumber& of_all,
                         const ExactNumber& beyond) {
      if (!given.toleranced_in(given_end).empty()) return number(of_all);
      return is_implied && beyond.is_rational() ? number(beyond) : given_end;
    };
    const symbolic::Expression lower = end(c.lower, implied[j].lower, wide.lower, v.lower - more),
                               upper = end(c.upper, implied[j].upper, wide.upper, v.upper + more);
    if (same_tree(lower, c.lower) && same_tree(upper, c.upper)) continue;
    question.model.set_range(c.name, lower, upper);
    if (!same_tree(lower, c.lower)) own_ends.push_back("lower end of " + c.name);
    if (!same_tree(upper, c.upper)) own_ends.push_back("upper end of " + c.name);
  }
  return question;
}

namespace {

void look_for_other_numbers(const study::Question& question, const ExactNumbers& drawn,
                            const std::function<ExactNumbers(const study::Question&)>& numbers, Robots& robots,
                            const solve::Control& control) {
  constexpr std::size_t kMostBits = 4;
  std::vector<symbolic::Constant> wide;
  for (const symbolic::Constant& c : question.model.constants())
    if (c.tolerance) wide.push_back(c);
  for (unsigned corner = 0; corner < 1U << std::min(wide.size(), kMostBits) && !control.ended(); ++corner) {
    study::Question one = question;
    one.model = question.model.nominal();
    std::vector<CoordinateValue> constants;
    for (std::size_t k = 0; k < wide.size(); ++k) {
      const bool upper = (corner >> k % kMostBits & 1) != 0;
      const symbolic::Expression& value = upper ? wide[k].tolerance->upper : wide[k].tolerance->lower;
      one.model.set_constant(wide[k].name, value);
      constants.push_back({wide[k].name, symbolic::exact_value(question.model, value, wide[k].name).enclose()});
    }
    const ExactNumbers found = numbers(one);
    if (control.ended()) return;
    const auto differs = [&](const auto& number) {
      return std::ranges::any_of(found, [&](const auto& f) { return f.first == number.first && f.second != number.second; });
    };
    if (std::ranges::none_of(drawn, differs)) continue;
    robots.other = std::move(constants);
    robots.other_numbers = found;
    return;
  }
}

}  // namespace

Robots examine(const study::Question& question, const ExactNumbers& drawn,
               const std::function<std::string(int parts)>& obstacle,
               const std::function<ExactNumbers(const study::Question&)>& numbers, const solve::Control& control) {
  constexpr int kParts = 32;
  Robots robots;
  robots.toleranced = question.model.toleranced();
  robots.obstacle = obstacle(1);
  if (!robots.obstacle.empty()) look_for_other_numbers(question, drawn, numbers, robots, control);
  if (!robots.obstacle.empty() && robots.other.empty() && !control.ended()) robots.obstacle = obstacle(kParts);
  robots.same = robots.obstacle.empty();
  return robots;
}

std::string in_words(const ExactNumbers& numbers) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : numbers) parts.push_back(fmt::format("{} {}", name, value));
  for (std::string& part : parts) std::ranges::replace(part, '_', ' ');
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string robots_text(const Robots& r) {
  const auto line = [](const char* name, const std::string& value) { return fmt::format("  {:<14}  {}\n", name, value); };
  if (r.same) return line("robots", fmt::format("every one within the tolerances of {}", fmt::join(r.toleranced, ", ")));
  std::string text = line("robots", "the one that was drawn; not proven for every one within the tolerances:");
  text += line("", r.obstacle);
  if (r.other.empty()) return text;
  const auto part = [](const CoordinateValue& v) { return fmt::format("{} = {:.9g}", v.name, v.value.mid()); };
  std::vector<std::string> constants;
  for (const CoordinateValue& v : r.other) constants.push_back(part(v));
  text += line("another robot", fmt::format("with {}, proven:", fmt::join(constants, ", ")));
  return text + line("", in_words(r.other_numbers));
}

Json robots_json(const Robots& r) {
  Json json{{"tolerances", r.toleranced}, {"every", r.same}, {"reason", r.obstacle}, {"other", nullptr}};
  if (r.other.empty()) return json;
  json["other"] = {{"constants", ends_of(r.other)}};
  for (const auto& [name, value] : r.other_numbers) json["other"][name] = value;
  return json;
}

}  // namespace corank::analyze
