// The studio's page, and what its scripts read again and again: the same model as that of a report's page, with the boxes
// in it. doc/studio.md describes the page for users.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "corank/report/html/set_view.h"
#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::report {

/// page_model() of these sets; each has "boxes" and "verdicts" (box_payload.h) and its "card" in HTML as well.
std::string live_model(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation,
                       const std::vector<const SetView*>& views);

struct StudioPage {
  std::string file, text;                                        ///< of the model that it begins with; may be empty
  std::string loops{};                                           ///< the text of a URDF file's companion
  std::vector<std::pair<std::string, std::string>> constants{};  ///< values that are given
  std::vector<std::pair<std::string_view, std::string_view>> templates{};  ///< models to begin with: name and text
};

/// HTML that needs no other file, and asks its own server for all that changes.
std::string studio_page(const StudioPage& page);

}  // namespace corank::report
