#include "corank/app/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <system_error>

#include "corank/app/progress.h"
#include "corank/report/portrait.h"
#include "corank/result/result_file.h"

namespace corank::app {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw result::ResultFileError(fmt::format("{}: no folder can be made there: {}", folder.string(), error.message()));
}

std::vector<std::string> portrait_axes(const symbolic::Mechanism& mechanism, const std::vector<std::string>& first) {
  std::vector<std::string> axes;
  const auto add = [&](const std::string& name) {
    const symbolic::Coordinate& c = mechanism.coordinates()[static_cast<std::size_t>(mechanism.find_coordinate(name))];
    const bool known = std::find(axes.begin(), axes.end(), name) != axes.end();
    if (!known && axes.size() < 2 && !is_fixed(c)) axes.push_back(name);
  };
  for (const auto* names : {&first, &mechanism.outputs(), &mechanism.inputs()})
    std::for_each(names->begin(), names->end(), add);
  for (const symbolic::Coordinate& c : mechanism.coordinates()) add(c.name);
  return axes;
}

Figures write_figures(const std::filesystem::path& folder, const symbolic::Mechanism& mechanism,
                      const std::vector<report::SetView>& views, const std::atomic<bool>& stop) {
  ProgressLine line;
  std::vector<report::PictureSource> sources;
  for (const report::SetView& view : views)
    if (!view.result.cover.boxes.empty()) sources.push_back(report::picture_view(view.result, view.result.set));
  Figures figures;
  for (const auto& [name, first] :
       {std::pair{"output-portrait", &mechanism.outputs()}, std::pair{"input-portrait", &mechanism.inputs()}}) {
    report::PictureOptions options;
    options.axes = portrait_axes(mechanism, *first);
    if (options.axes.size() < 2 || sources.empty()) continue;
    figures.stopped = figures.stopped || stop;
    if (figures.stopped) continue;
    line.show(std::string("figures: ") + name);
    const report::Picture picture = report::make_picture(sources, options);
    for (const char* extension : {".svg", ".pdf"}) {
      if (extension == std::string_view(".pdf") && !report::can_write_pdf()) continue;
      figures.files.push_back(std::string(name) + extension);
      report::write_portrait(folder / figures.files.back(), picture, {});
    }
  }
  return figures;
}

Figures write_family_figures(const std::filesystem::path& folder, const std::vector<report::FamilyMember>& members,
                             const report::FamilyOptions& options, const std::atomic<bool>& stop) {
  ProgressLine line;
  std::vector<report::Picture> pictures;
  std::vector<std::string> titles;
  report::PictureOptions plane;
  plane.axes = {options.axes[0], options.axes[1]};
  for (const report::FamilyMember& member : members) {
    if (stop) return {{}, true};
    line.show(fmt::format("figures: {} of {}", pictures.size(), members.size()));
    std::vector<report::PictureSource> sources;
    for (const report::SetView& view : member.sets) sources.push_back(report::picture_view(view.result, view.result.set));
    pictures.push_back(report::make_picture(sources, plane));
    titles.push_back(options.constant + " = " + member.value);
  }
  return {report::write_small_multiples(folder, pictures, titles), false};
}

}  // namespace corank::app
