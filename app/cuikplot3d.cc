// cuikplot3d, as in the CUIK suite: draws the boxes of a solution file for Geomview. A face of `corank plot`.
#include "corank/app/run.h"

int main(int argc, char** argv) {
  using namespace corank::app;
  const std::vector<std::string> args(argv + (argc > 0 ? 1 : 0), argv + argc);
  const std::string usage =
      "Usage: cuikplot3d NAME X Y Z SIZE PICTURE\n"
      "Draws the boxes of NAME.sol over three variables, numbered from 1, and writes PICTURE.gcl for Geomview.\n"
      "SIZE 0 draws boxes as they are. Any other SIZE draws each box as a cube with this edge about its centre.\n";
  if (const auto status = usage_status(usage, args, 6)) return *status;
  std::vector<std::string> command{"plot",    with_extension(args[0], ".sol"),
                                   "--axes",  args[1] + "," + args[2] + "," + args[3],
                                   "--size",  args[4],
                                   "-o",      with_extension(args[5], ".gcl"),
                                   "--color", "plain"};
  command.insert(command.end(), args.begin() + 6, args.end());
  return run("cuikplot3d", command);
}
