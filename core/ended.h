// Is a long computation to end early? Asked by it now and then; whatever was proven by then stays proven.
#pragma once

#include <functional>

namespace corank {

/// Empty: never. May be called from any thread that computes.
using Ended = std::function<bool()>;

inline bool is_over(const Ended& ended) { return ended && ended(); }

}  // namespace corank
