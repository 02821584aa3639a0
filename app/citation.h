// How to cite corank.
#pragma once

#include <string>

namespace corank::app {

/// An entry for BibTeX, of what CITATION.cff says and the version that runs.
std::string citation();

}  // namespace corank::app
