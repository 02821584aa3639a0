// The subcommands: each adds its options to the command line and, where it was chosen, leaves what is to be done in
// `action`. With this header their sources have what nearly all of them need.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>

#include "corank/app/exit_status.h"
#include "corank/app/limited_run.h"
#include "corank/app/progress.h"
#include "corank/app/question.h"
#include "corank/app/shared_options.h"
#include "corank/app/watch.h"
#include "corank/result/files/result_file.h"
#include "corank/result/values/words.h"

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
