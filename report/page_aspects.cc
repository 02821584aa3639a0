#include "corank/report/page_aspects.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corank/report/aspects_picture.h"
#include "corank/report/page_data.h"

namespace corank::report {

namespace {

PageAspects not_known(const std::string& why) { return {"Not known: " + why + ".", {}, {}, {}}; }

}  // namespace

std::optional<PageAspects> page_aspects(const study::Question& question, const std::vector<const result::Result*>& results,
                                        int threads, const std::string& limit, solve::Control& control) {
  const auto is_cspace = [](const result::Result* r) { return symbolic::definition(r->set).is_cspace(); };
  const auto cspace = std::find_if(results.begin(), results.end(), is_cspace);
  if (cspace == results.end() || !(*cspace)->cover.complete() || (*cspace)->cover.dimension > 2) return std::nullopt;
  analyze::AspectsOptions wanted{.threads = threads};
  wanted.drawn = drawn_coordinates(question.model);
  wanted.placed = &(*cspace)->cover;
  try {
    const analyze::Aspects aspects = analyze::aspects(question, wanted, control);
    if (const auto* stop = control.limits().stop; stop && *stop) return std::nullopt;
    if (control.ended()) return not_known("the search did not end within " + limit);
    if (!aspects.reason.empty()) return not_known(aspects.reason);
    PageAspects page{.summary = summary(aspects), .picture = {}, .labels = aspect_labels(aspects), .places = aspects.places};
    if (aspects.drawing && !aspects.drawing->pieces.empty())
      page.picture = to_svg(aspects_picture(question.model.name(), aspects));
    return page;
  } catch (const symbolic::ModelError&) {  // of matrices that are not square nothing is said
    return std::nullopt;
  }
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
