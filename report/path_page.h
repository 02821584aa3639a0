// A path as one HTML file that needs no other: the mechanism moves along it, over the loci that it keeps away from.
// doc/paths.md describes it for users.
#pragma once

#include <string>
#include <vector>

#include "corank/report/path_view.h"
#include "corank/report/set_view.h"
#include "corank/symbolic/mechanism.h"

namespace corank::report {

struct PathPageOptions {
  std::string command;                 ///< that made it; shown
  std::string file{};                  ///< of the tube, shown and linked; empty: none
  std::vector<std::string> missing{};  ///< titles of sets that were sought and are not drawn
};

/// `sets`: what the portraits show of the mechanism, as far as it is known.
std::string path_page(const symbolic::Mechanism& mechanism, const PathView& view, const std::vector<SetView>& sets,
                      const PathPageOptions& options = {});

}  // namespace corank::report
