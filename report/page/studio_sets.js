// The sets that may be seen, as check boxes with what was found of each.
import {groupedText, htmlText} from "./values.js";

// `available`: sets of the model; `chosen`: names; `shown`: sets by name; `refused`: why a set is none of the model's, by name; `model`: what
// is drawn, or null; `open`: is the list of more sets?
export function setsLegend({available, chosen, shown, refused, model, open, design}) {
  const item = ({name, title}) => {
    const set = shown.get(name),
      why = refused?.get(name);
    const undecided = set ? set.verdicts.filter((v) => model.verdicts[v] === "undecided").length : 0;
    const warning = undecided ? ` · <span class="verdict undecided">${groupedText(undecided)} undecided</span>` : "";
    const counts = why
      ? `<small title="${htmlText(why)}">not for this robot</small>`
      : set && chosen.includes(name)
        ? `<small>${groupedText(set.count)}${warning}</small>`
        : "";
    const checked = chosen.includes(name) ? " checked" : "";
    return `<label><input type="checkbox" class="toggle" value="${name}"${checked}><span class="swatch ${name}"></span>${title}&nbsp;${counts}</label>`;
  };
  const main = available.filter(({name, usual}) => usual || chosen.includes(name) || name === "requirements");
  const rest = available.filter((set) => !main.includes(set));
  const choice = (kind, on, words, title) =>
    `<label title="${title}"><input type="checkbox" class="${kind}"${on ? " checked" : ""}>${words}</label>`;
  const ways = {"": "in one colour", aspects: "by aspects", requirements: "by requirements"};
  const colours = Object.entries(ways)
    .map(([value, words]) => `<option value="${value}"${design.colours === value ? " selected" : ""}>${words}</option>`)
    .join("");
  return [
    ...main.map(item),
    '<span class="item"><span class="ring"></span>undecided</span><span class="item"><span class="swatch pending"></span>not searched</span>',
    `<label>C-space&nbsp;<select class="colours">${colours}</select></label>`,
    choice("fine", design.fine, "finer boxes", "Without them a slow robot is changed more quickly"),
    `<details${open ? " open" : ""}><summary>more sets</summary>${rest.map(item).join("")}</details>`,
  ].join("");
}
