// Files that hold boxes, for the subcommands that only read them.
#pragma once

#include <filesystem>
#include <string>

#include "corank/app/exit_status.h"
#include "corank/result/cuik/cuik_files.h"

namespace corank::app {

/// The boxes of a result file: HDF5 where the name ends in .h5, else .sol. Throws ResultFileError.
result::SolFile read_boxes(const std::string& path);

/// Index of the variable with this name or number from 1. Throws UsageError.
int variable_index(const result::SolFile& boxes, const std::string& file, const std::string& name_or_number);

/// kDone, or, said on standard error, kIncomplete where a box is pending.
ExitStatus completeness(const result::SolFile& boxes, const std::string& file);
ExitStatus completeness(bool complete, const std::string& file);

/// Throws UsageError where the path looks like an input of ours (.cuik, .param), ResultFileError where no file can be made
/// there.
void check_output(const std::string& path);
/// Makes the folder of a page, and that of its figures. Throws ResultFileError where index.html cannot be written there.
void check_folder(const std::filesystem::path& folder);

}  // namespace corank::app
