// What several pages' templates are filled with.
#pragma once

#include <kainjow/mustache.hpp>
#include <string>
#include <vector>

namespace corank::report {

inline kainjow::mustache::data truth(bool value) {
  using kainjow::mustache::data;
  return data{value ? data::type::bool_true : data::type::bool_false};
}

/// A list of {"sentence": …}.
inline kainjow::mustache::data sentences(const std::vector<std::string>& list) {
  using kainjow::mustache::data;
  data items{data::type::list};
  for (const std::string& sentence : list) items << data{"sentence", sentence};
  return items;
}

}  // namespace corank::report
