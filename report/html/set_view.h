// A result as pages and pictures show it: with what it takes to do so, made once.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/system.h"
#include "corank/report/html/page_words.h"
#include "corank/report/pictures/components.h"
#include "corank/result/values/result.h"
#include "corank/symbolic/model/mechanism.h"
#include "corank/symbolic/model/set_definition.h"

namespace corank::report {

struct SetView {
  result::Result result;
  const symbolic::SetDefinition* set;  ///< of result.set
  System system;                       ///< that was solved
  Components components;
  SetWords words;
  /// Of a set in parts: for each part the equations that the system has not, in its variables, and M, whose kernel is drawn.
  std::vector<std::vector<Polynomial>> conditions{};
  std::optional<PolynomialMatrix> locked{};
  std::vector<CoverBox> hulls;  ///< drawn in place of boxes that are too many (drawn_boxes.h); else empty
  std::size_t uncut = 0;        ///< how many boxes there were before they were cut for the page (say_cut); 0: they were not

  const std::vector<CoverBox>& drawn() const { return hulls.empty() ? result.cover.boxes : hulls; }
  std::size_t in_file() const { return uncut > 0 ? uncut : result.cover.boxes.size(); }
};

/// Of a result of so many boxes that a page is to show cut: adds to the words that it does so, or that it does not. Returns
/// false where it does not.
bool say_cut(std::size_t uncut, SetView& view);

/// Of a result and the system that was solved.
SetView set_view(const symbolic::Mechanism& mechanism, result::Result result, System system, const Ended& ended = {});
/// The same with the components, found before.
SetView set_view(const symbolic::Mechanism& mechanism, result::Result result, System system, Components found);
/// The same of a result that was read. Throws ResultFileError where it is none of this mechanism: its variables differ from
/// those of the mechanism's set.
SetView set_view(const symbolic::Mechanism& mechanism, result::Result result);

}  // namespace corank::report
