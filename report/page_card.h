// The card of a set on a page: what was found, what of it is proven, the shares of the verdicts.
#pragma once

#include <string>

#include "corank/result/result.h"

namespace corank::report {

/// An HTML fragment.
std::string card_html(const result::Result& result);

}  // namespace corank::report
