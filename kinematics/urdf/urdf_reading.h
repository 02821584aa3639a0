// What the readers of a URDF document's parts share.
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "corank/kinematics/urdf/urdf_number.h"

namespace corank::kinematics {

/// The XML with the places of its elements and attributes. Refuses what no URDF needs and an attack does: DOCTYPE, entities
/// of its own, NUL bytes, megabytes, deep nesting; and xacro, which is no URDF yet.
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

/// Attributes with their faults, poses, notices.
class UrdfReading : public UrdfDocument {
 public:
  using UrdfDocument::UrdfDocument;

  /// The attribute's text; `owner` is what lacks it, "a joint".
  std::string_view required(const pugi::xml_node& element, const char* attribute, const std::string& owner) const;
  /// The only child of that name, none where there is none.
  pugi::xml_node only_child(const pugi::xml_node& element, const char* name) const;
  /// Throws for an attribute with a name that is none of these. Names with a prefix (drake:x) are others' business.
  void allow_attributes(const pugi::xml_node& element, std::initializer_list<std::string_view> names) const;
  /// Passes over children with other names, with a notice; throws where one looks like a slip of the pen for one of these.
  void allow_children(const pugi::xml_node& element, std::initializer_list<std::string_view> names);

  /// A number of an attribute that need not be there.
  std::optional<UrdfNumber> number(const pugi::xml_node& element, const char* attribute, const std::string& what) const;
  std::optional<UrdfNumber> angle(const pugi::xml_node& element, const char* attribute, const std::string& what);
  /// The element's <origin>; the identity where there is none. R = Rz(yaw) Ry(pitch) Rx(roll).
  Pose origin(const pugi::xml_node& element, const std::string& owner);

  /// Says a sentence once, with the number of times.
  void notice(const std::string& sentence, int times = 1);
  std::vector<std::string> notices() const;

 private:
  std::vector<std::pair<std::string, int>> notices_;
  std::map<std::string, std::size_t, std::less<>> notice_index_;
};

/// Names as URDF has them, and what they are called in the model: identifiers, each once.
class UrdfNames {
 public:
  /// `what` has the names: "link".
  UrdfNames(UrdfReading& reading, std::string what) : reading_(reading), what_(std::move(what)) {}

  std::size_t add(const pugi::xml_node& element);
  /// The one that an attribute names; `owner` has the attribute.
  std::size_t find(const pugi::xml_node& element, const char* attribute, const std::string& owner) const;
  /// Once all are there: those that are identifiers keep their names.
  std::vector<std::string> identifiers();

  std::size_t size() const { return list_.size(); }
  std::string_view operator[](std::size_t i) const { return list_[i]; }

 private:
  UrdfReading& reading_;
  std::string what_;
  std::vector<std::string_view> list_;
  std::vector<int> lines_;
  std::map<std::string_view, std::size_t> index_;
};

/// The point of a frame whose pose is given: R x + p. The direction: R x.
Vector moved_point(const Pose& pose, const Vector& point);
Vector turned(const Pose& pose, const Vector& direction);

/// Colours "#rrggbb" by the names of <material> elements of <robot>.
using UrdfColours = std::map<std::string, std::string, std::less<>>;
UrdfColours read_urdf_colours(const UrdfReading& reading);

/// Spheres, cylinders along z of their origin, boxes as six faces. Meshes and geometry without size are passed over.
void read_urdf_visual(UrdfReading& reading, const pugi::xml_node& visual, const UrdfColours& colours, Link& link);

/// The links and joints of a document; urdf.h says what becomes of them. `closed`: loops will be added, so that a floating
/// joint's link may be held by them.
Robot read_urdf_tree(std::string_view text, const std::string& file, bool closed);

}  // namespace corank::kinematics
