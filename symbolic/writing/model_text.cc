// A mechanism as text of the model language.
#include <algorithm>
#include <map>
#include <span>

#include "corank/core/check.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/writing/line_breaks.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::symbolic {
namespace {

std::size_t widest(const auto& named) {
  std::size_t width = 0;
  for (const auto& n : named) width = std::max(width, n.name.size());
  return width;
}

std::string place(const std::vector<Expression>& coordinates) {
  std::vector<std::string> texts;
  for (const Expression& e : coordinates) texts.push_back(e.text());
  return "(" + joined(texts) + ")";
}

bool begins_with(std::span<const std::string> names, const std::vector<std::string>& first) {
  return names.size() >= first.size() && std::equal(first.begin(), first.end(), names.begin());
}

class Writer {
 public:
  explicit Writer(const Mechanism& mechanism) : mechanism_(mechanism), out_("% " + one_line(mechanism.name()) + "\n") {
    for (const Composite& c : mechanism.composites()) composites_[c.components.front()] = &c;
  }

  std::string text() {
    const std::size_t constants = widest(mechanism_.constants()), rates = widest(mechanism_.rates());
    for (const Constant& c : mechanism_.constants())
      line("[CONSTANTS]", padded(c.name, constants) + " := " + (c.tolerance ? "in " + c.tolerance->text() : c.value.text()));
    write_coordinates();
    for (; constraint_ < mechanism_.constraints().size(); ++constraint_) write_constraint();
    for (const Constraint& c : mechanism_.implied()) line("[IMPLIED EQS]", equation(c));
    for (const Rate& r : mechanism_.rates())
      line("[RATES]", padded(r.name, rates) + (r.kind == CoordinateKind::angle ? " ~ " : " : ") + to_string(r.role));
    for (const Constraint& c : mechanism_.velocity_equations()) line("[VELOCITY EQS]", equation(c));
    if (!mechanism_.inputs().empty()) out_ += "\n[INPUTS]   " + chosen(mechanism_.inputs());
    if (!mechanism_.outputs().empty())
      out_ += (mechanism_.inputs().empty() ? "\n" : "") + ("[OUTPUTS]  " + chosen(mechanism_.outputs()));
    for (const Limit& l : mechanism_.limits()) line("[LIMITS]", padded(l.coordinate, widest_limit()) + " : " + l.text());
    for (const RequirementLine& r : mechanism_.requirements()) line("[REQUIREMENTS]", r.text + ";");
    write_drawing();
    return out_;
  }

 private:
  // In a section, which begins where the line before is of another one.
  void line(const std::string& section, const std::string& text) {
    if (section != section_) out_ += "\n" + section + "\n";
    section_ = section;
    out_ += text + "\n";
  }

  static std::string equation(const Constraint& c) {
    if (c.note.empty()) return c.relation.text() + ";";
    std::string note = one_line(c.note);
    if (c.relation.kind == Relation::Kind::equal) return c.relation.text() + ";   % " + note;
    std::ranges::replace(note, '"', '\'');
    return "\"" + note + "\": " + c.relation.text() + ";";
  }

  std::size_t widest_limit() const {
    std::size_t width = 0;
    for (const Limit& l : mechanism_.limits()) width = std::max(width, l.coordinate.size());
    return width;
  }

  void write_constraint() { line("[SYSTEM EQS]", equation(mechanism_.constraints()[constraint_])); }

  void write_coordinates() {
    const std::vector<Coordinate>& all = mechanism_.coordinates();
    const std::size_t width = widest(all);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Coordinate& c = all[i];
      const std::string section = c.auxiliary ? "[DUMMY VARS]" : "[SYSTEM VARS]";
      if (const auto composite = composites_.find(c.name); composite != composites_.end()) {
        write_composite(section, *composite->second);
        i += composite->second->components.size() - 1;
        continue;
      }
      line(section, padded(c.name, width) + (c.kind == CoordinateKind::angle ? " ~" : " :") +
                        (c.has_range ? " " + c.range_text() : ""));
    }
  }

  // Its declaration adds its equations; the constraints before them come before it.
  void write_composite(const std::string& section, const Composite& composite) {
    const std::string declaration = composite.name + (composite.kind == Composite::Kind::unit ? " @ unit" : " @ rotation");
    const std::vector<Constraint>& all = mechanism_.constraints();
    const auto own = [&](std::size_t k) { return k < all.size() && all[k].note == declaration; };
    for (; !own(constraint_); ++constraint_) {
      CORANK_CHECK(constraint_ < all.size());
      write_constraint();
    }
    line(section, declaration);
    constraint_ += composite.kind == Composite::Kind::unit ? 1 : 6;
  }

  // A composite for all of its components where they stand together.
  std::string chosen(const std::vector<std::string>& names) const {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto found = composites_.find(names[i]);
      const Composite* const composite = found == composites_.end() ? nullptr : found->second;
      if (composite && begins_with(std::span(names).subspan(i), composite->components)) {
        words.push_back(composite->name);
        i += composite->components.size() - 1;
      } else {
        words.push_back(names[i]);
      }
    }
    return joined(words) + "\n";
  }

  void write_drawing() {
    const Drawing& drawing = mechanism_.drawing();
    const std::string section = "[DRAWING]";
    if (is_identifier(drawing.unit)) line(section, "unit " + drawing.unit);
    const std::size_t width = widest(drawing.points);
    for (const DrawingPoint& p : drawing.points)
      line(section, "point " + padded(p.name, width) + " = " + place(p.coordinates) +
                        (p.velocity.empty() ? "" : " moves " + place(p.velocity)));
    for (const DrawingPart& part : drawing.parts) {
      std::vector<std::string> words{to_string(part.kind)};
      if (!part.name.empty()) words.push_back(part.name + " =");
      words.insert(words.end(), part.points.begin(), part.points.end());
      if (part.kind == DrawingPart::Kind::slider) words.insert(words.begin() + 2, "along");
      if (part.has_radius()) words.push_back("radius " + part.radius.text());
      if (!part.colour.empty()) words.push_back(part.colour);
      line(section, joined(words, " "));
    }
  }

  const Mechanism& mechanism_;
  std::string out_, section_;
  std::map<std::string, const Composite*> composites_;  // by the first component
  std::size_t constraint_ = 0;                          // that comes next
};

}  // namespace

std::string to_model(const Mechanism& mechanism) { return Writer(mechanism).text(); }

}  // namespace corank::symbolic
