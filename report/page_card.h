// The card of a set on a page: what was found, what of it is proven, the shares of the verdicts.
#pragma once

#include <string>

#include "corank/report/set_view.h"

namespace corank::report {

/// An HTML fragment.
std::string card_html(const SetView& view);

}  // namespace corank::report
