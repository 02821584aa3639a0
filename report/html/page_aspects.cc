#include "corank/report/html/page_aspects.h"

#include <fmt/format.h>

#include <algorithm>

#include "corank/report/html/page_data.h"
#include "corank/report/html/template_data.h"
#include "corank/report/pictures/box_payload.h"

namespace corank::report {
namespace {

// "1  + − +": of each aspect its number and the signs of the factors.
std::vector<std::string> aspect_labels(const analyze::Aspects& aspects) {
  std::vector<std::string> labels;
  for (const std::vector<int>& signs : aspects.aspects.signs) {
    labels.push_back(std::to_string(labels.size() + 1) + " ");
    for (const int sign : signs) labels.back() += sign > 0 ? " +" : " −";
  }
  return labels;
}

PageAspects not_known(const std::string& why) { return {"Not known: " + why + ".", {}, {}, {}}; }

}  // namespace

std::vector<std::string> drawn_coordinates(const symbolic::Mechanism& model) {
  std::vector<std::string> result;
  for (const auto& names : {model.outputs(), model.inputs()}) {
    std::vector<std::string> two;
    for (const std::string& name : names)
      for (const symbolic::Coordinate& c : model.coordinates())
        if (c.name == name && !is_fixed(c) && two.size() < 2) two.push_back(name);
    if (two.size() == 2) result.insert(result.end(), two.begin(), two.end());
  }
  return result;
}

RegionMap aspects_picture(const std::string& model, const analyze::Aspects& aspects) {
  RegionMap map;
  map.title = fmt::format("{}: {} aspects", model, aspects.aspects.at_least);
  if (!aspects.aspects.exact()) map.title += " at least";
  if (!aspects.forward_factors.empty() || !aspects.inverse_factors.empty())
    map.title += ", by the signs of the factors of det L_y and det L_z";
  map.labels = aspect_labels(aspects);
  const analyze::PieceDrawing& drawing = *aspects.drawing;
  for (std::size_t c = 0; c + 1 < drawing.coordinates.size(); c += 2) {
    RegionMap::Plane& plane = map.planes.emplace_back();
    plane.x_name = drawing.coordinates[c], plane.y_name = drawing.coordinates[c + 1];
    plane.x_angle = drawing.is_angle[c], plane.y_angle = drawing.is_angle[c + 1];
    for (const auto& piece : drawing.pieces) {
      auto& region = plane.regions.emplace_back();
      for (const auto& polygon : piece) {
        auto& points = region.emplace_back();
        for (const auto& point : polygon) points.push_back({point[c], point[c + 1]});
      }
    }
  }
  return map;
}

std::optional<PageAspects> page_aspects(const study::Question& question, const std::vector<const result::Result*>& results,
                                        int threads, const std::string& limit, solve::Control& control) {
  const auto is_cspace = [](const result::Result* r) { return symbolic::definition(r->set).is_cspace(); };
  const auto cspace = std::ranges::find_if(results, is_cspace);
  if (!question.model.toleranced().empty()) return std::nullopt;  // they are one robot's
  if (cspace == results.end() || !(*cspace)->cover.complete() || (*cspace)->cover.dimension > 2) return std::nullopt;
  analyze::AspectsOptions wanted{.threads = threads, .requirements = false};
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
  Json json = {{"labels", aspects.labels}, {"colours", Json::array()}};
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
