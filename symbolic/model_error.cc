#include "corank/symbolic/model_error.h"

namespace corank::symbolic {

std::string SourceLocation::text() const {
  std::string result = file.empty() ? "model" : file;
  if (line <= 0) return result;
  result += ':' + std::to_string(line);
  if (column > 0) result += ':' + std::to_string(column);
  return result;
}

namespace {
std::string message(const SourceLocation& where, const std::string& problem, const std::string& expectation) {
  std::string result = where.text() + ": " + problem;
  if (!expectation.empty()) result += "; expected " + expectation;
  return result;
}
}  // namespace

ModelError::ModelError(SourceLocation where, const std::string& problem, const std::string& expectation)
    : std::runtime_error(message(where, problem, expectation)), where_(std::move(where)) {}

}  // namespace corank::symbolic
