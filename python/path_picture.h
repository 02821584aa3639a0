// What a page shows of a path, with the model as it was when the path was found.
#pragma once

#include "corank/report/path_view.h"
#include "corank/symbolic/mechanism.h"

namespace corank::python {

struct PathPicture {
  symbolic::Mechanism mechanism;
  report::PathView view;
};

}  // namespace corank::python
