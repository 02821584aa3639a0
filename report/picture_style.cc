// Names and colours of the sets in a picture.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "corank/report/picture.h"

namespace corank::report {
namespace {

SetStyle set_style(const PictureSource& source) {
  const symbolic::SetDefinition& set = symbolic::definition(source.set);
  // A surface is seen through; a curve of that colour would be too faint.
  return {*look(set).label ? look(set).label : std::filesystem::path(source.file).stem().string(), set_color(source.set),
          set.is_cspace() && source.dimension > 1 ? 0.4 : 1.0};
}

}  // namespace

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
    } else if (std::count_if(sources.begin(), sources.end(), same) > 1) {
      const double light =
          1 - std::pow(0.65, std::count_if(sources.begin(), sources.begin() + static_cast<std::ptrdiff_t>(k), same));
      styles[k].label += " (" + std::filesystem::path(sources[k]->file).stem().string() + ")";
      for (double* channel : {&styles[k].color.red, &styles[k].color.green, &styles[k].color.blue})
        *channel += light * (0.95 - *channel);
    }
  }
  return styles;
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
