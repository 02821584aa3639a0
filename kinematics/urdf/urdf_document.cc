#include "corank/kinematics/urdf/urdf_reading.h"

#include <algorithm>
#include <array>
#include <set>

#include "corank/symbolic/model/expression_words.h"

namespace corank::kinematics {
namespace {

using symbolic::in_quotes;
using symbolic::ModelError;

constexpr std::array<std::string_view, 5> kEntities = {"amp", "lt", "gt", "quot", "apos"};

constexpr const char* kRunXacro = "plain URDF: run xacro first (xacro robot.urdf.xacro > robot.urdf)";

std::string_view name_of(const pugi::xml_node& node) { return node.name(); }

}  // namespace

UrdfDocument::UrdfDocument(std::string_view text, std::string file) : file_(std::move(file)), text_(text) {
  for (std::size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') line_starts_.push_back(i + 1);
  check_bytes();
  buffer_ = text_;
  const pugi::xml_parse_result parsed = document_.load_buffer_inplace(
      buffer_.data(), buffer_.size(), pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
  if (!parsed) {
    if (parsed.status == pugi::status_no_document_element)
      throw ModelError({file_, 0, 0}, "there is no <robot> element", "a URDF file");
    throw ModelError(place_at(std::max<std::ptrdiff_t>(parsed.offset, 0)),
                     std::string("the XML is faulty: ") + parsed.description(), "well-formed XML");
  }
  robot_ = only_element();
  check_elements();
}

void UrdfDocument::check_bytes() const {
  if (text_.size() > kMaxBytes)
    throw ModelError({file_, 0, 0}, "the file is too large", "at most " + std::to_string(kMaxBytes >> 20) + " MB");
  if (text_.starts_with("\xFE\xFF") || text_.starts_with("\xFF\xFE"))
    throw ModelError({file_, 1, 0}, "the text is in UTF-16", "UTF-8");
  const std::size_t nul = text_.find('\0');
  if (nul != std::string::npos) throw ModelError(place_at(nul), "a NUL byte in the text", "a text file in UTF-8");
}

pugi::xml_node UrdfDocument::only_element() const {
  pugi::xml_node robot;
  for (const pugi::xml_node& node : document_.children()) {
    if (node.type() == pugi::node_doctype)
      throw ModelError(place(node.value()), "a DOCTYPE is not read", "URDF without DOCTYPE and entities");
    if (node.type() != pugi::node_element) continue;
    if (robot) throw ModelError(where(node), "a second element beside <robot>", "one <robot> element");
    if (name_of(node) != "robot")
      throw ModelError(where(node), "the file's element is <" + symbolic::shortened(node.name()) + ">", "<robot>");
    robot = node;
  }
  return robot;
}

// Without recursion: the depth is the file's.
void UrdfDocument::check_elements() const {
  int depth = 0;
  for (pugi::xml_node node = robot_; node;) {
    if (node.type() == pugi::node_element) {
      if (depth > kMaxDepth)
        throw ModelError(where(node), "elements are nested too deeply",
                         "at most " + std::to_string(kMaxDepth) + " inside one another");
      check_attributes(node);
    }
    if (node.first_child()) {
      node = node.first_child();
      ++depth;
      continue;
    }
    while (node != robot_ && !node.next_sibling()) {
      node = node.parent();
      --depth;
    }
    if (node == robot_) break;
    node = node.next_sibling();
  }
}

void UrdfDocument::check_attributes(const pugi::xml_node& element) const {
  if (name_of(element).starts_with("xacro:"))
    throw ModelError(where(element), "<" + symbolic::shortened(element.name()) + "> is xacro", kRunXacro);
  std::set<std::string_view> names;
  for (const pugi::xml_attribute& attribute : element.attributes()) {
    if (!names.insert(attribute.name()).second)
      throw ModelError(where(attribute), "the attribute " + in_quotes(attribute.name()) + " is written twice in one element",
                       "it once");
    const std::string_view value = attribute.value();
    if (std::ranges::any_of(value, [](char c) { return static_cast<unsigned char>(c) < ' '; }))
      throw ModelError(where(attribute), "a control character in an attribute", "visible characters and blanks");
    if (value.find("${") != std::string_view::npos || value.find("$(") != std::string_view::npos)
      throw ModelError(where(attribute), in_quotes(value) + " is xacro", kRunXacro);
    check_entities(attribute);
  }
}

// pugixml leaves a reference to an entity that it does not know as it is.
void UrdfDocument::check_entities(const pugi::xml_attribute& attribute) const {
  const std::size_t begin = attribute.value() - buffer_.data();
  if (begin == 0 || begin > text_.size()) return;
  const std::string_view written = std::string_view(text_).substr(begin, text_.find(text_[begin - 1], begin) - begin);
  for (std::size_t i = written.find('&'); i != std::string_view::npos; i = written.find('&', i + 1)) {
    const std::string_view reference = written.substr(i + 1, written.find_first_of("; \t\r\n", i) - i - 1);
    if (reference.starts_with('#') || std::ranges::find(kEntities, reference) != kEntities.end()) continue;
    throw ModelError(place_at(begin + i), "the entity " + in_quotes(reference) + " is unknown",
                     "&amp; for the character &: a file's own entities are not read");
  }
}

symbolic::SourceLocation UrdfDocument::place(const char* in_buffer) const {
  const std::less<const char*> before;
  if (before(in_buffer, buffer_.data()) || before(buffer_.data() + buffer_.size(), in_buffer)) return {file_, 0, 0};
  return place_at(in_buffer - buffer_.data());
}

symbolic::SourceLocation UrdfDocument::place_at(std::size_t offset) const {
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  return {file_, static_cast<int>(next - line_starts_.begin()), static_cast<int>(offset - *(next - 1)) + 1};
}

}  // namespace corank::kinematics
