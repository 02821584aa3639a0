#include "corank/kinematics/urdf/urdf_reading.h"

#include <algorithm>
#include <set>

#include "corank/kinematics/robot/vectors.h"
#include "corank/symbolic/model/expression_words.h"

namespace corank::kinematics {
namespace {

using symbolic::in_quotes;
using symbolic::ModelError;
using symbolic::nearest_name;
using symbolic::suggestion;

constexpr std::size_t kMaxNotices = 100;

bool is_fit(std::string_view name) { return symbolic::is_identifier(name) && !symbolic::is_reserved(name); }

}  // namespace

std::string_view UrdfReading::required(const pugi::xml_node& element, const char* attribute,
                                       const std::string& owner) const {
  const std::string_view text = element.attribute(attribute).value();
  if (text.empty())
    throw ModelError(where(element), owner + " has no " + attribute,
                     "<" + std::string(element.name()) + " " + attribute + "=\"…\">");
  return text;
}

pugi::xml_node UrdfReading::only_child(const pugi::xml_node& element, const char* name) const {
  const pugi::xml_node child = element.child(name);
  if (const pugi::xml_node second = child ? child.next_sibling(name) : pugi::xml_node())
    throw ModelError(where(second), "a second <" + std::string(name) + "> in one <" + element.name() + ">",
                     "one, such as that of line " + std::to_string(where(child).line));
  return child;
}

void UrdfReading::allow_attributes(const pugi::xml_node& element, std::initializer_list<std::string_view> names) const {
  for (const pugi::xml_attribute& attribute : element.attributes()) {
    const std::string_view name = attribute.name();
    if (name.find(':') != std::string_view::npos || std::ranges::find(names, name) != names.end()) continue;
    throw ModelError(where(attribute), "<" + std::string(element.name()) + "> has an unknown attribute " + in_quotes(name),
                     symbolic::joined({names.begin(), names.end()}));
  }
}

void UrdfReading::allow_children(const pugi::xml_node& element, std::initializer_list<std::string_view> names) {
  for (const pugi::xml_node& child : element.children()) {
    if (child.type() != pugi::node_element) continue;
    const std::string_view name = child.name();
    if (std::ranges::find(names, name) != names.end()) continue;
    if (const std::string meant = nearest_name(std::string(name), {names.begin(), names.end()}); !meant.empty())
      throw ModelError(where(child), "an unknown element <" + symbolic::shortened(name) + ">",
                       "<" + meant + ">, or another name");
    notice("<" + symbolic::shortened(name) + "> in a <" + element.name() + "> passed over");
  }
}

std::optional<UrdfNumber> UrdfReading::number(const pugi::xml_node& element, const char* attribute,
                                              const std::string& what) const {
  const pugi::xml_attribute found = element.attribute(attribute);
  if (!found) return {};
  return urdf_number(found.value(), where(found), what);
}

std::optional<UrdfNumber> UrdfReading::angle(const pugi::xml_node& element, const char* attribute, const std::string& what) {
  const pugi::xml_attribute found = element.attribute(attribute);
  if (!found) return {};
  UrdfNumber number = urdf_angle(found.value(), where(found), what);
  if (!number.reading.empty()) notice(std::string(attribute) + " " + number.reading);
  return number;
}

Pose UrdfReading::origin(const pugi::xml_node& element, const std::string& owner) {
  Pose pose;
  const pugi::xml_node origin = only_child(element, "origin");
  if (!origin) return pose;
  allow_attributes(origin, {"xyz", "rpy"});
  if (const pugi::xml_attribute xyz = origin.attribute("xyz")) {
    const auto numbers = urdf_numbers(xyz.value(), where(xyz), "xyz of " + owner, urdf_number);
    for (std::size_t i = 0; i < 3; ++i) pose.translation[i] = numbers[i].value;
  }
  const pugi::xml_attribute rpy = origin.attribute("rpy");
  if (!rpy) return pose;
  const auto angles = urdf_numbers(rpy.value(), where(rpy), "rpy of " + owner, urdf_angle);
  for (const UrdfNumber& angle : angles)
    if (!angle.reading.empty()) notice("rpy " + angle.reading);
  const auto about = [&](int axis) { return rotation(axis, exact_cos(angles[axis]), exact_sin(angles[axis])); };
  pose.rotation = (about(2) * about(1) * about(0)).rotation;
  return pose;
}

void UrdfReading::notice(const std::string& sentence, int times) {
  const auto [at, is_new] = notice_index_.try_emplace(sentence, notices_.size());
  if (is_new) notices_.emplace_back(sentence, 0);
  notices_[at->second].second += times;
}

std::vector<std::string> UrdfReading::notices() const {
  std::vector<std::string> sentences;
  for (const auto& [sentence, times] : notices_) {
    if (sentences.size() == kMaxNotices) {
      sentences.push_back("and " + std::to_string(notices_.size() - kMaxNotices) + " more notices");
      break;
    }
    sentences.push_back(sentence + (times > 1 ? ", " + std::to_string(times) + " times" : ""));
  }
  return sentences;
}

std::size_t UrdfNames::add(const pugi::xml_node& element) {
  const std::string_view name = reading_.required(element, "name", "a " + what_);
  const auto [at, is_new] = index_.try_emplace(name, list_.size());
  if (!is_new)
    throw ModelError(reading_.where(element.attribute("name")), "a second " + what_ + " called " + in_quotes(name),
                     "each name once; the first is in line " + std::to_string(lines_[at->second]));
  list_.push_back(name);
  lines_.push_back(reading_.where(element).line);
  return list_.size() - 1;
}

std::size_t UrdfNames::find(const pugi::xml_node& element, const char* attribute, const std::string& owner) const {
  const std::string_view name = reading_.required(element, attribute, owner);
  const auto found = index_.find(name);
  if (found != index_.end()) return found->second;
  throw ModelError(
      reading_.where(element.attribute(attribute)), "there is no " + what_ + " " + in_quotes(name),
      "the name of a <" + what_ + "> of this file" + suggestion(std::string(name), {list_.begin(), list_.end()}));
}

std::vector<std::string> UrdfNames::identifiers() {
  std::set<std::string, std::less<>> taken;
  std::map<std::string, int> numbers;
  for (std::string_view name : list_)
    if (is_fit(name)) taken.emplace(name);
  std::vector<std::string> result;
  for (std::string_view name : list_) {
    if (is_fit(name)) {
      result.emplace_back(name);
      continue;
    }
    std::string fit;
    for (const char c : name) fit += symbolic::is_identifier(std::string("_") + c) ? c : '_';
    if (!is_fit(fit)) fit = what_ + "_" + fit;
    const std::string base = fit;
    int& number = numbers[base];
    while (!taken.insert(fit).second) fit = base + "_" + std::to_string(++number + 1);
    reading_.notice("the " + what_ + " " + in_quotes(name) + " is called " + fit);
    result.push_back(std::move(fit));
  }
  return result;
}

Vector turned(const Pose& pose, const Vector& direction) {
  return {dot(pose.rotation[0], direction), dot(pose.rotation[1], direction), dot(pose.rotation[2], direction)};
}

Vector moved_point(const Pose& pose, const Vector& point) {
  Vector moved = turned(pose, point);
  for (std::size_t i = 0; i < 3; ++i) moved[i] = folded_sum(moved[i], pose.translation[i]);
  return moved;
}

}  // namespace corank::kinematics
