#include "corank/report/pictures/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "corank/report/pictures/portrait.h"

namespace corank::report {
namespace {

constexpr const char* kFolder = "figures";

void show(const FiguresRun& run, const std::string& figure) {
  if (run.show) run.show("figures: " + figure);
}

// Have all boxes of all singularities, if there are some, the same wide side? Sets that leave a coordinate out have, and
// their picture says nothing.
bool is_same_everywhere(const std::vector<PictureSource>& sources, const std::string& name) {
  const auto is_singular = [](const PictureSource& source) { return symbolic::definition(source.set).is_singular(); };
  const bool some_singular = std::ranges::any_of(sources, is_singular);
  std::vector<const Interval*> first;
  for (const PictureSource& source : sources) {
    if (some_singular && !is_singular(source)) continue;
    const auto angle = std::ranges::find(source.angles, name, &Angle::name);
    std::vector<int> own{source.boxes.find(name)};
    if (angle != source.angles.end()) own = {angle->cosine, angle->sine};
    if (own[0] < 0) return false;
    for (std::size_t k = 0; k < source.count(); ++k)
      for (std::size_t i = 0; i < own.size(); ++i) {
        const Interval& side = source.box(k)[own[i]];
        if (first.size() <= i) first.push_back(&side);
        if (side.width() == 0 || side.lo() != first[i]->lo() || side.hi() != first[i]->hi()) return false;
      }
  }
  return true;
}

}  // namespace

std::vector<std::string> portrait_axes(const symbolic::Mechanism& mechanism, const std::vector<std::string>& first,
                                       const std::function<bool(const std::string&)>& late) {
  std::vector<std::string> axes, others;
  const auto add = [&](const std::string& name) {
    const symbolic::Coordinate& c = mechanism.coordinates()[mechanism.find_coordinate(name)];
    const bool known = std::ranges::find(axes, name) != axes.end();
    if (!known && axes.size() < 2 && !is_fixed(c)) (late && late(name) ? others : axes).push_back(name);
  };
  for (const auto* names : {&first, &mechanism.outputs(), &mechanism.inputs()})
    std::for_each(names->begin(), names->end(), add);
  for (const symbolic::Coordinate& c : mechanism.coordinates()) add(c.name);
  for (const std::string& name : others)
    if (axes.size() < 2 && std::ranges::find(axes, name) == axes.end()) axes.push_back(name);
  return axes;
}

Figures write_figures(const std::filesystem::path& folder, const symbolic::Mechanism& mechanism,
                      std::vector<PictureSource> sources, const FiguresRun& run) {
  std::erase_if(sources, [](const PictureSource& source) { return source.count() == 0; });
  std::filesystem::create_directories(folder / kFolder);
  Figures figures;
  for (const auto& [name, first] :
       {std::pair{"output-portrait", &mechanism.outputs()}, std::pair{"input-portrait", &mechanism.inputs()}}) {
    PictureOptions options;
    options.axes =
        portrait_axes(mechanism, *first, [&](const std::string& axis) { return is_same_everywhere(sources, axis); });
    if (options.axes.size() < 2 || sources.empty()) continue;
    figures.stopped = figures.stopped || run.stopped();
    if (figures.stopped) continue;
    show(run, name);
    const Picture picture = make_picture(sources, options);
    for (const char* extension : {".svg", ".pdf"}) {
      if (extension == std::string_view(".pdf") && !can_write_pdf()) continue;
      figures.files.push_back(std::string(kFolder) + "/" + name + extension);
      write_portrait(folder / figures.files.back(), picture, {});
    }
  }
  return figures;
}

Figures write_family_figures(const std::filesystem::path& folder, const std::vector<std::vector<PictureSource>>& members,
                             const std::vector<std::string>& axes, const std::vector<std::string>& titles,
                             const FiguresRun& run) {
  std::vector<Picture> pictures;
  PictureOptions plane;
  plane.axes = axes;
  for (const std::vector<PictureSource>& sources : members) {
    if (run.stopped()) return {{}, true};
    show(run, fmt::format("{} of {}", pictures.size(), members.size()));
    pictures.push_back(make_picture(sources, plane));
  }
  std::filesystem::create_directories(folder / kFolder);
  std::vector<std::string> files = write_small_multiples(folder / kFolder, pictures, titles);
  for (std::string& name : files) name = std::string(kFolder) + "/" + name;
  return {files, false};
}

std::string member_file(std::size_t member, std::size_t members, const std::string& set) {
  return fmt::format("member-{:0{}}-{}.h5", member + 1, std::to_string(members).size(), set);
}

}  // namespace corank::report
