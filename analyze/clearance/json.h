// What the analyses' JSON has in common, and what their files have.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/clearance/factor_search.h"

namespace corank::analyze {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& x) {
  return x ? Json(*x) : Json();
}
inline Json or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }
inline Json ends_of(const Interval& x) { return {{"lo", x.lo()}, {"hi", x.hi()}}; }
inline Json ends_of(const std::vector<CoordinateValue>& values) {
  Json json = Json::object();
  for (const CoordinateValue& v : values) json[v.name] = ends_of(v.value);
  return json;
}

/// What every factor of tolerances has.
inline void add_bounds(const FactorBounds& f, Json& json) {
  json["factor"] = {{"lo", f.lower}, {"hi", or_null(f.upper)}};
  json["tolerances"] = ends_of(f.tolerances);
  json["robot"] = ends_of(f.robot);
  json["complete"] = f.complete();
  json["stopped"] = or_null(f.stopped);
  json["reason"] = or_null(f.reason);
  json["precision"] = f.precision;
  json["steps"] = f.steps;
  json["seconds"] = f.seconds;
}

/// A file with the question's model.
template <class File>
File file_about(const study::Question& question) {
  File file;
  file.model = question.model.name();
  file.model_text = question.model.source_text();
  file.constants = question.constants;
  return file;
}

}  // namespace corank::analyze
