// cuikequations, as in the CUIK suite: writes the equations of NAME.world as NAME.cuik, which cuik solves. A face of `corank
// derive`.
#include "corank/app/run.h"

int main(int argc, char** argv) {
  using namespace corank::app;
  const std::vector<std::string> args(argv + (argc > 0 ? 1 : 0), argv + argc);
  const std::string usage =
      "Usage: cuikequations NAME [OPTIONS]\n"
      "Writes the equations of the mechanism in NAME.world as polynomials to NAME.cuik. Then cuik NAME solves them with "
      "the\n"
      "parameters of NAME.param. A NAME.cuik that cuikequations did not write is not overwritten.\n"
      "The options are those of corank derive.\n";
  if (const auto status = usage_status(usage, args, 1)) return *status;
  const std::string file = with_extension(args[0], ".world"), name = file.substr(0, file.size() - 6);
  std::vector<std::string> command{"derive", file, "--format", "cuik", "-o", name + ".cuik"};
  command.insert(command.end(), args.begin() + 1, args.end());
  return run("cuikequations", command);
}
