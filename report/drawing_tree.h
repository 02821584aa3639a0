// The expressions of a drawing for a page's scripts: trees in which constants have become numbers.
#pragma once

#include <map>
#include <string>

#include "corank/symbolic/mechanism.h"

namespace corank::report {

/// Constants in doubles: for pictures, not for proofs.
using ConstantValues = std::map<std::string, double>;
ConstantValues constant_values(const symbolic::Mechanism& mechanism);

/// JSON: a number; "name" for a coordinate; ["+", …], ["*", …], ["/", a, b], ["^", a, b], ["-", a], ["sin", a] …
/// Parts without a coordinate are one number.
std::string drawing_tree(const symbolic::Expression& e, const ConstantValues& constants);

}  // namespace corank::report
