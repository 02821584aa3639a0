#include "corank/report/pictures/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>

#include "corank/certify/angle.h"
#include "corank/symbolic/model/set_definition.h"

namespace corank::report {
namespace {

double rounded_down(long double x) {
  const auto nearest = static_cast<double>(x);
  return static_cast<long double>(nearest) > x ? std::nextafter(nearest, -HUGE_VAL) : nearest;
}

// The double below all that x may be.
std::optional<double> below(long double x) {
  const long double error = std::fabs(x) * 0x1p-60L;
  const double least = rounded_down(x - error);
  if (least != rounded_down(x + error)) return std::nullopt;
  return least;
}

constexpr double kTurn = 2 * std::numbers::pi;
const Interval kCircle(-std::numbers::pi, std::numbers::pi);
constexpr Color kNotSearched{0.93, 0.83, 0.45};

// A variable or an angle of one source.
struct Coordinate {
  int variable = -1;
  std::optional<Angle> angle;

  // The one piece, or the pieces, of a box.
  std::vector<Interval> values(const Box& box, double size) const {
    const auto side = [&](int v) { return box.at(v); };
    Interval x = angle ? drawn_angle(side(angle->cosine), side(angle->sine), angle->range) : side(variable);
    if (size > 0) x = Interval(x.mid() - size / 2, x.mid() + size / 2);
    return angle ? pieces(x) : std::vector<Interval>{x};
  }

