// The figures of a report or a sweep: portraits as files for a paper.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "corank/report/pictures/picture.h"
#include "corank/symbolic/model/mechanism.h"

namespace corank::report {

/// The two coordinates of a portrait: the first inputs or outputs, those of one value aside; then other coordinates; then
/// those that are `late`. Fewer where the mechanism has no two.
std::vector<std::string> portrait_axes(const symbolic::Mechanism& mechanism, const std::vector<std::string>& first,
                                       const std::function<bool(const std::string&)>& late = {});

/// The files, "figures/NAME", below the folder of their page; `stopped`: an interrupt has left some out.
struct Figures {
  std::vector<std::string> files;
  bool stopped = false;
};

/// Where `stop` is set meanwhile, the figures that are left are left out; `show` is told which one comes next.
struct FiguresRun {
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const std::string& figure)> show{};

  bool stopped() const { return stop && *stop; }
};

/// Writes output-portrait and input-portrait, each as .svg and, where can_write_pdf(), .pdf; `folder` is that of their
/// page. Nothing where there is no box or no plane.
Figures write_figures(const std::filesystem::path& folder, const symbolic::Mechanism& mechanism,
                      std::vector<PictureSource> sources, const FiguresRun& run);

/// Writes the portraits of a family's members, all with the same axes, by write_small_multiples(); none where there is no
/// box.
Figures write_family_figures(const std::filesystem::path& folder, const std::vector<std::vector<PictureSource>>& members,
                             const std::vector<std::string>& axes, const std::vector<std::string>& titles,
                             const FiguresRun& run);

/// "member-03-forward.h5": members from 1, with as many digits as the last one needs.
std::string member_file(std::size_t member, std::size_t members, const std::string& set);

}  // namespace corank::report
