// The model's text: highlighted, with its lines' numbers and the place of an error.
import {htmlText} from "./values.js";

const kinds =
  /(?<comment>(?:%|\/\/)[^\n]*)|(?<section>^[ \t]*\[[A-Z][A-Z _]*\])|(?<number>\b\d+(?:\.\d+)?(?:[eE][-+]?\d+)?\b)|(?<word>\b(?:revolute|prismatic|cylindrical|universal|spherical|slot|planar|parallelogram|fix|gear|sph_sph|sph_prs_sph|uni_prs_uni|actuated|limits|range|zero|length|pose|position|orientation|joint|point|line|unit|link|ground|effector|platform|slider|hinge|ball|circle|keep|sin|cos|tan|sqrt|pi|of)\b)|(?<operator>:=|~|±|\+-|[-+*/^=])/gm;

export function highlighted(text) {
  let html = "",
    from = 0;
  for (const match of text.matchAll(kinds)) {
    const kind = Object.keys(match.groups).find((name) => match.groups[name] !== undefined);
    html += `${htmlText(text.slice(from, match.index))}<span class="${kind}">${htmlText(match[0])}</span>`;
    from = match.index + match[0].length;
  }
  return html + htmlText(text.slice(from));
}

export class Editor {
  // `onText(text)`: it was changed by hand.
  constructor(root, problem, onText) {
    this.area = root.querySelector("textarea");
    this.shown = root.querySelector("pre");
    this.gutter = root.querySelector(".gutter");
    this.problem = problem;
    this.area.addEventListener("input", () => {
      this.draw();
      onText(this.area.value);
    });
    this.area.addEventListener("scroll", () => this.follow());
    this.area.addEventListener("keydown", (event) => this.key(event));
    problem.addEventListener("click", () => this.goTo(this.error));
  }

  // Tab indents, but Escape lets it leave the text.
  key(event) {
    if (event.key === "Escape") this.leaving = true;
    else if (event.key === "Tab" && !event.shiftKey && !this.leaving) {
      event.preventDefault();
      document.execCommand("insertText", false, "  ");
    } else if (event.key !== "Shift") this.leaving = false;
  }

  get text() {
    return this.area.value;
  }
  set text(text) {
    if (this.area.value === text) return;
    this.area.value = text;
    this.draw();
  }

  draw() {
    const text = this.area.value;
    // A last line break would have no height.
    this.shown.innerHTML = `${highlighted(text)}\n`;
    const lines = text.split("\n").length;
    this.gutter.innerHTML = Array.from({length: lines}, (_, k) =>
      this.error?.line === k + 1 ? `<b>${k + 1}</b>` : `<span>${k + 1}</span>`,
    ).join("");
    this.markLine();
    this.follow();
  }

  markLine() {
    this.shown.querySelector(".mark")?.remove();
    if (!this.error?.line) return;
    const mark = document.createElement("i");
    mark.className = "mark";
    mark.style.setProperty("--line", this.error.line - 1);
    this.shown.append(mark);
  }

  follow() {
    this.shown.style.transform = `translate(${-this.area.scrollLeft}px, ${-this.area.scrollTop}px)`;
    this.gutter.style.transform = `translateY(${-this.area.scrollTop}px)`;
  }

  // {message, line, column}, or null.
  showError(error) {
    if (!error && !this.error) return;
    this.error = error;
    this.problem.textContent = error ? (error.line ? `line ${error.line}: ${error.message}` : error.message) : "";
    this.problem.classList.toggle("somewhere", Boolean(error?.line));
    this.area.setAttribute("aria-invalid", String(Boolean(error)));
    this.draw();
  }

  goTo(error) {
    if (!error?.line) return;
    const lines = this.area.value.split("\n");
    const at =
      lines.slice(0, error.line - 1).reduce((sum, line) => sum + line.length + 1, 0) + Math.max(0, error.column - 1);
    this.area.focus();
    this.area.setSelectionRange(at, at);
    const height = this.area.scrollHeight / Math.max(1, lines.length);
    this.area.scrollTop = height * (error.line - 4);
  }
}
