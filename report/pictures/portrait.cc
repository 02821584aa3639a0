#include "corank/report/pictures/portrait.h"

#include <algorithm>
#include <stdexcept>

#include "corank/report/pictures/layout.h"
#include "corank/result/files/result_file.h"

namespace corank::report {
namespace {

void check_format(const std::filesystem::path& path) {
  if (!is_portrait_format(path))
    throw std::invalid_argument(path.string() + ": the picture has an unknown format; expected .svg, .pdf or .png");
}

Layout laid_out(const Picture& picture, const PortraitOptions& options) { return lay_out(picture, options, font_widths()); }

}  // namespace

bool is_portrait_format(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".svg" || extension == ".pdf" || extension == ".png";
}

void check_can_draw(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (!can_write_pdf() && (extension == ".pdf" || extension == ".png"))
    throw result::ResultFileError(
        path.string() +
        ": this corank was built without Cairo, which draws .pdf and .png; write a .svg, or install "
        "Cairo (on Debian: apt install libcairo2-dev) and build corank again");
}

void write_drawing(const std::filesystem::path& path, const Layout& drawing, const std::string& title,
                   double dots_per_inch) {
  check_format(path);
  check_can_draw(path);
  const std::string extension = path.extension().string();
  result::write_text(path, extension == ".svg"   ? to_svg(drawing, title)
                           : extension == ".pdf" ? to_pdf(drawing, title, path.string())
                                                 : to_png(drawing, dots_per_inch, path.string()));
}

void write_portrait(const std::filesystem::path& path, const Picture& picture, const PortraitOptions& options) {
  check_format(path);
  if (picture.axes.size() != 2) throw std::invalid_argument(path.string() + ": a flat picture; expected two axes");
  if (!(options.width_mm >= 20 && options.width_mm <= 1000) ||
      !(options.dots_per_inch >= 10 && options.dots_per_inch <= 2400))
    throw std::invalid_argument(path.string() + ": expected a width from 20 to 1000 mm and 10 to 2400 dots per inch");
  if (!options.ranges && is_empty(picture)) throw std::invalid_argument(path.string() + ": there are no boxes to draw");
  write_drawing(path, laid_out(picture, options), options.title, options.dots_per_inch);
}

std::vector<std::string> write_small_multiples(const std::filesystem::path& folder, const std::vector<Picture>& pictures,
                                               const std::vector<std::string>& titles) {
  constexpr std::size_t kColumns = 4;
  if (std::ranges::all_of(pictures, is_empty)) return {};
  PortraitOptions options;
  options.ranges = common_ranges(pictures);
  std::vector<std::string> files;
  std::vector<PlacedDrawing> all;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    options.title = titles.at(k);
    options.legend = true;
    options.width_mm = 85;
    files.push_back("member-" + std::to_string(k + 1) + ".svg");
    write_portrait(folder / files.back(), pictures[k], options);
    options.legend = false;
    options.width_mm = 45;
    Layout drawing = laid_out(pictures[k], options);
    all.push_back({drawing.width * static_cast<double>(k % kColumns), drawing.height * static_cast<double>(k / kColumns),
                   std::move(drawing)});
  }
  const Layout& last = all.back().drawing;
  const double width = last.width * static_cast<double>(std::min(kColumns, all.size())), below = all.back().y + last.height;
  all.push_back({0, below, lay_out_legend(pictures.front(), width, font_widths())});
  files.push_back("family.svg");
  result::write_text(folder / files.back(), to_svg(all, "small multiples"));
  return files;
}

}  // namespace corank::report
