// cuik, as in the CUIK suite: solves NAME.cuik with the parameters of NAME.param and writes NAME.sol. A face of `corank
// solve`.
#include <filesystem>

#include "corank/app/run.h"

int main(int argc, char** argv) {
  using namespace corank::app;
  const std::vector<std::string> args(argv + (argc > 0 ? 1 : 0), argv + argc);
  const std::string usage =
      "Usage: cuik NAME [OPTIONS]\n"
      "Encloses every solution of NAME.cuik in boxes, with the parameters of NAME.param if it exists, and writes "
      "NAME.sol.\n"
      "The options are those of corank solve.\n";
  if (const auto status = usage_status(usage, args, 1)) return *status;
  const std::string file = with_extension(args[0], ".cuik"), name = file.substr(0, file.size() - 5);
  std::vector<std::string> command{"solve", file};
  if (std::filesystem::exists(name + ".param")) command.insert(command.end(), {"--param", name + ".param"});
  command.insert(command.end(), args.begin() + 1, args.end());
  command.insert(command.end(), {"-o", name + ".sol"});
  return run("cuik", command);
}
