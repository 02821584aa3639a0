// The report of a mechanism as one HTML file that needs no other: data, pictures, scripts and style are in it. doc/report.md
// describes it for users.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/report/html/page_aspects.h"
#include "corank/report/html/set_view.h"
#include "corank/symbolic/model/mechanism.h"
#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::report {

/// A page is to be there within a minute, and to open in a browser. Of each of its searches: the limits of seconds and of
/// boxes found, and the digits of isolated points.
inline constexpr int kPageSeconds = 8, kPageBoxes = 200'000, kPageDigits = 12;

struct PageOptions {
  std::string command;                   ///< the command line that made it; shown
  std::vector<std::string> figures;      ///< files, shown and linked
  std::vector<std::string> files;        ///< of the results, in their order; shown and linked. May be empty
  std::optional<PageAspects> aspects{};  ///< what is known of the mechanism's aspects
};

/// Of a mechanism and sets of it. Throws ModelError where it has no singularities to speak of (a plain system).
std::string report_page(const symbolic::Mechanism& mechanism, const std::vector<SetView>& views,
                        const PageOptions& options = {});

/// What stands on it, as JSON: {"model", "page", "figures", "complete", "sets": [{…, "file", "boxes_in_file"}]}, of each set
/// what corank solve --json prints of the boxes on the page. `page`: the page's file.
std::string page_summary(const std::string& model, const std::string& page, const PageOptions& options,
                         const std::vector<SetView>& views, bool complete);

// Its sections, as HTML fragments.

/// The isolated points of results, and points that are known exactly: a table for each set that has such points; a sentence
/// where none has. Digits are those that are proven.
std::string points_html(const std::vector<SetView>& views);

/// The derivation of a mechanism's singularities, typeset in MathML: Φ, the Jacobian blocks, the systems of the sets, each
/// folded away.
std::string derivation_html(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation,
                            const std::vector<SetView>& views);

}  // namespace corank::report
