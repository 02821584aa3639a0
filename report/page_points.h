// The isolated points of results, and points that are known exactly, as tables of a report. HTML fragments.
#pragma once

#include <string>
#include <vector>

#include "corank/report/set_view.h"

namespace corank::report {

/// A table for each set that has such points; a sentence where none has. Digits are those that are proven.
std::string points_html(const std::vector<SetView>& views);

}  // namespace corank::report
