// One command line, from its words to its exit status: what the programs corank, cuik, cuikplot3d and cuikatan2 share.
#pragma once

#include <string>
#include <vector>

namespace corank::app {

/// Runs `corank ARGS`; messages to the user begin with the name `program`.
int run(const std::string& program, const std::vector<std::string>& args);

/// Runs a program: corank, or one of the CUIK suite's, whose words become those of a subcommand of corank.
int run_program(const std::string& program, const std::vector<std::string>& args);

}  // namespace corank::app