 private:
  // The parts of x + 2πk, k any integer, in the angle's range.
  std::vector<Interval> pieces(const Interval& x) const {
    constexpr double kSliver = 1e-9;  // what sticks out by rounding only
    std::vector<Interval> parts;
    const Interval& range = angle->range;
    const double last = std::ceil((range.hi() - x.lo()) / kTurn);
    for (double k = std::floor((range.lo() - x.hi()) / kTurn); k <= last; ++k) {
      Interval turned(x.lo() + k * kTurn, x.hi() + k * kTurn);
      if (turned.intersect(range)) parts.push_back(turned);
    }
    if (parts.empty()) return {x};
    const auto wide = [](const Interval& part) { return part.width() > kSliver; };
    if (std::ranges::any_of(parts, wide))
      std::erase_if(parts, [&](const Interval& part) { return !wide(part); });
    else
      parts.resize(1);
    return parts;
  }
};

Coordinate coordinate(const PictureSource& source, const std::string& name) {
  if (const int variable = source.boxes.find(name); variable >= 0) return {variable, std::nullopt};
  for (Angle a : source.angles) {
    if (a.name != name) continue;
    if (a.range.width() > kTurn + 1e-9) a.range = kCircle;
    return {-1, a};
  }
  std::vector<std::string> names = source.boxes.variables;
  for (const Angle& a : source.angles) names.push_back(a.name);
  throw std::invalid_argument(fmt::format("{} has no variable '{}'; expected a number from 1 to {}{}", source.file, name,
                                          source.boxes.size(),
                                          names.empty() ? "" : fmt::format(" or one of {}", fmt::join(names, ", "))));
}

PictureAxis axis(const PictureSource& source, const Coordinate& from, const std::string& name) {
  if (from.angle) return {from.angle->name, "", true, from.angle->range};
  for (const Angle& a : source.angles)
    if (from.variable == a.cosine || from.variable == a.sine)
      return {.name = a.name, .function = from.variable == a.cosine ? "cos" : "sin"};
  const auto& names = source.boxes.variables;
  return {.name = names.empty() ? "x" + name : names.at(from.variable)};
}

// What the layers of a source are called and coloured where colours tell sets apart.
struct SetStyle {
  std::string label;
  Color color;
  double opacity = 1;
};

// The layer a box belongs to.
PictureLayer layer_of(const PictureSource& source, const SetStyle& style, ColorScheme scheme,
                      std::optional<Verdict> verdict) {
  PictureLayer layer{style.label, source.set, style.color, style.opacity, {}};
  if (scheme == ColorScheme::plain) layer.color = verdict_color(std::nullopt), layer.opacity = 1;
  if (scheme == ColorScheme::verdict) {
    layer.label = verdict ? to_string(*verdict) : "no verdict";
    layer.color = verdict_color(verdict);
  }
  if (scheme == ColorScheme::set && verdict == Verdict::pending) {
    layer.label += ", not searched";
    layer.color = kNotSearched, layer.opacity = 0.5;
  }
  return layer;
}

// What is less certain lies above what is more so.
int rank(const PictureLayer& layer) {
  static const std::vector<std::string> kOrder{"regular", "boundary", "isolated", "exact",
                                               "partial", "pending",  "undecided"};
  return static_cast<int>(std::ranges::find(kOrder, layer.label) - kOrder.begin());
}

void add_layers(const PictureSource& source, const SetStyle& style, const std::vector<Coordinate>& coordinates,
                const PictureOptions& options, const std::optional<Passage>& only, std::vector<PictureLayer>& layers) {
  const std::size_t begin = layers.size();
  if (options.color != ColorScheme::verdict) {
    layers.push_back(layer_of(source, style, options.color, std::nullopt));
    if (!only) layers.back().boxes.reserve(source.count() + source.count() / 4);  // some in two pieces; else all are moved
  }
  std::map<std::optional<Verdict>, std::size_t> index;
  for (std::size_t k = 0; k < source.count(); ++k) {
    if (only && source.passages[k] != *only) continue;
    const std::optional<Verdict> verdict = source.verdict(k);
    const bool own =
        options.color == ColorScheme::verdict || (options.color == ColorScheme::set && verdict == Verdict::pending);
    const auto [at, is_new] = index.try_emplace(verdict, own ? layers.size() : begin);
    if (is_new && own) layers.push_back(layer_of(source, style, options.color, verdict));
    std::vector<PictureBox> parts{{{}, verdict, static_cast<int>(k)}};
    for (std::size_t j = 0; j < coordinates.size(); ++j) {
      std::vector<PictureBox> next;
      for (const Interval& value : coordinates[j].values(source.box(k), options.size)) {
        for (PictureBox part : parts) {
          part.sides[j] = value;
          next.push_back(part);
        }
      }
      parts = std::move(next);
    }
    auto& boxes = layers[at->second].boxes;
    boxes.insert(boxes.end(), parts.begin(), parts.end());
  }
}

// Of a workspace boundary, where colours tell sets apart: the ways that are open, the barriers, what is not known.
void add_passages(const PictureSource& source, const SetStyle& style, const std::vector<Coordinate>& coordinates,
                  const PictureOptions& options, std::vector<PictureLayer>& layers) {
  constexpr Color kOpen{0.93, 0.60, 0.12}, kUnknown{0.45, 0.45, 0.47};
  for (const Passage passage : {Passage::traversable, Passage::barrier, Passage::unproven}) {
    if (std::ranges::find(source.passages, passage) == source.passages.end()) continue;
    SetStyle own = style;
    own.label += std::string(": ") + to_string(passage);
    if (passage != Passage::barrier) own.color = passage == Passage::traversable ? kOpen : kUnknown;
    add_layers(source, own, coordinates, options, passage, layers);
  }
}

// Strokes to the sides where barriers keep the output from going, in a picture of two of its coordinates. Of more than two
// only where that side is nearly in the picture's plane, as at the outline of what is seen.
void add_hatches(const PictureSource& source, const std::vector<Coordinate>& coordinates,
                 const std::vector<std::string>& axes, std::vector<PictureHatch>& hatches) {
  constexpr double kInPlane = 0.95;
  std::array<std::size_t, 2> place{};
  for (std::size_t j = 0; j < 2; ++j) {
    const auto at = std::ranges::find(source.outputs, axes[j]);
    if (at == source.outputs.end()) return;
    place[j] = at - source.outputs.begin();
  }
  for (std::size_t k = 0; k < source.count(); ++k) {
    if (source.passages[k] != Passage::barrier || source.sides[k].size() != source.outputs.size()) continue;
    PictureHatch hatch{};
    for (std::size_t j = 0; j < 2; ++j) {
      hatch.from[j] = coordinates[j].values(source.box(k), 0).front().mid();
      hatch.direction[j] = -source.sides[k][place[j]];
    }
    double square = 0;
    for (const double s : source.sides[k]) square += s * s;
    if (std::hypot(hatch.direction[0], hatch.direction[1]) >= kInPlane * std::sqrt(square)) hatches.push_back(hatch);
  }
}

SetStyle set_style(const PictureSource& source) {
  const symbolic::SetDefinition& set = symbolic::definition(source.set);
  // A surface is seen through; a curve of that colour would be too faint.
  return {*look(set).label ? look(set).label : std::filesystem::path(source.file).stem().string(), set_color(source.set),
          set.is_cspace() && source.dimension > 1 ? 0.4 : 1.0};
}

// Several sources of one set get their files' names and shades of its colour; several of other sets, colours of their own.
std::vector<SetStyle> set_styles(const std::vector<const PictureSource*>& sources) {
  static constexpr std::array<Color, 4> kOthers{
      {{0.35, 0.45, 0.58}, {0.85, 0.50, 0.10}, {0.15, 0.55, 0.40}, {0.55, 0.35, 0.25}}};
  std::vector<SetStyle> styles;
  for (const PictureSource* source : sources) styles.push_back(set_style(*source));
  std::size_t others = 0;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const auto same = [&](const PictureSource* s) { return s->set == sources[k]->set; };
    if (!symbolic::definition(sources[k]->set).set) {
      styles[k].color = kOthers[others++ % kOthers.size()];
    } else if (std::ranges::count_if(sources, same) > 1) {
      const double light =
          1 - std::pow(0.65, std::count_if(sources.begin(), sources.begin() + static_cast<std::ptrdiff_t>(k), same));
      styles[k].label += " (" + std::filesystem::path(sources[k]->file).stem().string() + ")";
      for (double* channel : {&styles[k].color.red, &styles[k].color.green, &styles[k].color.blue})
        *channel += light * (0.95 - *channel);
    }
  }
  return styles;
}

}  // namespace

