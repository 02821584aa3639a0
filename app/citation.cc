#include "corank/app/citation.h"

#include "corank/result/values/result.h"

namespace corank::app {

std::string citation() {
  return R"(@software{corank,
  author  = {{The corank developers}},
  title   = {corank: all singularities of a robot mechanism, each with a proof},
  version = {)" +
         result::version() + R"(},
  license = {GPL-3.0-or-later}
})";
}

}  // namespace corank::app
