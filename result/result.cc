#include "corank/result/result.h"

#include "corank/symbolic/model_file.h"

#include <algorithm>

namespace corank::result {

std::string version() { return CORANK_VERSION; }

void describe_system(const System& system, Result& result) {
  result.variables.clear();
  for (const Variable& v : system.variables)
    result.variables.push_back({v.name, v.kind, v.domain, v.auxiliary || v.kind == VariableKind::auxiliary});
  result.angles = system.angles;
  result.configuration_size = system.configuration_size;
  result.equations = static_cast<int>(system.equations.size());
  result.inequalities = static_cast<int>(system.inequalities.size());
}

void put_in(const std::vector<ConstantOverride>& constants, symbolic::Mechanism& model) {
  for (const auto& [name, expression] : constants)
    model.set_constant(name, symbolic::parse_expression(expression, "-D " + name));
}

void put_in(const std::vector<std::string>& outputs, symbolic::Mechanism& model) {
  if (outputs.empty()) return;
  std::vector<symbolic::Expression> symbols;
  for (const std::string& name : outputs) symbols.push_back(symbolic::Expression::symbol(name, {"--outputs", 0, 0}));
  model.replace_outputs(symbols, {"--outputs", 0, 0});
}

symbolic::Mechanism model_of(const Result& result) {
  symbolic::Mechanism model = symbolic::parse_model(result.model_text, result.model + ".cuik");
  put_in(result.options.constants, model);
  put_in(result.options.outputs, model);
  return model;
}

}  // namespace corank::result
