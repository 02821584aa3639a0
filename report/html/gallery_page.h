// The page of the gallery: published numbers beside corank's, with pictures of each robot. One HTML file that loads no
// other; it links the reports and answers beside it. doc/gallery.md describes it for users.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "corank/report/gallery/outcome.h"

namespace corank::report {

/// `folder`: where index.html will be; links lead from there to each entry's files. Pictures whose files are missing or
/// cannot be read are left out. `command`: what made the page; shown.
std::string gallery_page(const std::vector<GalleryResult>& results, const std::filesystem::path& folder,
                         const std::string& command);

}  // namespace corank::report
