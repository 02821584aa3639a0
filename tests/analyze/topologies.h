// Topologies of models, for tests.
#pragma once

#include <string>
#include <utility>

#include "corank/analyze/topology/topology.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::analyze {

inline Topology of(symbolic::Mechanism model) {
  solve::Control control;
  return topology({.model = std::move(model)}, {}, control);
}

inline Topology of_text(const std::string& text) { return of(symbolic::parse_model(text, "m.cuik")); }

}  // namespace corank::analyze
