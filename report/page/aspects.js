// The aspects of the mechanism as colours of C-space's boxes, and their legends.
import {htmlText} from "./values.js";
import {bytesOfBase64} from "./data.js";

export class Aspects {
  // `set`: C-space. Of each of its boxes the number of its aspect from 1 is in `of`; 0: none is known.
  constructor(set, {labels, colours, of}) {
    const bytes = bytesOfBase64(of);
    Object.assign(this, {set, labels, colours, hidden: new Set()});
    this.of = Uint16Array.from({length: bytes.length / 2}, (_, i) => bytes[2 * i] + 256 * bytes[2 * i + 1]);
  }

  // The numbers that occur.
  get numbers() {
    return [0, ...this.labels.map((_, k) => k + 1)];
  }
  isShown(box) {
    return !this.hidden.has(this.of[box]);
  }
  // `plain`: where no aspect is known.
  colourOf(number, plain) {
    return number > 0 ? this.colours[number - 1] : plain;
  }
  colourOfBox(box, plain) {
    return this.colourOf(this.of[box], plain);
  }
  htmlOf(box) {
    const number = this.of[box];
    return number > 0
      ? `<span class="swatch" style="background: ${this.colours[number - 1]}"></span>aspect ${htmlText(this.labels[number - 1])}`
      : "";
  }
}

// Gives the model its aspects, where the page knows them.
export function readAspects(model) {
  const description = JSON.parse(document.getElementById("aspects-data").textContent);
  const set = model.sets.find(({singular}) => !singular);
  model.aspects = description && set ? new Aspects(set, description) : null;
}

// The check boxes of a section: aspects in colour or not, and below them each aspect; onChange() when the drawings are to be made anew.
export function aspectLegend(aspects, section, setByAspect, onChange) {
  const all = section.querySelector("input.by-aspect"),
    list = section.querySelector(".aspects-legend");
  if (!all) return;
  aspectItems(aspects, list, onChange);
  const follow = () => {
    list.hidden = !all.checked;
    setByAspect(all.checked);
  };
  all.addEventListener("change", () => {
    follow();
    onChange();
  });
  follow();
}

// A check box for each aspect.
export function aspectItems(aspects, list, onChange) {
  aspects.labels.forEach((label, k) => {
    const item = document.createElement("label");
    item.innerHTML = `<input type="checkbox" class="aspect" value="${k + 1}" checked><span class="swatch" style="background: ${
      aspects.colours[k]
    }"></span>${htmlText(label)}`;
    item.querySelector("input").addEventListener("change", (event) => {
      aspects.hidden[event.target.checked ? "delete" : "add"](k + 1);
      for (const other of document.querySelectorAll(`input.aspect[value="${k + 1}"]`)) other.checked = event.target.checked;
      onChange();
    });
    list.append(item);
  });
}
