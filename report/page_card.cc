#include "corank/report/page_card.h"

#include <fmt/format.h>

#include <kainjow/mustache.hpp>
#include <stdexcept>

#include "corank/report/page_assets.h"
#include "corank/report/page_words.h"
#include "corank/report/template_data.h"

namespace corank::report {
namespace {

namespace mustache = kainjow::mustache;

}  // namespace

std::string card_html(const SetView& view) {
  const SetWords& words = view.words;
  mustache::data card;
  card["name"] = view.set->name;
  card["title"] = words.title;
  card["meaning"] = words.meaning;
  card["finding"] = words.finding;
  card.set("proven", sentences(words.proven));
  card.set("unproven", sentences(words.unproven));
  card.set("hasUnproven",
           mustache::data{words.unproven.empty() ? mustache::data::type::bool_false : mustache::data::type::bool_true});
  mustache::data bar{mustache::data::type::list};
  for (const VerdictShare& share : words.shares) {
    mustache::data part;
    part["verdict"] = std::string(to_string(share.verdict));
    part["count"] = grouped(share.count);
    part["percent"] = percentage(share.count, view.result.cover.boxes.size());
    part["grow"] = fmt::format("{:.6f}", share.share);
    bar << part;
  }
  card.set("bar", bar);
  mustache::mustache pattern{std::string(kCardTemplate)};
  if (!pattern.is_valid()) throw std::logic_error("a card's template: " + pattern.error_message());
  return pattern.render(card);
}

}  // namespace corank::report
