// A process that computes for one page of the studio: reads requests from a channel, a line each, and writes the lines of
// their answers. A request ends the answer to the one before.
#pragma once

#include "corank/studio/session.h"

namespace corank::studio {

/// Works until the other end of the channel is closed, and ends the process then. To be called in a child process, before
/// it has another thread.
[[noreturn]] void work(int channel, const SessionLimits& limits = {});

}  // namespace corank::studio
