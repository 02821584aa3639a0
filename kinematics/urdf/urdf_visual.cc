#include "corank/kinematics/urdf/urdf_reading.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "corank/symbolic/model/expression_words.h"

namespace corank::kinematics {
namespace {

using symbolic::ModelError;

// "" where the material has no colour.
std::string read_colour(const UrdfReading& reading, const pugi::xml_node& material) {
  const pugi::xml_attribute rgba = reading.only_child(material, "color").attribute("rgba");
  if (!rgba) return "";
  const SourceLocation where = reading.where(rgba);
  std::istringstream words(rgba.value());
  std::string colour = "#";
  int count = 0;
  for (std::string word; words >> word; ++count) {
    const double share = urdf_number(word, where, "rgba of a colour").approximate;
    if (share < 0 || share > 1)
      throw ModelError(where, "rgba of a colour holds " + symbolic::in_quotes(word), "shares of 1");
    if (count == 3) continue;  // how opaque it is
    constexpr const char* kHex = "0123456789abcdef";
    const long byte = std::lround(share * 255);
    colour += {kHex[byte / 16], kHex[byte % 16]};
  }
  if (count != 4) throw ModelError(where, "rgba of a colour has " + std::to_string(count) + " numbers", "four");
  return colour;
}

// A length in a shape, halved: 0.3 becomes 0.3/2.
Expression half(const Expression& length) { return length / 2; }

// Nothing where the geometry has no size.
std::optional<UrdfNumber> read_size(const UrdfReading& reading, const pugi::xml_node& geometry, const char* attribute) {
  reading.required(geometry, attribute, std::string("a ") + geometry.name());
  const UrdfNumber size = *reading.number(geometry, attribute, std::string("the ") + attribute + " of a " + geometry.name());
  if (size.approximate < 0)
    throw ModelError(reading.where(geometry.attribute(attribute)),
                     std::string("the ") + attribute + " of a " + geometry.name() + " is negative", "a positive length");
  if (size.is_zero) return {};
  return size;
}

std::vector<Vector> moved_points(const Pose& pose, const std::vector<Vector>& points) {
  std::vector<Vector> moved;
  for (const Vector& point : points) moved.push_back(moved_point(pose, point));
  return moved;
}

bool add_sphere(const UrdfReading& reading, const pugi::xml_node& sphere, const Pose& pose, std::vector<Shape>& shapes) {
  reading.allow_attributes(sphere, {"radius"});
  const std::optional<UrdfNumber> radius = read_size(reading, sphere, "radius");
  if (!radius) return false;
  shapes.push_back({Shape::Kind::sphere, {pose.translation}, radius->value, "", reading.where(sphere)});
  return true;
}

bool add_cylinder(const UrdfReading& reading, const pugi::xml_node& cylinder, const Pose& pose, std::vector<Shape>& shapes) {
  reading.allow_attributes(cylinder, {"radius", "length"});
  const std::optional<UrdfNumber> radius = read_size(reading, cylinder, "radius");
  const std::optional<UrdfNumber> length = read_size(reading, cylinder, "length");
  if (!radius || !length) return false;
  const Expression z = half(length->value);
  shapes.push_back(
      {Shape::Kind::cylinder, moved_points(pose, {{0, 0, -z}, {0, 0, z}}), radius->value, "", reading.where(cylinder)});
  return true;
}

bool add_box(const UrdfReading& reading, const pugi::xml_node& box, const Pose& pose, std::vector<Shape>& shapes) {
  reading.allow_attributes(box, {"size"});
  reading.required(box, "size", "a box");
  const SourceLocation where = reading.where(box.attribute("size"));
  const auto size = urdf_numbers(box.attribute("size").value(), where, "the size of a box", urdf_number);
  for (const UrdfNumber& side : size)
    if (side.approximate < 0) throw ModelError(where, "the size of a box is negative", "three positive lengths");
  if (std::ranges::any_of(size, [](const UrdfNumber& side) { return side.is_zero; })) return false;
  const auto corner = [&](int i) {
    Vector point;
    for (std::size_t k = 0; k < 3; ++k) point[k] = (i >> k) & 1 ? half(size[k].value) : -half(size[k].value);
    return moved_point(pose, point);
  };
  // Corner i is at + on axis k where bit k of i is 1.
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : kFaces) {
    Shape shape{Shape::Kind::polygon, {}, 0, "", reading.where(box)};
    for (const int i : face) shape.points.push_back(corner(i));
    shapes.push_back(std::move(shape));
  }
  return true;
}

}  // namespace

UrdfColours read_urdf_colours(const UrdfReading& reading) {
  UrdfColours colours;
  for (const pugi::xml_node& material : reading.robot().children("material"))
    colours.emplace(material.attribute("name").value(), read_colour(reading, material));
  return colours;
}

void read_urdf_visual(UrdfReading& reading, const pugi::xml_node& visual, const UrdfColours& colours, Link& link) {
  reading.allow_children(visual, {"origin", "geometry", "material"});
  const pugi::xml_node geometry = reading.only_child(visual, "geometry");
  if (!geometry) throw ModelError(reading.where(visual), "a <visual> has no <geometry>", "<geometry> in it");
  const Pose pose = reading.origin(visual, "a visual of link " + symbolic::in_quotes(link.name));
  std::string colour;
  if (const pugi::xml_node material = reading.only_child(visual, "material")) {
    colour = read_colour(reading, material);
    const auto named = colours.find(std::string_view(material.attribute("name").value()));
    if (colour.empty() && named != colours.end()) colour = named->second;
  }
  std::vector<Shape> shapes;
  for (const pugi::xml_node& shape : geometry.children()) {
    if (shape.type() != pugi::node_element) continue;
    const std::string_view kind = shape.name();
    bool has_size = true;
    if (kind == "sphere") {
      has_size = add_sphere(reading, shape, pose, shapes);
    } else if (kind == "cylinder") {
      has_size = add_cylinder(reading, shape, pose, shapes);
    } else if (kind == "box") {
      has_size = add_box(reading, shape, pose, shapes);
    } else {
      reading.notice(kind == "mesh" ? "meshes are not drawn" : "geometry <" + symbolic::shortened(kind) + "> is not drawn");
    }
    if (!has_size) reading.notice("geometry without size is not drawn");
  }
  for (Shape& shape : shapes) {
    shape.colour = colour;
    link.shapes.push_back(std::move(shape));
  }
}

}  // namespace corank::kinematics
