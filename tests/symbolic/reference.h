// The repository's models, by name.
#pragma once

#include <string>

#include "corank/symbolic/model/model_file.h"

namespace corank::symbolic {

inline Mechanism reference(const std::string& name) {
  return read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik");
}

}  // namespace corank::symbolic
