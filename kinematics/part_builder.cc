#include "corank/kinematics/part_builder.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "corank/kinematics/nearest_name.h"
#include "corank/kinematics/off_file.h"
#include "corank/kinematics/vectors.h"
#include "corank/symbolic/expression_words.h"
#include "corank/symbolic/model_file.h"

namespace corank::kinematics {

using symbolic::in_quotes;
using symbolic::ModelError;

std::string small_letters(std::string_view word) {
  std::string result(word);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

PartBuilder::PartBuilder(const std::string& file_, std::optional<std::filesystem::path> folder_given)
    : ModelBuilder(file_), folder_(std::move(folder_given)) {
  const std::filesystem::path path(file_);
  is_world_ = path.extension() == ".world";
  robot.file = file_;
  robot.name = path.stem().string();
}

void PartBuilder::pass_over(const std::string& what) {
  for (auto& [passed, count] : passed_over_) {
    if (passed != what) continue;
    ++count;
    return;
  }
  passed_over_.emplace_back(what, 1);
}

std::string PartBuilder::resolve(std::string_view name_read) const {
  std::string result = prefix_;
  for (char c : name_read) result += c == ':' ? '_' : c;  // a::b is a__b
  return result;
}

void PartBuilder::push_constant(std::string_view name_read, const SourceLocation& where) {
  if (small_letters(name_read) == "pi") {
    expressions.symbol("pi", where);
    return;
  }
  const std::string resolved = resolve(name_read);
  if (!scope.has(resolved)) {
    throw ModelError(where, "the constant " + in_quotes(name_read) + " is not defined before",
                     "a constant of [CONSTANTS]" + suggestion(resolved, scope.names()));
  }
  expressions.symbol(resolved, where);
}

void PartBuilder::define_constant() {
  const symbolic::Constant constant{resolve(declared), pop_value(), declared_where};
  if (scope.has(constant.name)) {
    const auto first = std::find_if(robot.constants.begin(), robot.constants.end(),
                                    [&](const symbolic::Constant& c) { return c.name == constant.name; });
    throw ModelError(
        declared_where,
        "the constant " + in_quotes(declared) + " is already defined in line " + std::to_string(first->where.line),
        "another name for the constant");
  }
  scope.define(constant);
  robot.constants.push_back(constant);
}

// ---- points

Expression PartBuilder::pop_value() {
  Expression value = std::move(values.back());
  values.pop_back();
  return value;
}

Vector PartBuilder::pop_vector() {
  Vector v;
  for (std::size_t i = 3; i-- > 0;) v[i] = pop_value();
  return v;
}

void PartBuilder::push_offset(const SourceLocation& where) {
  const Vector way = pop_vector();
  points.push_back({points.back().at + way, way, where});
}

const PartBuilder::LinkData* PartBuilder::current() const { return link_ ? &link_data_[*link_] : nullptr; }

void PartBuilder::push_vertex(std::string_view digits, const SourceLocation& where) {
  if (!link_) throw ModelError(where, "found a number where a point should stand", "(x, y, z)");
  const std::string& owner = robot.links[*link_].name;
  std::array<std::size_t, 2> number{0, 0};  // body, vertex
  const std::size_t colon = digits.find(':');
  const auto read = [&](std::string_view part) {
    const std::size_t first = part.find_first_of("0123456789"), last = part.find_last_of("0123456789");
    part = part.substr(first, last - first + 1);
    std::size_t n = 0;
    const auto parsed = std::from_chars(part.data(), part.data() + part.size(), n);
    return parsed.ec == std::errc() ? n : std::size_t(-1);
  };
  number[1] = read(colon == std::string_view::npos ? digits : digits.substr(colon + 1));
  if (colon != std::string_view::npos) number[0] = read(digits.substr(0, colon));
  const std::vector<Body>& bodies = current()->bodies;
  if (number[0] >= bodies.size()) {
    throw ModelError(where, "the link " + in_quotes(owner) + " has no body " + std::to_string(number[0]),
                     bodies.empty() ? "a point (x, y, z): the link has no bodies"
                                    : "a body from 0 to " + std::to_string(bodies.size() - 1));
  }
  const Body& body = bodies[number[0]];
  if (!body.is_read) {
    throw ModelError(where,
                     "the vertex " + std::to_string(number[1]) + " of the body " + in_quotes(body.file) + " of the link " +
                         in_quotes(owner) + " is needed, but the body's file is not there",
                     "the file, or a point (x, y, z)");
  }
  if (number[1] >= body.vertices.size()) {
    throw ModelError(where,
                     "the body " + std::to_string(number[0]) + " of the link " + in_quotes(owner) + " has no vertex " +
                         in_quotes(std::string(digits)),
                     body.vertices.empty() ? std::string("a point (x, y, z)")
                                           : "a vertex from 0 to " + std::to_string(body.vertices.size() - 1));
  }
  points.push_back({body.vertices[number[1]], {}, where});
}

const Vector* PartBuilder::find_point(std::size_t link, const std::string& point) const {
  for (const auto& [known, at] : link_data_[link].points) {
    if (known == point) return &at;
  }
  return nullptr;
}

void PartBuilder::push_named_point(const std::string& point, const SourceLocation& where) {
  if (!link_) throw ModelError(where, "the point " + in_quotes(point) + " belongs to no link", "(x, y, z)");
  if (const Vector* at = find_point(*link_, point)) {
    points.push_back({*at, {}, where});
    return;
  }
  const std::string& owner = robot.links[*link_].name;
  if (robot.find_link(resolve(point)) >= 0 && !draft.kind.empty()) {
    throw ModelError(where,
                     "the end of " + draft.described() + " on the link " + in_quotes(owner) + " has " +
                         (points.size() % 2 == 1 ? "one point" : "no point"),
                     points.size() % 2 == 1 ? "two points of the axis: P Q, or P + (direction)" : "a point of the link");
  }
  std::vector<std::string> known;
  for (const auto& [name_known, at] : link_data_[*link_].points) known.push_back(name_known);
  throw ModelError(where, "the link " + in_quotes(owner) + " has no point " + in_quotes(point),
                   "(x, y, z), or a point named in the link" + suggestion(point, known));
}

void PartBuilder::finish_transform() {
  std::vector<Expression> arguments(values.begin() + static_cast<std::ptrdiff_t>(values_before_transform), values.end());
  values.resize(values_before_transform);
  const std::string& word = transform_name;
  const std::size_t wanted = word == "txyz" ? 3 : word == "tr" ? 12 : 1;
  if (arguments.size() != wanted) {
    throw ModelError(transform_where,
                     "the transformation " + in_quotes(word) + " has " + std::to_string(arguments.size()) + " numbers",
                     word == "tr" ? "12 numbers, the rows of a rotation matrix each with its translation behind it"
                                  : std::to_string(wanted));
  }
  Pose step;
  const int axis = word.back() - 'x';
  if (word == "txyz") {
    step = translation({arguments[0], arguments[1], arguments[2]});
  } else if (word == "tr") {
    for (std::size_t i = 0; i < 3; ++i) {
      step.rotation[i] = {arguments[4 * i], arguments[4 * i + 1], arguments[4 * i + 2]};
      step.translation[i] = arguments[4 * i + 3];
    }
  } else if (word[0] == 't') {
    step.translation[static_cast<std::size_t>(axis)] = arguments[0];
  } else {
    step = rotation(axis, arguments[0]);
  }
  draft.pose = draft.pose * (transform_is_inverse ? inverse(step) : step);
  transform_is_inverse = false;
}

// ---- colours

void PartBuilder::begin_colour() {
  rgb = {0, 0, 0};
  colour_factor = 1;
}

void PartBuilder::add_colour(const std::array<double, 3>& part) {
  for (std::size_t i = 0; i < 3; ++i) rgb[i] += colour_factor * part[i];
  colour_factor = 1;
}

void PartBuilder::finish_colour() {
  const char* const digits = "0123456789abcdef";
  colour = "#";
  for (double part : rgb) {
    const double limited = part >= 0 ? std::min(part, 1.0) : 0.0;  // also what is no number
    const int byte = static_cast<int>(std::lround(255 * limited));
    colour += digits[byte / 16];
    colour += digits[byte % 16];
  }
}

// ---- links and shapes

std::vector<std::string> PartBuilder::link_names() const {
  std::vector<std::string> names;
  for (const Link& link : robot.links) names.push_back(link.name);
  return names;
}

std::vector<std::string> PartBuilder::joint_names() const {
  std::vector<std::string> names;
  for (const Joint& joint : robot.joints) names.push_back(joint.name);
  return names;
}

void PartBuilder::begin_link(const std::string& name_read, const SourceLocation& where) {
  const std::string link = resolve(name_read);
  if (const int same = robot.find_link(link); same >= 0) {
    const SourceLocation& first = robot.links[static_cast<std::size_t>(same)].where;
    throw ModelError(where, "the link " + in_quotes(name_read) + " is already there, in line " + std::to_string(first.line),
                     "another name for the link");
  }
  if (scope.has(link))
    throw ModelError(where, "the link " + in_quotes(name_read) + " has the name of a constant", "another name for the link");
  robot.links.push_back({link, {}, where});
  link_data_.emplace_back();
  link_ = robot.links.size() - 1;
  link_colour.clear();
  draft = {};
}

void PartBuilder::finish_named_point() {
  const Vector at = pop_vector();
  if (find_point(*link_, declared) != nullptr) {
    throw ModelError(declared_where,
                     "the link " + in_quotes(robot.links[*link_].name) + " has already a point " + in_quotes(declared),
                     "another name for the point");
  }
  link_data_[*link_].points.emplace_back(declared, at);
}

void PartBuilder::add_body(Body body) {
  if (!in_obstacles) link_data_[*link_].bodies.push_back(std::move(body));
}

void PartBuilder::finish_shape(Shape::Kind shape_kind, std::vector<Vector> shape_points, const Expression& radius) {
  if (!hidden && !in_obstacles) {
    Shape shape;
    shape.kind = shape_kind;
    shape.points = std::move(shape_points);
    shape.radius = radius;
    shape.colour = shape_colour.empty() ? link_colour : shape_colour;
    shape.where = robot.links[*link_].where;
    robot.links[*link_].shapes.push_back(std::move(shape));
  }
}

void PartBuilder::finish_body() {
  Body body;
  body.file = quoted;
  if (folder_ && !in_obstacles) {
    const std::filesystem::path path = *folder_ / quoted;
    std::error_code error;
    body.is_read = std::filesystem::is_regular_file(path, error);
    if (body.is_read) {
      OffBody off = parse_off(symbolic::read_text(path), path.string());
      if (off.faces.size() > kMaxFaces) {
        pass_over("bodies of more than " + std::to_string(kMaxFaces) + " faces, which are not drawn");
      } else {
        for (const std::vector<std::size_t>& face : off.faces) {
          std::vector<Vector> corners;
          for (std::size_t corner : face) corners.push_back(off.vertices[corner]);
          if (corners.size() > 1) finish_shape(Shape::Kind::polygon, std::move(corners), 0);
        }
      }
      body.vertices = std::move(off.vertices);
    }
  } else {
    body.is_read = false;
  }
  if (!body.is_read && !in_obstacles) pass_over("bodies whose files are not there");
  add_body(std::move(body));
}

void PartBuilder::finish_box() {
  const Vector a = points[0].at, b = points[1].at;
  std::vector<Vector> v;
  for (const Vector& z : {a, b}) {
    v.insert(v.end(), {{a[0], a[1], z[2]}, {a[0], b[1], z[2]}, {b[0], b[1], z[2]}, {b[0], a[1], z[2]}});
  }
  for (const std::array<std::size_t, 4>& f :
       {std::array<std::size_t, 4>{0, 1, 2, 3}, {6, 5, 4, 7}, {3, 2, 6, 7}, {2, 1, 5, 6}, {4, 5, 1, 0}, {0, 3, 7, 4}}) {
    finish_shape(Shape::Kind::polygon, {v[f[0]], v[f[1]], v[f[2]], v[f[3]]}, 0);
  }
  add_body({"", true, v});
}

void PartBuilder::finish_prism() {
  const Expression height = pop_value();
  std::vector<Vector> v;
  for (const ReadPoint& p : points) v.push_back(p.at);
  const Vector normal = cross(v[1] - v[0], v[2] - v[0]);
  const Expression factor = height / symbolic::sqrt(dot(normal, normal));
  for (std::size_t i = 0; i < 3; ++i) {
    Vector top;
    for (std::size_t k = 0; k < 3; ++k) top[k] = folded_sum(v[i][k], folded_product(factor, normal[k]));
    v.push_back(top);
  }
  finish_shape(Shape::Kind::polygon, {v[0], v[1], v[2]}, 0);
  finish_shape(Shape::Kind::polygon, {v[5], v[4], v[3]}, 0);
  for (const std::array<std::size_t, 2>& side : {std::array<std::size_t, 2>{0, 1}, {1, 2}, {2, 0}}) {
    finish_shape(Shape::Kind::polygon, {v[side[0] + 3], v[side[1] + 3], v[side[1]], v[side[0]]}, 0);
  }
  add_body({"", true, v});
}

void PartBuilder::finish_sphere() {
  const Vector centre = points[0].at;
  finish_shape(Shape::Kind::sphere, {centre}, pop_value());
  add_body({"", true, {centre}});
}

void PartBuilder::finish_cylinder() {
  const std::vector<Vector> ends{points[0].at, points[1].at};
  finish_shape(Shape::Kind::cylinder, ends, pop_value());
  add_body({"", true, ends});
}

void PartBuilder::finish_line() {
  const std::vector<Vector> ends{points[0].at, points[1].at};
  finish_shape(Shape::Kind::polygon, ends, 0);
  add_body({"", true, ends});
}

void PartBuilder::finish_segments() {
  std::vector<Vector> ends;
  for (const ReadPoint& p : points) ends.push_back(p.at);
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) finish_shape(Shape::Kind::polygon, {ends[i], ends[i + 1]}, 0);
  add_body({"", true, ends});
}

// ---- the other sections

std::size_t PartBuilder::require_link(const std::string& link, const SourceLocation& where,
                                      const std::string& expectation) const {
  const int found = robot.find_link(link);
  if (found < 0) {
    throw ModelError(where, "there is no link " + in_quotes(link), expectation + suggestion(link, link_names()));
  }
  return static_cast<std::size_t>(found);
}

std::size_t PartBuilder::require_joint(const std::string& joint, const SourceLocation& where,
                                       const std::string& expectation) const {
  const int found = robot.find_joint(joint);
  if (found < 0) {
    throw ModelError(where, "there is no joint " + in_quotes(joint), expectation + suggestion(joint, joint_names()));
  }
  return static_cast<std::size_t>(found);
}

void PartBuilder::add_input(std::string_view name_read, const SourceLocation& where) {
  const std::string joint = resolve(name_read);
  for (const NamedInput& known : named_inputs_) {
    if (known.joint == joint)
      throw ModelError(where, "the joint " + in_quotes(joint) + " is an input already", "each input once");
  }
  named_inputs_.push_back({joint, where});
}

void PartBuilder::finish_output() {
  output.name = resolve(output.name);
  outputs_.push_back(output);
}

void PartBuilder::resolve_outputs() {
  for (const OutputDraft& read : outputs_) {
    Output result;
    result.name = read.name;
    result.where = read.where;
    if (read.kind == "joint") {
      result.kind = Output::Kind::joint;
      result.joint = require_joint(read.joint, read.joint_where, "the name of a joint");
      robot.outputs.push_back(std::move(result));
      continue;
    }
    result.kind = read.kind == "position"      ? Output::Kind::position
                  : read.kind == "pose"        ? Output::Kind::pose
                  : read.kind == "orientation" ? Output::Kind::orientation
                                               : Output::Kind::direction;
    result.link = require_link(read.link, read.link_where, "the name of a link");
    if (!read.frame.empty()) result.relative_to = require_link(read.frame, read.frame_where, "the name of a link");
    if (result.kind == Output::Kind::direction && !read.vector)
      throw ModelError(read.where, "the direction of " + in_quotes(read.name) + " is not given",
                       "direction of link (x, y, z)");
    if (result.kind == Output::Kind::orientation && (read.vector || !read.point.empty()))
      throw ModelError(read.where, "the orientation of " + in_quotes(read.name) + " is given with a point",
                       "orientation of link");
    if (result.kind == Output::Kind::direction && !read.point.empty())
      throw ModelError(read.where, "the direction of " + in_quotes(read.name) + " is given as a point",
                       "direction of link (x, y, z)");
    if (read.vector) result.point = *read.vector;
    if (!read.point.empty()) {
      const Vector* const at = find_point(result.link, read.point);
      std::vector<std::string> known;
      for (const auto& [point, place] : link_data_[result.link].points) known.push_back(point);
      if (at == nullptr) {
        throw ModelError(read.point_where, "the link " + in_quotes(read.link) + " has no point " + in_quotes(read.point),
                         "a point that the link names, or " + read.kind + " of " + read.link + " (x, y, z)" +
                             suggestion(read.point, known));
      }
      result.point = *at;
    }
    robot.outputs.push_back(std::move(result));
  }
}

void PartBuilder::include(const std::string& prefix_read) {
  if (!folder_) {
    throw ModelError(quoted_where, "the file " + in_quotes(quoted) + " cannot be included: this text has no folder",
                     "a robot read from a file");
  }
  const std::filesystem::path path = *folder_ / quoted;
  std::error_code error;
  const std::filesystem::path real = std::filesystem::weakly_canonical(path, error);
  const std::string key = error ? path.string() : real.string();
  if (std::find(open_files_.begin(), open_files_.end(), key) != open_files_.end()) {
    throw ModelError(quoted_where, "the file " + in_quotes(quoted) + " includes itself, directly or through others",
                     "a file that does not include this one");
  }
  if (open_files_.size() >= kMaxIncludeDepth || ++includes_ > kMaxIncludes) {
    throw ModelError(
        quoted_where, "too many files are included",
        "at most " + std::to_string(kMaxIncludes) + ", " + std::to_string(kMaxIncludeDepth) + " inside one another");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    throw ModelError(quoted_where, "the included file " + in_quotes(quoted) + " is not there",
                     "a file of links and joints in " + folder_->string());
  }
  const std::string text_included = symbolic::read_text(path);
  const auto saved = std::tuple(file, folder_, prefix_, text);
  file = path.string();
  folder_ = path.parent_path();
  prefix_ += prefix_read + "__";
  open_files_.push_back(key);
  parse_included(text_included);
  open_files_.pop_back();
  std::tie(file, folder_, prefix_, text) = saved;
}

void PartBuilder::read_equations() {
  const std::string what = quoted_where.text() + ": the equations of " + in_quotes(quoted) + ": ";
  if (!folder_) {
    robot.missing.push_back(what + "this text has no folder");
    return;
  }
  const std::filesystem::path path = *folder_ / quoted;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    robot.missing.push_back(what + "there is no such file");
    return;
  }
  const symbolic::Mechanism read = symbolic::parse_fragment(symbolic::read_text(path), path.string());
  if (!read.coordinates().empty()) {
    robot.missing.push_back(what + "it declares variables of its own");
    return;
  }
  for (const symbolic::Constant& constant : read.constants()) {
    scope.define(constant);
    robot.constants.push_back(constant);
  }
  robot.equations.insert(robot.equations.end(), read.constraints().begin(), read.constraints().end());
}

