// The subcommands: each adds its options to the command line and, where it was chosen, leaves what is to be done in
// `action`.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "corank/app/exit_status.h"

namespace corank::app {

using Action = std::function<ExitStatus()>;

void add_derive(CLI::App& program, Action& action);
void add_solve(CLI::App& program, Action& action);
void add_verify(CLI::App& program, Action& action);
void add_plot(CLI::App& program, Action& action);
void add_report(CLI::App& program, Action& action);
void add_sweep(CLI::App& program, Action& action);
void add_clearance(CLI::App& program, Action& action);
void add_tolerance(CLI::App& program, Action& action);
void add_aspects(CLI::App& program, Action& action);
void add_path(CLI::App& program, Action& action);
void add_postures(CLI::App& program, Action& action);
void add_cuspidal(CLI::App& program, Action& action);
void add_topology(CLI::App& program, Action& action);
void add_angles(CLI::App& program, Action& action);
void add_map(CLI::App& program, Action& action);
void add_gallery(CLI::App& program, Action& action);
void add_studio(CLI::App& program, Action& action);

}  // namespace corank::app
