// The programs of the CUIK suite, each a face of a subcommand of corank.
#include <fmt/format.h>

#include <filesystem>

#include "corank/app/exit_status.h"
#include "corank/app/run.h"

namespace corank::app {
namespace {

using Words = std::vector<std::string>;

struct SuiteProgram {
  const char* name;
  std::size_t fewest;  // words
  const char* usage;
  Words (*command)(const Words& args);
};

// The suite's file names: the extension may be left out ("cspace" is "cspace.sol" where a .sol is asked for).
std::string with_extension(const std::string& name, const std::string& extension) {
  return name.ends_with(extension) ? name : name + extension;
}

Words joined(Words first, const Words& args, std::size_t from, Words last = {}) {
  first.insert(first.end(), args.begin() + static_cast<std::ptrdiff_t>(from), args.end());
  first.insert(first.end(), last.begin(), last.end());
  return first;
}

constexpr SuiteProgram kPrograms[] = {
    {"cuik", 1,
     "Usage: cuik NAME [OPTIONS]\n"
     "Encloses every solution of NAME.cuik in boxes, with the parameters of NAME.param if it exists, and writes NAME.sol.\n"
     "The options are those of corank solve.\n",
     [](const Words& args) {
       const std::string file = with_extension(args[0], ".cuik"), name = file.substr(0, file.size() - 5);
       Words command{"solve", file};
       if (std::filesystem::exists(name + ".param")) command.insert(command.end(), {"--param", name + ".param"});
       return joined(command, args, 1, {"-o", name + ".sol"});
     }},
    {"cuikatan2", 4,
     "Usage: cuikatan2 NAME SINE COSINE [SINE COSINE ...] OUTPUT\n"
     "Reads the boxes of NAME.sol, replaces each pair of a sine and a cosine (variables numbered from 1) by an angle at "
     "the\n"
     "end of the box, and writes OUTPUT.sol.\n",
     [](const Words& args) {
       Words command = joined({"angles", with_extension(args.front(), ".sol")}, args, 1);
       command.back() = with_extension(args.back(), ".sol");
       return command;
     }},
    {"cuikequations", 1,
     "Usage: cuikequations NAME [OPTIONS]\n"
     "Writes the equations of the mechanism in NAME.world as polynomials to NAME.cuik. Then cuik NAME solves them with the\n"
     "parameters of NAME.param. A NAME.cuik that cuikequations did not write is not overwritten.\n"
     "The options are those of corank derive.\n",
     [](const Words& args) {
       const std::string file = with_extension(args[0], ".world"), name = file.substr(0, file.size() - 6);
       return joined({"derive", file, "--format", "cuik", "-o", name + ".cuik"}, args, 1);
     }},
    {"cuikplot3d", 6,
     "Usage: cuikplot3d NAME X Y Z SIZE PICTURE\n"
     "Draws the boxes of NAME.sol over three variables, numbered from 1, and writes PICTURE.gcl for Geomview.\n"
     "SIZE 0 draws boxes as they are. Any other SIZE draws each box as a cube with this edge about its centre.\n",
     [](const Words& args) {
       return joined({"plot", with_extension(args[0], ".sol"), "--axes", args[1] + "," + args[2] + "," + args[3], "--size",
                      args[4], "-o", with_extension(args[5], ".gcl"), "--color", "plain"},
                     args, 6);
     }},
};

}  // namespace

int run_program(const std::string& program, const std::vector<std::string>& args) {
  for (const SuiteProgram& p : kPrograms) {
    if (program != p.name) continue;
    const bool asked = !args.empty() && (args[0] == "-h" || args[0] == "--help");
    if (!asked && args.size() >= p.fewest) return run(program, p.command(args));
    fmt::print(asked ? stdout : stderr, "{}", p.usage);
    return asked ? kDone : kUsage;
  }
  return run(program, args);
}

}  // namespace corank::app