Interval drawn_angle(const Interval& c, const Interval& s, const Interval& range) {
  // Without the origin and the cut between −π and π the least and the greatest angle are at corners.
  const bool simple = c.lo() > 0 || s.lo() > 0 || s.hi() < 0;
  if (simple && std::numeric_limits<long double>::digits >= 64) {
    const auto at = [](double x, double y) {
      return std::atan2(y == 0 ? 0.0L : static_cast<long double>(y), static_cast<long double>(x));  // of −0 it would be −0
    };
    const auto [low, high] = std::minmax({at(c.lo(), s.lo()), at(c.lo(), s.hi()), at(c.hi(), s.lo()), at(c.hi(), s.hi())});
    const std::optional<double> lower = below(low), upper = below(-high);
    if (lower && upper && range.contains(Interval(*lower, -*upper))) return {*lower, -*upper};
  }
  return certify::angle_enclosure(c, s, range);
}

PictureSource picture_view(const result::Result& result, const std::string& file) {
  PictureSource source{file, result.set, {}, result.angles, result.cover.dimension};
  for (const result::ResultVariable& v : result.variables) source.boxes.variables.push_back(v.name);
  source.cover = &result.cover.boxes;
  if (result.outputs.empty()) return source;
  source.outputs = result.outputs;
  for (const CoverBox& box : result.cover.boxes) {
    source.passages.push_back(box.passage);
    source.sides.push_back(box.side);
  }
  return source;
}

PictureSource picture_source(const result::SolFile& boxes, const std::string& file) {
  PictureSource source{file, "", boxes, {}, 2};
  const auto& names = boxes.variables;
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (!names[c].starts_with("c_")) continue;
    const auto s = std::ranges::find(names, "s_" + names[c].substr(2));
    if (s == names.end()) continue;
    source.angles.push_back({names[c].substr(2), static_cast<int>(c), static_cast<int>(s - names.begin()), kCircle});
  }
  return source;
}

Picture make_picture(const std::vector<PictureSource>& sources, const PictureOptions& options) {
  if (options.axes.size() < 2 || options.axes.size() > 3)
    throw std::invalid_argument("expected two or three variables for axes");
  std::vector<const PictureSource*> order;
  for (const PictureSource& source : sources) order.push_back(&source);
  std::stable_partition(order.begin(), order.end(),
                        [](const PictureSource* s) { return symbolic::definition(s->set).is_cspace(); });
  const std::vector<SetStyle> styles = set_styles(order);
  Picture picture;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const PictureSource* const source = order[k];
    std::vector<Coordinate> coordinates;
    for (const std::string& name : options.axes) coordinates.push_back(coordinate(*source, name));
    for (std::size_t j = 0; j < coordinates.size(); ++j) {
      const PictureAxis here = axis(*source, coordinates[j], options.axes[j]);
      if (picture.axes.size() <= j) picture.axes.push_back(here);
      PictureAxis& there = picture.axes[j];
      there.angle = there.angle && here.angle;
      if (!there.angle)
        there.range.reset();
      else
        there.range = Interval::hull(*there.range, *here.range);
    }
    const bool passes = !source->passages.empty() && options.color == ColorScheme::set;
    if (passes)
      add_passages(*source, styles[k], coordinates, options, picture.layers);
    else
      add_layers(*source, styles[k], coordinates, options, {}, picture.layers);
    if (passes && coordinates.size() == 2) add_hatches(*source, coordinates, options.axes, picture.hatches);
  }
  if (options.color == ColorScheme::verdict)
    std::ranges::stable_sort(picture.layers, [](const PictureLayer& a, const PictureLayer& b) { return rank(a) < rank(b); });
  return picture;
}

bool is_empty(const Picture& picture) {
  return std::ranges::all_of(picture.layers, [](const PictureLayer& l) { return l.boxes.empty(); });
}

Color verdict_color(std::optional<Verdict> verdict) {
  if (!verdict) return {0, 0, 1};
  switch (*verdict) {
    case Verdict::regular: return {0, 0, 1};
    case Verdict::isolated: return {0, 0.6, 0};
    case Verdict::exact: return {0, 0.4, 0.4};
    case Verdict::boundary: return {0.55, 0, 0.75};
    case Verdict::undecided: return {1, 0, 0};
    case Verdict::partial: return {1, 0.55, 0};
    case Verdict::pending: return {0.6, 0.6, 0.6};
  }
  return {};
}

Color set_color(const std::string& set) { return look(symbolic::definition(set)).drawn.paint.print; }

}  // namespace corank::report
