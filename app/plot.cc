// corank plot: the boxes of results in two or three coordinates, for papers, ParaView and Geomview.

#include <filesystem>
#include <list>
#include <map>
#include <set>

#include "corank/app/box_files.h"
#include "corank/app/progress.h"
#include "corank/app/subcommands.h"
#include "corank/report/pictures/picture.h"
#include "corank/report/pictures/portrait.h"
#include "corank/study/cut.h"
#include "corank/study/images.h"

namespace corank::app {
namespace {

const std::map<std::string, report::ColorScheme> kSchemes{
    {"set", report::ColorScheme::set}, {"verdict", report::ColorScheme::verdict}, {"plain", report::ColorScheme::plain}};

constexpr std::uint64_t kMostImages = 1'000'000;

struct PlotCommand {
  std::vector<std::string> inputs;
  std::string output;
  report::PictureOptions picture;
  report::PortraitOptions portrait;
  double time_limit = 0;
};

/// What the axes show: variables, and the cosine and the sine of angles; all where an axis is none of them or a number.
std::vector<int> shown_variables(const result::Result& result, const std::vector<std::string>& axes) {
  std::set<int> shown;
  for (const std::string& axis : axes) {
    const std::size_t before = shown.size();
    bool known = false;
    for (std::size_t v = 0; v < result.variables.size(); ++v)
      if (result.variables[v].name == axis) known = true, shown.insert(static_cast<int>(v));
    for (const Angle& a : result.angles)
      if (a.name == axis) known = true, shown.insert({a.cosine, a.sine});
    for (const Angle& a : result.angles)  // of which a variable is the cosine or the sine: the axis says so
      if (shown.size() > before && (shown.contains(a.cosine) || shown.contains(a.sine))) shown.insert({a.cosine, a.sine});
    if (known) continue;
    for (std::size_t v = 0; v < result.variables.size(); ++v) shown.insert(static_cast<int>(v));
  }
  return {shown.begin(), shown.end()};
}

/// Is some box as wide as the picture, as one of a part is that lacks sides for what is shown?
bool has_whole_ranges(const result::Result& result) {
  return std::ranges::any_of(result.cover.boxes, [&](const CoverBox& box) {
    for (std::size_t v = 0; v < box.box.size(); ++v)
      if (!(box.box[v] == result.variables[v].domain)) return false;
    return true;
  });
}

/// The first of the axes that no part has sides for, though it is no joint over whose range one is a product; or none.
std::string lacking_axis(const result::Result& result, const std::vector<std::string>& axes) {
  if (!study::lacks_sides(result)) return "";
  const auto lacks = [&](const std::string& axis) {
    return result::has_coordinate(result, axis) && std::ranges::none_of(result.parts, [&](const result::Result& part) {
             const std::vector<std::string> left_out = result::left_out(part);
             return result::has_coordinate(part, axis) || std::ranges::find(left_out, axis) != left_out.end();
           });
  };
  const auto axis = std::ranges::find_if(axes, lacks);
  return axis == axes.end() ? "" : *axis;
}

/// Of a result nothing is copied, and what the picture does not show is not read, unless sheets are to be cut: it is kept in
/// the list.
report::PictureSource read_source(const PlotCommand& command, const std::string& path, std::list<result::Result>& results,
                                  WholeRun& run) {
  run.enter("reading the boxes");
  if (std::filesystem::path(path).extension() != ".h5") return report::picture_source(result::read_sol(path), path);
  const result::Reading reading{.free = false,
                                .sides = [&](const result::Result& r) { return shown_variables(r, command.picture.axes); }};
  result::Result& result = results.emplace_back(result::read_result(path, reading));
  if (has_whole_ranges(result)) result = result::read_result(path);
  const std::string axis = lacking_axis(result, command.picture.axes);
  const auto refuse = [&] {
    throw UsageError(
        fmt::format("--axes {}: {}: the set is known in an arm's joints, and would be too many boxes over {}; expected "
                    "joints as axes, or a model that holds one of them by a range of one value",
                    fmt::join(command.picture.axes, ","), path, axis));
  };
  if (!axis.empty() && !study::can_have_images(result, kMostImages)) refuse();
  if (study::is_whole(result)) {
    run.enter("cutting the sheets");
    result = study::cut(result::read_result(path), {.threads = 0}, run.control());
  }
  if (!axis.empty()) {
    run.enter("finding the outputs");
    std::optional<result::Result> images = study::with_images(result, kMostImages);
    if (!images) refuse();
    result = std::move(*images);
  }
  return report::picture_view(result, path);
}

void check_format(const PlotCommand& command) {
  const std::string extension = std::filesystem::path(command.output).extension().string();
  const bool flat = report::is_portrait_format(command.output);
  if (!flat && extension != ".gcl" && extension != ".vtp")
    throw UsageError(
        fmt::format("-o {}: the picture has an unknown format; expected a name that ends in .svg, .pdf, .png, .vtp or .gcl",
                    command.output));
  const std::size_t axes = command.picture.axes.size();
  if (axes < 2 || axes > 3) throw UsageError(fmt::format("--axes: {} given; expected two or three variables", axes));
  if (flat && axes == 3)
    throw UsageError(
        fmt::format("-o {}: {} pictures are flat; expected two axes, or a name that ends in .vtp or .gcl for three",
                    command.output, extension));
  report::check_can_draw(command.output);
}

ExitStatus plot(const CLI::App& sub, const PlotCommand& command) {
  check_format(command);
  if (!report::is_portrait_format(command.output))
    refuse_without_effect(sub, {"--title", "--legend", "--width"}, "-o with a name that ends in .svg, .pdf or .png");
  if (!command.output.ends_with(".png")) refuse_without_effect(sub, {"--dpi"}, "-o with a name that ends in .png");
  ProgressLine line;
  WholeRun run(command.time_limit);
  line.follow(run.control());
  std::list<result::Result> results;
  std::vector<report::PictureSource> sources;
  for (const std::string& path : command.inputs) sources.push_back(read_source(command, path, results, run));
  line.clear();
  run.enter("drawing the picture");
  report::Picture picture;
  try {
    picture = report::make_picture(sources, command.picture);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  if (is_empty(picture)) throw result::ResultFileError(fmt::format("{}: no boxes to draw", fmt::join(command.inputs, ", ")));
  check_output(command.output);
  run.enter("writing the picture");
  if (report::is_portrait_format(command.output)) {
    report::write_portrait(command.output, picture, command.portrait);
  } else if (command.output.ends_with(".vtp")) {
    result::write_text(command.output, report::to_vtp(picture));
  } else {
    const std::string words = fmt::format("corank plot {} --axes {} --size {}", fmt::join(command.inputs, " "),
                                          fmt::join(command.picture.axes, ","), command.picture.size);
    result::write_text(command.output,
                       report::to_gcl(picture, std::filesystem::path(command.inputs[0]).stem().string(), words));
  }
  ExitStatus status = kDone;
  for (const report::PictureSource& source : sources) {
    bool complete = true;
    for (std::size_t k = 0; k < source.count() && complete; ++k) complete = source.verdict(k) != Verdict::pending;
    status = std::max(status, completeness(complete, source.file));
  }
  return status;
}

}  // namespace

void add_plot(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand("plot", "Draw the boxes of results over two or three coordinates");
  const auto command = std::make_shared<PlotCommand>();
  sub->add_option("RESULT", command->inputs, "Result files (.h5 or .sol), one or several")->required();
  sub->add_option("--axes", command->picture.axes,
                  "Two or three axes, with commas: variables by name or by number from 1, angles by name")
      ->type_name("X,Y[,Z]")
      ->delimiter(',')
      ->required();
  sub->add_option(
         "--color", command->picture.color,
         "set: one colour for each set, such as C-space grey, forward red, inverse blue; verdict: one colour for each\n"
         "verdict; plain: all blue")
      ->transform(CLI::Transformer(kSchemes).description(""))
      ->type_name("set|verdict|plain")
      ->default_str("set");
  sub->add_option("--size", command->picture.size,
                  "Draw each box as a cube with this edge about its centre; 0: draw boxes as they are")
      ->check(not_negative())
      ->capture_default_str();
  add_option(*sub, "--title TEXT", command->portrait.title, "A line of text above a .svg, .pdf or .png");
  sub->add_flag("--legend,!--no-legend", command->portrait.legend, "Explain the colours in a .svg, .pdf or .png (default)");
  sub->add_option("--width", command->portrait.width_mm, "Width in mm of a .svg, .pdf or .png")
      ->check(CLI::Range(20.0, 1000.0))
      ->capture_default_str();
  sub->add_option("--dpi", command->portrait.dots_per_inch, "Dots per inch of a .png")
      ->check(CLI::Range(10.0, 2400.0))
      ->capture_default_str();
  add_time_limit(*sub, command->time_limit);
  add_option(*sub, "-o PICTURE", command->output,
             "The picture: .svg, .pdf or .png for two axes; .vtp (ParaView) or .gcl (Geomview) for two or three")
      ->required();
  sub->footer(
      "Exit status: 0 done, 1 bad input, 2 wrong usage, 3 stopped by the limit or an interrupt, or done,\n"
      "but the search of a result had ended early.\n\n"
      "Examples:\n"
      "  corank plot cspace.h5 forward.h5 inverse.h5 --axes J3x,J3y -o output.pdf\n"
      "  corank plot forward.h5 inverse.h5 --axes theta2,theta5 --width 120 -o input.svg\n"
      "  corank plot cspace.h5 forward.h5 --axes J3x,J3y,theta2 -o cspace.vtp");
  sub->callback([command, sub, &action] { action = [command, sub] { return plot(*sub, *command); }; });
}

}  // namespace corank::app
