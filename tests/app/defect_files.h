// Files that broke an earlier version, which are no part of the repository.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace corank::app {

inline std::filesystem::path defects_folder() {
  const char* const given = std::getenv("CORANK_DEFECTS_DIR");
  return given != nullptr && *given != '\0' ? std::filesystem::path(given)
                                            : std::filesystem::path(CORANK_SOURCE_DIR) / "../shared/defects";
}

inline std::string defect(const std::string& name) { return (defects_folder() / name).string(); }

#define SKIP_WITHOUT_DEFECT_FILES()                                                                                       \
  if (!std::filesystem::exists(corank::app::defects_folder() / "README.md")) {                                            \
    GTEST_SKIP() << "files that broke something are not in " << corank::app::defects_folder() << " (CORANK_DEFECTS_DIR)"; \
  }

}  // namespace corank::app