// The suite's files hold links that no joint holds, to be looked at, or to float freely: neither is part of a mechanism.
void PartBuilder::leave_out_unconnected_links() {
  std::vector<bool> held(robot.links.size(), false);
  if (!held.empty()) held[0] = true;
  for (bool grows = true; grows;) {
    grows = false;
    for (const Joint& joint : robot.joints) {
      const bool first = held[joint.ends[0].link], second = held[joint.ends[1].link];
      if (first == second) continue;
      held[joint.ends[0].link] = held[joint.ends[1].link] = grows = true;
    }
  }
  std::vector<std::size_t> index(held.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    index[i] = kept;
    if (held[i]) {
      if (kept != i) robot.links[kept] = std::move(robot.links[i]);
      ++kept;
    } else {
      robot.notices.push_back("the link " + in_quotes(robot.links[i].name) +
                              " is left out: no joint connects it with the ground");
    }
  }
  if (kept == held.size()) return;
  robot.links.resize(kept);
  std::erase_if(robot.joints, [&](const Joint& joint) { return !held[joint.ends[0].link]; });
  for (Joint& joint : robot.joints) {
    for (JointEnd& end : joint.ends) end.link = index[end.link];
  }
}

void PartBuilder::finish() {
  for (const NamedInput& input : named_inputs_) {
    Joint& joint = robot.joints[require_joint(input.joint, input.where, "the name of a joint")];
    if (joint.actuated) {
      throw ModelError(input.where, "the joint " + in_quotes(input.joint) + " is actuated already",
                       "`actuated` behind the joint, or the joint in [INPUTS]");
    }
    joint.actuated = true;
  }
  resolve_outputs();
  set_zero_directions();
  if (is_world_ && outputs_.empty()) leave_out_unconnected_links();
  for (const auto& [what, count] : passed_over_)
    robot.notices.push_back(what + (count == 1 ? ": once" : ": " + std::to_string(count) + " times"));
  robot.validate();
}

}  // namespace corank::kinematics
