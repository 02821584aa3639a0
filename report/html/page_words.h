// A result in words, for a report: what was found, what of it is proven, and what is not. Plain text, which the page
// escapes, but where a name says HTML.
#pragma once

#include <string>
#include <vector>

#include "corank/report/pictures/components.h"
#include "corank/result/values/result.h"
#include "corank/symbolic/model/mechanism.h"

namespace corank::report {

struct Findings {
  std::vector<std::string> proven, unproven;  ///< one sentence each
};

struct SetWords : Findings {
  std::string title;    ///< "C-space", "Forward singularities", "Forward singularities of corank 2"
  std::string meaning;  ///< what the set is, in one clause
  std::string finding;  ///< "curves in 2 486 boxes"
};

/// "100 %" only where it is all.
std::string percentage(std::size_t part, std::size_t whole);
/// "94 004" with narrow spaces.
std::string grouped(std::uint64_t n);
/// Hyphens become minus signs.
std::string with_minus(std::string text);
/// Names with commas between them: "<i>θ</i><sub>2</sub>, …".
std::string names_html(const std::vector<std::string>& names);
/// The inputs or the outputs, by their coordinates; by rates, with that word, where the mechanism's own of this role have no
/// coordinates one by one.
std::string chosen_html(const symbolic::Mechanism& mechanism, symbolic::Role role);
/// "<i>l</i> = 9/10" with the value in MathML, and its tolerance.
std::string constant_html(const symbolic::Constant& constant);
/// "l = 9/10, d = 1.18", likewise, without the constant `except`; "none" where there is no other.
std::string constants_html(const symbolic::Mechanism& mechanism, const std::string& except = "");
/// One cell of a table for each coordinate: bounds with the digits that are proven, the rest in brackets.
std::string digits_text(const Interval& x);

SetWords set_words(const result::Result& result, const Components& components, bool given_velocity_equation = false);

}  // namespace corank::report
