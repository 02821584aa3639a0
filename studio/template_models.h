// Models that a new one may begin with: files of models/ as they were when corank was built; made by
// cmake/EmbedModels.cmake.
#pragma once

#include <span>
#include <string_view>

namespace corank::studio {

struct TemplateModel {
  std::string_view name;  ///< of the file below models/, without its extension: "planar/3rpr"
  std::string_view text;
};

std::span<const TemplateModel> template_models();

}  // namespace corank::studio
