// A family of mechanisms: one constant runs through equally spaced values, `-D NAME=FROM:TO:COUNT`.
//
// Value k of COUNT is FROM + k/(COUNT − 1)·(TO − FROM), exactly: as a rational number where FROM and TO are rational, else
// as that expression. The ends are FROM and TO themselves.
#pragma once

#include <string>
#include <vector>

#include "corank/app/question.h"

namespace corank::app {

struct Family {
  std::string constant;             ///< the one that is swept
  std::vector<std::string> values;  ///< in the model language: "3/2", "1.6", "sqrt(2) + 1/3*(2 - sqrt(2))"

  static constexpr int kMost = 200;  ///< members
};

/// The family that the definitions -D ask for: one of them is NAME=FROM:TO:COUNT. Throws UsageError where none or several
/// are, or where COUNT is no number from 2 to kMost, or FROM equals TO; ModelError where an end is no expression.
Family family_of(const std::vector<std::string>& definitions);

/// The definitions of member k: those given, with the swept one at its value.
std::vector<std::string> definitions_of(const Family& family, std::size_t k, const std::vector<std::string>& definitions);

}  // namespace corank::app
