// Points, transformations, colours, links and their shapes in the parts language.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "corank/kinematics/language/part_builder.h"
#include "corank/kinematics/robot/vectors.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::kinematics {

using symbolic::in_quotes;
using symbolic::ModelError;

namespace {

// Each factor of a product may treble the expressions.
constexpr std::size_t kMaxPoseNodes = 20'000;

// Counts up to a little above the limit only.
void count_nodes(const Expression& e, std::size_t& nodes) {
  if (++nodes > kMaxPoseNodes) return;
  for (const Expression& operand : e.operands()) count_nodes(operand, nodes);
}

}  // namespace

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

void PartBuilder::shift_point() {
  const Vector way = pop_vector();
  points.back().at = points.back().at + way;
  points.back().name.clear();
}

const Vector& PartBuilder::require_point(std::size_t link, const ReadName& point) const {
  if (const Vector* at = find_point(link, point.text)) return *at;
  constexpr std::size_t kMostNames = 8;
  std::string known;
  const auto& named = link_data_[link].points;
  for (std::size_t i = 0; i < named.size() && i < kMostNames; ++i) known += (i == 0 ? " " : ", ") + named[i].first;
  if (named.size() > kMostNames) known += " …";
  throw ModelError(point.where, "the link " + in_quotes(robot.links[link].name) + " has no point " + in_quotes(point.text),
                   "(x, y, z), or a point named in the link" + (known.empty() ? "" : ":" + known));
}

void PartBuilder::push_vertex(std::string_view digits, const SourceLocation& where) {
  if (!link_) throw ModelError(where, "found a number where a point should be", "(x, y, z)");
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
  const std::vector<Body>& bodies = link_data_[*link_].bodies;
  if (number[0] >= bodies.size())
    throw ModelError(where, "the link " + in_quotes(owner) + " has no body " + std::to_string(number[0]),
                     bodies.empty() ? "a point (x, y, z): the link has no bodies"
                                    : "a body from 0 to " + std::to_string(bodies.size() - 1));
  const Body& body = bodies[number[0]];
  if (!body.is_read)
    throw ModelError(where,
                     "the vertex " + std::to_string(number[1]) + " of the body " + in_quotes(body.file) + " of the link " +
                         in_quotes(owner) + " is needed, but the body's file is not there",
                     "the file, or a point (x, y, z)");
  if (number[1] >= body.vertices.size())
    throw ModelError(where,
                     "the body " + std::to_string(number[0]) + " of the link " + in_quotes(owner) + " has no vertex " +
                         in_quotes(std::string(digits)),
                     body.vertices.empty() ? std::string("a point (x, y, z)")
                                           : "a vertex from 0 to " + std::to_string(body.vertices.size() - 1));
  points.push_back({body.vertices[number[1]], {}, where});
}

const Vector* PartBuilder::find_point(std::size_t link, const std::string& point) const {
  for (const auto& [known, at] : link_data_[link].points)
    if (known == point) return &at;
  return nullptr;
}

void PartBuilder::push_named_point(const std::string& point, const SourceLocation& where) {
  if (!link_) throw ModelError(where, "the point " + in_quotes(point) + " belongs to no link", "(x, y, z)");
  if (find_point(*link_, point) == nullptr && robot.find_link(resolve(point)) >= 0 && !draft.kind.empty())
    throw ModelError(where,
                     "the end of " + draft.described() + " on the link " + in_quotes(robot.links[*link_].name) + " has " +
                         (points.size() % 2 == 1 ? "one point" : "no point"),
                     points.size() % 2 == 1 ? "two points of the axis: P Q, or P + (direction)" : "a point of the link");
  points.push_back({require_point(*link_, {point, where}), {}, where, point});
}

void PartBuilder::finish_transform() {
  std::vector<Expression> arguments(values.begin() + static_cast<std::ptrdiff_t>(values_before_transform), values.end());
  values.resize(values_before_transform);
  const std::string& word = transform_name;
  const std::size_t wanted = word == "txyz" ? 3 : word == "tr" ? 12 : 1;
  if (arguments.size() != wanted)
    throw ModelError(transform_where,
                     "the transformation " + in_quotes(word) + " has " + std::to_string(arguments.size()) + " numbers",
                     word == "tr" ? "12 numbers, the rows of a rotation matrix each followed by its translation"
                                  : std::to_string(wanted));
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
    step.translation[axis] = arguments[0];
  } else {
    step = rotation(axis, arguments[0]);
  }
  draft.pose = draft.pose * (transform_is_inverse ? inverse(step) : step);
  transform_is_inverse = false;
  std::size_t nodes = 0;
  for (const Vector& row : draft.pose.rotation)
    for (const Expression& e : row) count_nodes(e, nodes);
  for (const Expression& e : draft.pose.translation) count_nodes(e, nodes);
  if (nodes > kMaxPoseNodes)
    throw ModelError(transform_where, "the product of transformations has grown too long",
                     "a shorter one, or fixed joints with links between them");
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

