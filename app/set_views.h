// Sets that are searched for a page.
#pragma once

#include <cstdint>
#include <optional>

#include "corank/app/set_search.h"
#include "corank/report/set_view.h"
#include "corank/study/question.h"

namespace corank::app {

/// Searches set `index` of those that `search` names, showing its progress; others on the page take `taken` bytes. Nothing
/// where the set has many parts and time ran out, or a signal came, before the equations of all were derived.
std::optional<report::SetView> solve_view(const SetSearch& search, study::Question question, std::size_t index,
                                          std::uint64_t taken);

}  // namespace corank::app
