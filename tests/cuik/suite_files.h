// The CUIK suite's own files, which are no part of the repository.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace corank::cuik {

inline std::filesystem::path suite_folder() {
  const char* const given = std::getenv("CORANK_CUIK_DIR");
  return given != nullptr && *given != '\0' ? std::filesystem::path(given)
                                            : std::filesystem::path(CORANK_SOURCE_DIR) / "../shared/cuik";
}

#define SKIP_WITHOUT_SUITE_FILES()                                                                                \
  if (!std::filesystem::exists(corank::cuik::suite_folder() / "solutions")) {                                     \
    GTEST_SKIP() << "the CUIK suite's files are not in " << corank::cuik::suite_folder() << " (CORANK_CUIK_DIR)"; \
  }

}  // namespace corank::cuik
