// One command line, from its words to its exit status: what the programs corank, cuik, cuikplot3d and cuikatan2 share.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace corank::app {

/// Runs `corank ARGS`; messages to the user begin with the name `program`.
int run(const std::string& program, const std::vector<std::string>& args);

/// For the programs of the CUIK suite: prints `usage` and returns the exit status where the first word is -h or --help, or
/// where there are fewer than `fewest` words.
std::optional<int> usage_status(const std::string& usage, const std::vector<std::string>& args, std::size_t fewest);

/// The CUIK suite's file names: the extension may be left out ("cspace" is "cspace.sol" where a .sol is asked for).
std::string with_extension(const std::string& name, const std::string& extension);

}  // namespace corank::app
