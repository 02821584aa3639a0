#include "corank/studio/request.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corank/symbolic/model/set_definition.h"

namespace corank::studio {
namespace {

using RequestJson = nlohmann::ordered_json;

constexpr std::size_t kMostText = 1 << 20, kMostName = 200, kMostLine = 1000, kMostConstants = 200;

const RequestJson& part(const RequestJson& json, const char* name) {
  const auto at = json.find(name);
  if (at == json.end()) throw RequestError(std::string("the request has no \"") + name + "\"");
  return *at;
}

std::string string_of(const RequestJson& json, const char* name, std::size_t most) {
  const RequestJson& value = part(json, name);
  if (!value.is_string()) throw RequestError(std::string("\"") + name + "\" is no text");
  std::string text = value.get<std::string>();
  if (text.size() > most) throw RequestError(std::string("\"") + name + "\" is too long");
  if (text.find('\0') != std::string::npos) throw RequestError(std::string("\"") + name + "\" has a byte 0");
  return text;
}

std::vector<result::ConstantOverride> constants_of(const RequestJson& json) {
  std::vector<result::ConstantOverride> constants;
  const auto at = json.find("constants");
  if (at == json.end()) return constants;
  if (!at->is_object() || at->size() > kMostConstants) throw RequestError("\"constants\" is no object of values by name");
  for (const auto& [name, value] : at->items()) {
    if (!value.is_string() || name.size() > kMostName || value.get_ref<const std::string&>().size() > kMostName)
      throw RequestError("\"constants\": a value is a short text, such as \"0.9\"");
    constants.push_back({name, value.get<std::string>()});
  }
  return constants;
}

std::vector<std::string> sets_of(const RequestJson& json) {
  const RequestJson& list = part(json, "sets");
  if (!list.is_array() || list.size() > symbolic::set_definitions().size())
    throw RequestError("\"sets\" is no list of sets");
  std::vector<std::string> sets;
  for (const RequestJson& item : list) {
    const std::string name = item.is_string() ? item.get<std::string>() : "";
    if (!symbolic::singularity_set_from_string(name)) throw RequestError("\"sets\" names a set that there is not");
    if (std::ranges::find(sets, name) == sets.end()) sets.push_back(name);
  }
  return sets;
}

Request::Colours colours_of(const RequestJson& json) {
  if (!json.contains("colours")) return Request::Colours::none;
  const std::string text = string_of(json, "colours", kMostName);
  if (text.empty()) return Request::Colours::none;
  if (text == "aspects") return Request::Colours::aspects;
  if (text == "requirements") return Request::Colours::requirements;
  throw RequestError("\"colours\" is neither \"aspects\" nor \"requirements\"");
}

std::vector<std::string> require_of(const RequestJson& json) {
  std::vector<std::string> texts;
  const auto at = json.find("require");
  if (at == json.end()) return texts;
  if (!at->is_array() || at->size() > kMostConstants) throw RequestError("\"require\" is no list of requirements");
  for (const RequestJson& item : *at) {
    if (!item.is_string() || item.get_ref<const std::string&>().size() > kMostLine)
      throw RequestError("\"require\": a requirement is a line of text");
    texts.push_back(item.get<std::string>());
  }
  return texts;
}

bool flag(const RequestJson& json, const char* name, bool usual) {
  const auto at = json.find(name);
  if (at == json.end()) return usual;
  if (!at->is_boolean()) throw RequestError(std::string("\"") + name + "\" is neither true nor false");
  return at->get<bool>();
}

}  // namespace

Request parse_request(std::string_view text) {
  const RequestJson json = RequestJson::parse(text, nullptr, false);
  if (!json.is_object()) throw RequestError("the request is no JSON object");
  Request request;
  const RequestJson& number = part(json, "number");
  if (!number.is_number_unsigned()) throw RequestError("\"number\" is no whole number");
  request.number = number.get<std::uint64_t>();
  const std::string want = string_of(json, "want", kMostName);
  if (want != "picture" && want != "report") throw RequestError("\"want\" is neither \"picture\" nor \"report\"");
  request.want = want == "report" ? Request::Want::report : Request::Want::picture;
  request.model = {string_of(json, "text", kMostText), string_of(json, "file", kMostName)};
  if (json.contains("loops"))
    request.loops = study::ModelText{string_of(json, "loops", kMostText), request.model.file + ".loops"};
  request.constants = constants_of(json);
  request.sets = sets_of(json);
  request.fine = flag(json, "fine", true);
  request.colours = colours_of(json);
  request.require = require_of(json);
  if (json.contains("command")) request.command = string_of(json, "command", kMostText);
  return request;
}

}  // namespace corank::studio
