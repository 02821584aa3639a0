#include "corank/report/aspects_picture.h"

#include <fmt/format.h>

namespace corank::report {

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

std::vector<std::string> aspect_labels(const analyze::Aspects& aspects) {
  std::vector<std::string> labels;
  for (const std::vector<int>& signs : aspects.aspects.signs) {
    labels.push_back(std::to_string(labels.size() + 1) + " ");
    for (const int sign : signs) labels.back() += sign > 0 ? " +" : " −";
  }
  return labels;
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

}  // namespace corank::report
