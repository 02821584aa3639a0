// What the scripts of a report's page read: the model as JSON. Each result's boxes are those that are drawn
// (SetView::drawn), all of them, in the result's order.
#pragma once

#include <string>
#include <vector>

#include "corank/report/html/set_view.h"
#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::report {

/// JSON that may stand inside <script>: without "<", since "</script" ends one and "<!--<script" makes the next end not
/// count.
std::string script_safe(std::string json);

/// CSS: --set-NAME, a set's colour; for elements of the class NAME it is --set, and --swatch that of a small area.
std::string set_style();

/// The coordinates, the drawing and each set with its variables, equations and points: one JSON object.
std::string page_model(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation,
                       const std::vector<SetView>& views);

/// The coordinates and the drawing alone, without sets: of a plain system, too. `system`: that of a result of this
/// mechanism.
std::string drawing_model(const symbolic::Mechanism& mechanism, const System& system);

}  // namespace corank::report
