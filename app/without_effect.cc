#include "corank/app/without_effect.h"

#include <fmt/format.h>

#include "corank/app/exit_status.h"

namespace corank::app {

void refuse_without_effect(const CLI::App& sub, const std::vector<std::string>& options, const std::string& expected) {
  for (const std::string& name : options)
    if (sub.get_option(name)->count() > 0) throw UsageError(fmt::format("{}: without effect; expected {}", name, expected));
}

}  // namespace corank::app
