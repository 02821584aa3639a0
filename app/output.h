// What commands say at their end.
#pragma once

#include <string>

#include "corank/app/exit_status.h"
#include "corank/result/result.h"
#include "corank/solve/control.h"

namespace corank::app {

/// Warns, where a set is empty, of a robot that cannot be assembled, of decimals that contradict each other. True: it did.
bool warn_of_assembly(const result::Result& result);
/// Says what ended an analysis early whose numbers are proven at any time. Requires that something did.
ExitStatus stopped_early(const solve::Control& control);
/// ", stopped by the time limit, in the stage search"; empty where nothing has ended it.
std::string ending_words(const solve::Control& control);

}  // namespace corank::app
