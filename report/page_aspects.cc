#include "corank/report/page_aspects.h"

#include <nlohmann/json.hpp>

#include "corank/report/aspects_picture.h"
#include "corank/report/page_data.h"

namespace corank::report {

PageAspects page_aspects(const std::string& model, const analyze::Aspects& aspects) {
  PageAspects page{.summary = summary(aspects), .picture = {}, .labels = aspect_labels(aspects), .places = aspects.places};
  if (aspects.drawing && !aspects.drawing->pieces.empty()) page.picture = to_svg(aspects_picture(model, aspects));
  return page;
}

PageAspects no_page_aspects(const std::string& why) {
  return {.summary = "Not known: " + why + ".", .picture = {}, .labels = {}, .places = {}};
}

std::string aspects_json(const PageAspects& aspects) {
  if (aspects.places.empty() || aspects.labels.empty()) return "null";
  nlohmann::ordered_json json = {{"labels", aspects.labels}, {"colours", nlohmann::ordered_json::array()}};
  for (std::size_t k = 0; k < aspects.labels.size(); ++k) json["colours"].push_back(region_color(k));
  std::vector<std::uint8_t> bytes;
  for (const int place : aspects.places) {
    const auto number = static_cast<std::uint16_t>(place + 1);
    bytes.push_back(static_cast<std::uint8_t>(number & 0xff));
    bytes.push_back(static_cast<std::uint8_t>(number >> 8));
  }
  json["of"] = base64(bytes);
  return script_safe(json.dump());
}

}  // namespace corank::report
