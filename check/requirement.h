// Is a requirement met at every zero for which forms hold, or at none? The theorems are those of certify/requirement.h and
// doc/theory.md ("Requirements"); the code is the checker's own.
#pragma once

#include <functional>

#include "corank/check/form.h"
#include "corank/core/requirement.h"

namespace corank::check {

/// Of a variable of the system.
using FormOfVariable = std::function<Form(int variable)>;

Standing standing(const Requirement& requirement, const FormOfVariable& form, const Sides& offsets);

}  // namespace corank::check
