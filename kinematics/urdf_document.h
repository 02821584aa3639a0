// A URDF file's XML with the places of its elements and attributes. Refuses what no URDF needs and an attack does: DOCTYPE,
// entities of its own, NUL bytes, megabytes, deep nesting; and xacro, which is no URDF yet.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "corank/symbolic/model_error.h"

namespace corank::kinematics {

class UrdfDocument {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{8} << 20;
  static constexpr int kMaxDepth = 64;

  /// Throws ModelError, with the place, where the text is no XML, or is refused.
  UrdfDocument(std::string_view text, std::string file);
  UrdfDocument(const UrdfDocument&) = delete;  // pugixml's nodes point into the text
  UrdfDocument& operator=(const UrdfDocument&) = delete;

  /// The element <robot>.
  pugi::xml_node robot() const { return robot_; }
  /// Of an element's name, of an attribute's value.
  symbolic::SourceLocation where(const pugi::xml_node& element) const { return place(element.name()); }
  symbolic::SourceLocation where(const pugi::xml_attribute& attribute) const { return place(attribute.value()); }

 private:
  symbolic::SourceLocation place(const char* in_buffer) const;
  symbolic::SourceLocation place_at(std::size_t offset) const;
  void check_bytes() const;
  pugi::xml_node only_element() const;
  void check_elements() const;
  void check_attributes(const pugi::xml_node& element) const;
  void check_entities(const pugi::xml_attribute& attribute) const;

  std::string file_, text_, buffer_;  ///< as read; as pugixml left it
  std::vector<std::size_t> line_starts_{0};
  pugi::xml_document document_;
  pugi::xml_node robot_;
};

}  // namespace corank::kinematics