void PartBuilder::begin_link(const std::string& name_read, const SourceLocation& where) {
  const std::string link = resolve(name_read);
  if (const int same = robot.find_link(link); same >= 0) {
    const SourceLocation& first = robot.links[same].where;
    throw ModelError(where, "the link " + in_quotes(name_read) + " is already there, in line " + std::to_string(first.line),
                     "another name for the link");
  }
  if (scope.has(link))
    throw ModelError(where, "the link " + in_quotes(name_read) + " has the name of a constant", "another name for the link");
  robot.links.push_back({link, {}, where});
  link_data_.emplace_back();
  link_ = robot.links.size() - 1;
  link_colour.clear();
  shape_colour.clear();
  hidden = false;
  link_has_parts = false;
  draft = {};
}

void PartBuilder::finish_named_point() {
  const Vector at = pop_vector();
  if (find_point(*link_, declared) != nullptr)
    throw ModelError(declared_where,
                     "the link " + in_quotes(robot.links[*link_].name) + " has already a point " + in_quotes(declared),
                     "another name for the point");
  link_data_[*link_].points.emplace_back(declared, at);
}

void PartBuilder::add_body(Body body) {
  if (!in_obstacles) link_data_[*link_].bodies.push_back(std::move(body));
}

void PartBuilder::finish_shape(Shape::Kind shape_kind, std::vector<Vector> shape_points, const Expression& radius) {
  if (hidden || in_obstacles) return;
  const std::string& own = shape_colour.empty() ? link_colour : shape_colour;
  robot.links[*link_].shapes.push_back({shape_kind, std::move(shape_points), radius, own, shape_where});
}

void PartBuilder::finish_body() {
  Body body{quoted, false, {}};
  if (folder_ && !in_obstacles) {
    const std::filesystem::path path = *folder_ / quoted;
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) {
      body.is_read = true;
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
  }
  if (!body.is_read && !in_obstacles) pass_over("bodies whose files are not there");
  add_body(std::move(body));
}

void PartBuilder::finish_box() {
  const Vector a = points[0].at, b = points[1].at;
  std::vector<Vector> v;
  for (const Vector& z : {a, b})
    v.insert(v.end(), {{a[0], a[1], z[2]}, {a[0], b[1], z[2]}, {b[0], b[1], z[2]}, {b[0], a[1], z[2]}});
  for (const std::array<std::size_t, 4>& f :
       {std::array<std::size_t, 4>{0, 1, 2, 3}, {6, 5, 4, 7}, {3, 2, 6, 7}, {2, 1, 5, 6}, {4, 5, 1, 0}, {0, 3, 7, 4}}) {
    finish_shape(Shape::Kind::polygon, {v[f[0]], v[f[1]], v[f[2]], v[f[3]]}, 0);
  }
  add_body({"", true, v});
}

void PartBuilder::finish_prism() {
  const Expression height = pop_value();
  std::vector<Vector> v = read_points();
  const Vector normal = cross(v[1] - v[0], v[2] - v[0]);
  const Expression factor = height / symbolic::sqrt(dot(normal, normal));
  for (std::size_t i = 0; i < 3; ++i) {
    Vector top;
    for (std::size_t k = 0; k < 3; ++k) top[k] = folded_sum(v[i][k], folded_product(factor, normal[k]));
    v.push_back(top);
  }
  finish_shape(Shape::Kind::polygon, {v[0], v[1], v[2]}, 0);
  finish_shape(Shape::Kind::polygon, {v[5], v[4], v[3]}, 0);
  for (const std::array<std::size_t, 2>& side : {std::array<std::size_t, 2>{0, 1}, {1, 2}, {2, 0}})
    finish_shape(Shape::Kind::polygon, {v[side[0] + 3], v[side[1] + 3], v[side[1]], v[side[0]]}, 0);
  add_body({"", true, v});
}

std::vector<Vector> PartBuilder::read_points() const {
  std::vector<Vector> list;
  for (const ReadPoint& p : points) list.push_back(p.at);
  return list;
}

void PartBuilder::finish_solid(Shape::Kind shape_kind) {
  const std::vector<Vector> ends = read_points();
  finish_shape(shape_kind, ends, shape_kind == Shape::Kind::polygon ? 0 : pop_value());
  add_body({"", true, ends});
}

void PartBuilder::finish_segments() {
  const std::vector<Vector> ends = read_points();
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) finish_shape(Shape::Kind::polygon, {ends[i], ends[i + 1]}, 0);
  add_body({"", true, ends});
}

}  // namespace corank::kinematics
