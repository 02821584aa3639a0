// Why a result is rejected, for tests of tampered results.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "corank/result/files/result_file.h"
#include "corank/result/files/verification.h"

namespace corank::result {

/// Through a file, as the command does it: why the result is rejected, nothing where it is accepted.
inline std::string rejection(const Result& result, bool* complete = nullptr) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("corank-tampered-" + std::to_string(getpid()) + ".h5");
  std::string reasons;
  try {
    write_result(path, result);
    const Verification verification = verify(read_result(path));
    for (const std::string& c : verification.contradictions) reasons += c + "\n";
    for (const auto& failure : verification.report.failures) reasons += failure.reason + "\n";
    EXPECT_EQ(verification.verified(), reasons.empty());
    if (complete) *complete = verification.complete();
  } catch (const ResultFileError& error) {
    reasons = error.what();
  }
  std::filesystem::remove(path);
  return reasons;
}

}  // namespace corank::result
