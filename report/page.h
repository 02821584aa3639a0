// The report of a mechanism as one HTML file that needs no other: data, pictures, scripts and style are in it. doc/report.md
// describes it for users.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/report/page_aspects.h"
#include "corank/report/set_view.h"
#include "corank/symbolic/mechanism.h"

namespace corank::report {

struct PageOptions {
  std::string command;                   ///< the command line that made it; shown
  std::vector<std::string> figures;      ///< files, shown and linked
  std::vector<std::string> files;        ///< of the results, in their order; shown and linked. May be empty
  std::optional<PageAspects> aspects{};  ///< what is known of the mechanism's aspects
};

/// Of a mechanism and sets of it. Throws ModelError where it has no singularities to speak of (a plain system).
std::string report_page(const symbolic::Mechanism& mechanism, const std::vector<SetView>& views,
                        const PageOptions& options = {});

}  // namespace corank::report
