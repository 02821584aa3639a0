#include "corank/analyze/parameter_map.h"
#include "corank/core/check.h"

namespace corank::analyze {

result::MapFile to_file(const MapQuestion& question, const ParameterMap& map) {
  CORANK_CHECK(map.claims.has_value());
  const study::Question& q = question.question;
  result::MapFile file;
  file.model = q.model.name();
  file.model_text = q.model.source_text();
  file.constants = q.constants;
  file.family = {q.set, q.kernel, q.corank, question.over, question.fixed};
  file.claims = *map.claims;
  return file;
}

}  // namespace corank::analyze
