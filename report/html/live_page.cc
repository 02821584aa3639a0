#include "corank/report/html/live_page.h"

#include "corank/report/html/page_assets.h"
#include "corank/report/html/page_data.h"
#include "corank/report/html/template_data.h"
#include "corank/report/pictures/box_payload.h"

namespace corank::report {

std::string live_model(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation,
                       const std::vector<const SetView*>& views) {
  return page_model_of(mechanism, each(views, [&](const SetView* view) {
                         Json set = set_of(mechanism, derivation, *view);
                         set["boxes"] = box_payload(view->drawn());
                         set["verdicts"] = verdict_payload(view->drawn());
                         set["card"] = card_html(*view);
                         return set;
                       }));
}

std::string studio_page(const StudioPage& page) {
  Json constants = Json::object();
  for (const auto& [name, value] : page.constants) constants[name] = value;
  const Json start = {{"file", page.file},
                      {"text", page.text},
                      {"loops", page.loops},
                      {"constants", constants},
                      {"templates", each(page.templates, [](const auto& model) {
                         return Json{{"name", model.first}, {"text", model.second}};
                       })}};
  TemplateData data;
  data["version"] = result::version();
  data["style"] = std::string(kPageStyle) + std::string(kStudioStyle) + set_style();
  data["start"] = script_safe(start.dump(-1, ' ', false, Json::error_handler_t::replace));
  data["three"] = std::string(kThree);
  data["script"] = std::string(kStudioScript);
  return filled(kStudioTemplate, data);
}

}  // namespace corank::report
