// What stands on the pages of a report and of a sweep, as JSON: of each set what corank solve --json prints of it.
#pragma once

#include <string>
#include <vector>

#include "corank/report/family_page.h"
#include "corank/report/page.h"

namespace corank::report {

/// {"model", "page", "figures", "complete", "sets": [{…, "file"}]}. `page`: the page's file.
std::string page_summary(const std::string& model, const std::string& page, const PageOptions& options,
                         const std::vector<SetView>& views, bool complete);

/// {"model", "constant", "page", "complete", "members": [{"value", "sets": [{…, "file"}]}]}
std::string family_summary(const std::string& model, const std::string& constant, const std::string& page,
                           const std::vector<FamilyMember>& members, bool complete);

}  // namespace corank::report
