// What commands say at their end.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "corank/app/exit_status.h"
#include "corank/app/question.h"
#include "corank/result/result.h"
#include "corank/solve/control.h"

namespace corank::app {

/// --json [PATH]; "": standard output.
using JsonPath = std::optional<std::string>;

/// `--json FILE` without another file: CLI11 took the model for the path.
void give_back_model(QuestionOptions& question, JsonPath& json);
/// Writes or prints the JSON, where it is asked for. True: the table is to be printed, too.
bool say_json(const JsonPath& json, const std::function<std::string()>& text);
/// Warns, where a set is empty, of a robot that cannot be assembled, of decimals that contradict each other. True: it did.
bool warn_of_assembly(const result::Result& result);
/// Says what ended an analysis early whose numbers are proven at any time. Requires that something did.
ExitStatus stopped_early(const solve::Control& control);

}  // namespace corank::app
