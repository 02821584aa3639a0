// The model's constants: each a slider with a range, a value and a tolerance.
import {numberText} from "./values.js";

// "0.9", "0.9±0.001", "9/10": the value's text and that of its tolerance.
export function splitValue(text) {
  const at = text.search(/±|\+-/);
  return at < 0
    ? [text.trim(), ""]
    : [
        text.slice(0, at).trim(),
        text
          .slice(at)
          .replace(/^(±|\+-)/, "")
          .trim(),
      ];
}

const steps = 1000;

// A decimal with as many digits as a step of the range needs.
function decimal(value, [low, high]) {
  const digits = Math.max(0, Math.min(12, Math.ceil(-Math.log10((high - low) / steps))));
  return String(Number(value.toFixed(digits)));
}

function usualRange(value) {
  if (value === 0) return [-1, 1];
  const [a, b] = [value / 2, 2 * value];
  return value > 0 ? [a, b] : [b, a];
}

export class Sliders {
  // `onValue(name, text)`: text null is the value of the model's text; `onRange(name, range)`.
  constructor(root, onValue, onRange) {
    Object.assign(this, {root, onValue, onRange});
    this.rows = new Map();
  }

  // `constants`: [{name, value, text, tolerance}] as they are now; `given` and `ranges` by name. Rows stay where names stay: one may be
  // under a finger.
  show(constants, given, ranges) {
    if ([...this.rows.keys()].join("\n") !== constants.map(({name}) => name).join("\n")) this.build(constants);
    for (const constant of constants) this.fill(this.rows.get(constant.name), constant, given[constant.name], ranges);
  }

  build(constants) {
    this.root.replaceChildren();
    this.rows.clear();
    if (constants.length === 0)
      this.root.innerHTML = `<p class="fine">The model has no constants: write lengths under [CONSTANTS].</p>`;
    for (const {name} of constants) {
      const row = document.createElement("div");
      row.className = "constant-row";
      row.innerHTML = `<label></label><input type="range" min="0" max="${steps}"><input class="value" size="7"><button type="button" class="more" aria-expanded="false" title="Range and tolerance">⋯</button><div class="limits" hidden><label>from <input class="low" size="6"></label><label>to <input class="high" size="6"></label><label>± <input class="tolerance" size="6"></label><button type="button" class="back" title="As in the text">↺</button></div>`;
      const part = (selector) => row.querySelector(selector);
      const entry = {
        row,
        name,
        slider: part("input[type=range]"),
        value: part(".value"),
        low: part(".low"),
        high: part(".high"),
        tolerance: part(".tolerance"),
      };
      part("label").textContent = name;
      entry.slider.setAttribute("aria-label", name);
      entry.value.setAttribute("aria-label", `${name}, value`);
      entry.tolerance.setAttribute("aria-label", `${name}, tolerance`);
      entry.slider.addEventListener("input", () => this.slide(entry));
      entry.value.addEventListener("change", () => this.write(entry));
      entry.tolerance.addEventListener("change", () => this.write(entry));
      for (const end of [entry.low, entry.high])
        end.addEventListener("change", () => {
          const range = [Number(entry.low.value), Number(entry.high.value)];
          if (range[0] < range[1]) this.onRange(name, range);
        });
      part(".back").addEventListener("click", () => this.onValue(name, null));
      part(".more").addEventListener("click", ({target}) => {
        const limits = part(".limits");
        limits.hidden = !limits.hidden;
        target.setAttribute("aria-expanded", String(!limits.hidden));
      });
      this.rows.set(name, entry);
      this.root.append(row);
    }
  }

  fill(entry, {name, value, tolerance}, given, ranges) {
    if (ranges[name]) entry.range = ranges[name];
    else if (!entry.range || (!given && entry.base !== value)) entry.range = usualRange(value);
    if (!given) entry.base = value;
    const [low, high] = entry.range;
    if (value < low || value > high) entry.range = [Math.min(low, value), Math.max(high, value)];
    const active = document.activeElement;
    if (active !== entry.slider || !given)
      entry.slider.value = String(((value - entry.range[0]) / (entry.range[1] - entry.range[0])) * steps);
    entry.slider.setAttribute("aria-valuetext", numberText(value));
    const [text, spread] = given ? splitValue(given) : [decimal(value, [0, Math.abs(value) || 1]), ""];
    if (active !== entry.value) entry.value.value = text;
    if (active !== entry.tolerance)
      entry.tolerance.value =
        spread || (tolerance ? String(Number(((tolerance[1] - tolerance[0]) / 2).toPrecision(4))) : "");
    if (active !== entry.low) entry.low.value = decimal(entry.range[0], entry.range);
    if (active !== entry.high) entry.high.value = decimal(entry.range[1], entry.range);
    entry.row.classList.toggle("given", Boolean(given));
  }

  slide(entry) {
    const [low, high] = entry.range;
    entry.value.value = decimal(low + ((high - low) * Number(entry.slider.value)) / steps, entry.range);
    this.write(entry);
  }

  write({name, value, tolerance}) {
    this.onValue(name, tolerance.value.trim() ? `${value.value}±${tolerance.value.trim()}` : value.value);
  }
}
