// What is wrong with a model, said to its author.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace corank::symbolic {

/// A place in a model's text. Models built in C++ have no file: line 0.
struct SourceLocation {
  std::string file;
  int line = 0;    ///< from 1; 0: unknown
  int column = 0;  ///< from 1; 0: unknown
  /// "dextar.cuik:12:7", "dextar.cuik:12", or the file (or "model") alone.
  std::string text() const {
    std::string result = file.empty() ? "model" : file;
    if (line > 0) result += ':' + std::to_string(line);
    if (line > 0 && column > 0) result += ':' + std::to_string(column);
    return result;
  }
  friend bool operator==(const SourceLocation&, const SourceLocation&) = default;
};

/// Bad input. what() is one line: "<place>: <what is wrong>; expected <expectation>".
class ModelError : public std::runtime_error {
 public:
  ModelError(SourceLocation where, const std::string& problem, const std::string& expectation = "")
      : std::runtime_error(where.text() + ": " + problem + (expectation.empty() ? "" : "; expected " + expectation)),
        where_(std::move(where)) {}
  const SourceLocation& where() const { return where_; }

 private:
  SourceLocation where_;
};

}  // namespace corank::symbolic
