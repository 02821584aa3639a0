#include "corank/kinematics/urdf_reading.h"

#include <algorithm>

#include "corank/symbolic/expression_words.h"

namespace corank::kinematics {
namespace {

using symbolic::in_quotes;
using symbolic::ModelError;

constexpr std::size_t kMaxNotices = 100;

// Of texts of at most 64 bytes: letters changed, left out or put in.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  a = a.substr(0, 64);
  b = b.substr(0, 64);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

Expression dot(const Vector& a, const Vector& b) {
  return tidy_sum(tidy_sum(tidy_product(a[0], b[0]), tidy_product(a[1], b[1])), tidy_product(a[2], b[2]));
}

std::string listed(std::initializer_list<std::string_view> names) {
  std::string text;
  for (std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

}  // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string_view>& names) {
  std::string_view nearest;
  std::size_t least = 1 + std::max<std::size_t>(1, name.size() / 3);
  for (std::string_view other : names) {
    const std::size_t longer = std::max(name.size(), other.size()), shorter = std::min(name.size(), other.size());
    if (longer - shorter >= least) continue;
    const std::size_t distance = edit_distance(name, other);
    if (distance >= least || distance >= shorter) continue;
    least = distance;
    nearest = other;
  }
  return std::string(nearest);
}

std::string suggestion(std::string_view name, const std::vector<std::string_view>& names, const std::string& otherwise) {
  const std::string nearest = nearest_name(name, names);
  return nearest.empty() ? otherwise : in_quotes(nearest) + ", or " + otherwise;
}

std::string_view UrdfReading::required(const pugi::xml_node& element, const char* attribute,
                                       const std::string& owner) const {
  const std::string_view text = element.attribute(attribute).value();
  if (text.empty()) {
    throw ModelError(where(element), owner + " has no " + attribute,
                     "<" + std::string(element.name()) + " " + attribute + "=\"…\">");
  }
  return text;
}

pugi::xml_node UrdfReading::only_child(const pugi::xml_node& element, const char* name) const {
  const pugi::xml_node child = element.child(name);
  if (const pugi::xml_node second = child ? child.next_sibling(name) : pugi::xml_node()) {
    throw ModelError(where(second), "a second <" + std::string(name) + "> in one <" + element.name() + ">",
                     "one, such as that of line " + std::to_string(where(child).line));
  }
  return child;
}

void UrdfReading::allow_attributes(const pugi::xml_node& element, std::initializer_list<std::string_view> names) const {
  for (const pugi::xml_attribute& attribute : element.attributes()) {
    const std::string_view name = attribute.name();
    if (name.find(':') != std::string_view::npos || std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw ModelError(where(attribute), "<" + std::string(element.name()) + "> has an unknown attribute " + in_quotes(name),
                     listed(names));
  }
}

void UrdfReading::allow_children(const pugi::xml_node& element, std::initializer_list<std::string_view> names) {
  for (const pugi::xml_node& child : element.children()) {
    if (child.type() != pugi::node_element) continue;
    const std::string_view name = child.name();
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    for (std::string_view known : names) {
      if (name.size() >= 4 && edit_distance(name, known) <= 2) {
        throw ModelError(where(child), "an unknown element <" + symbolic::shortened(name) + ">",
                         "<" + std::string(known) + ">, or another name");
      }
    }
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
  const auto times = [](const auto&... factors) {
    Expression product = 1;
    ((product = tidy_product(product, factors)), ...);
    return product;
  };
  const Expression cr = exact_cos(angles[0]), sr = exact_sin(angles[0]);
  const Expression cp = exact_cos(angles[1]), sp = exact_sin(angles[1]);
  const Expression cy = exact_cos(angles[2]), sy = exact_sin(angles[2]);
  pose.rotation = {{{times(cy, cp), tidy_sum(times(cy, sp, sr), tidy_negation(times(sy, cr))),
                     tidy_sum(times(cy, sp, cr), times(sy, sr))},
                    {times(sy, cp), tidy_sum(times(sy, sp, sr), times(cy, cr)),
                     tidy_sum(times(sy, sp, cr), tidy_negation(times(cy, sr)))},
                    {tidy_negation(sp), times(cp, sr), times(cp, cr)}}};
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
      sentences.push_back("and " + std::to_string(notices_.size() - kMaxNotices) + " notices more");
      break;
    }
    sentences.push_back(sentence + (times > 1 ? ", " + std::to_string(times) + " times" : ""));
  }
  return sentences;
}

Vector turned(const Pose& pose, const Vector& direction) {
  return {dot(pose.rotation[0], direction), dot(pose.rotation[1], direction), dot(pose.rotation[2], direction)};
}

Vector moved_point(const Pose& pose, const Vector& point) {
  Vector moved = turned(pose, point);
  for (std::size_t i = 0; i < 3; ++i) moved[i] = tidy_sum(moved[i], pose.translation[i]);
  return moved;
}

}  // namespace corank::kinematics
