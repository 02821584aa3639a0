// What every certificate's file begins with: which program made it, and the model that it speaks of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "corank/result/result.h"

namespace corank::result {

struct ModelSource {
  std::string version = result::version();  ///< of the corank that made it
  std::string model, model_text;            ///< as Result::model, model_text
  std::vector<ConstantOverride> constants{};
};

/// The model with its constants put in. Throws symbolic::ModelError.
symbolic::Mechanism model_of(const ModelSource& source);

}  // namespace corank::result
