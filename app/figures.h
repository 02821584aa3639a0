// The folder of a report or a sweep, and its figures: portraits as files for a paper.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "corank/report/family_page.h"
#include "corank/result/result.h"
#include "corank/symbolic/mechanism.h"

namespace corank::app {

/// Makes the folder and those above it. Throws ResultFileError.
void make_folder(const std::filesystem::path& folder);

/// The two coordinates of a portrait: the first inputs or outputs, those of one value aside; then other coordinates. Fewer
/// where the mechanism has no two.
std::vector<std::string> portrait_axes(const symbolic::Mechanism& mechanism, const std::vector<std::string>& first);

/// The names of the files; `stopped`: an interrupt has left some out.
struct Figures {
  std::vector<std::string> files;
  bool stopped = false;
};

/// Writes output-portrait and input-portrait, each as .svg and, where report::can_write_pdf(), .pdf, into a folder that
/// exists; nothing where there is no box or no plane. Where `stop` is set meanwhile, the figures that are left are left out.
Figures write_figures(const std::filesystem::path& folder, const symbolic::Mechanism& mechanism,
                      const std::vector<report::SetView>& views, const std::atomic<bool>& stop);

/// Writes the output portraits of a family, all with the same axes, as member-1.svg …, and side by side as family.svg; none
/// where there is no box.
Figures write_family_figures(const std::filesystem::path& folder, const std::vector<report::FamilyMember>& members,
                             const report::FamilyOptions& options, const std::atomic<bool>& stop);

}  // namespace corank::app
