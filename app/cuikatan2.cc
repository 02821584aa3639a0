// cuikatan2, as in the CUIK suite: replaces sines and cosines by angles in the boxes of a solution file. A face of `corank
// angles`.
#include "corank/app/run.h"

int main(int argc, char** argv) {
  using namespace corank::app;
  const std::vector<std::string> args(argv + (argc > 0 ? 1 : 0), argv + argc);
  const std::string usage =
      "Usage: cuikatan2 NAME SINE COSINE [SINE COSINE ...] OUTPUT\n"
      "Reads the boxes of NAME.sol, replaces each pair of a sine and a cosine (variables numbered from 1) by an angle at "
      "the\n"
      "end of the box, and writes OUTPUT.sol.\n";
  if (const auto status = usage_status(usage, args, 4)) return *status;
  std::vector<std::string> command{"angles", with_extension(args.front(), ".sol")};
  command.insert(command.end(), args.begin() + 1, args.end() - 1);
  command.push_back(with_extension(args.back(), ".sol"));
  return run("cuikatan2", command);
}
