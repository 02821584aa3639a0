// A family's page: the output portraits of all members, small and side by side, and one of them large, with a slider.
import {readSet} from "./data.js";
import {Picture, pageColours} from "./picture.js";
import {smallGroups} from "./spots.js";
import {followTheme, takeTheme} from "./theme.js";
import {htmlLabel, htmlText, htmlUnit, numberText, withMinus} from "./values.js";

const smallPad = {left: 1, right: 1, top: 1, bottom: 1};

function readFamily() {
  const model = JSON.parse(document.getElementById("model").textContent);
  model.members.forEach((member, k) => {
    member.sets = member.sets.map((description) => readSet(description, `${k}-${description.name}`));
  });
  return model;
}

class Family {
  constructor(model) {
    this.model = model;
    this.hidden = new Set();
    this.pictures = model.members.map(({sets}) => {
      const picture = new Picture(model, sets, model.coordinates);
      picture.hidden = this.hidden;
      return picture;
    });
    this.shareLimits();
    this.spots = this.pictures.map((picture) => this.spotsOf(picture));
    this.frame = document.querySelector("#large .frame");
    this.canvas = this.frame.querySelector("canvas");
    this.place = document.querySelector("#large .place");
    this.slider = document.getElementById("slider");
    this.buttons = [...document.querySelectorAll("#small .member")];
    this.current = 0;
    this.listen();
    this.choose(0);
    const observer = new ResizeObserver(() => this.draw());
    observer.observe(this.frame);
    observer.observe(document.getElementById("small"));
  }

  // One frame for all, so that pictures can be compared.
  shareLimits() {
    const filled = this.pictures.filter(({sets}) => sets.some(({count}) => count > 0));
    if (filled.length === 0) return;
    this.limits = [0, 1].map((axis) => [
      Math.min(...filled.map(({limits}) => limits[axis][0])),
      Math.max(...filled.map(({limits}) => limits[axis][1])),
    ]);
    for (const picture of this.pictures) picture.limits = this.limits;
  }

  // Of each locus of curves the places of its pieces that are no wider than a few boxes: {name, x, y}.
  spotsOf({projections}) {
    return projections
      .filter(({set}) => set.singular && set.dimension === 1)
      .flatMap((projection) =>
        smallGroups(projection, 3 * projection.set.sigma).map(([x0, x1, y0, y1]) => ({
          name: projection.set.name,
          x: (x0 + x1) / 2,
          y: (y0 + y1) / 2,
        })),
      );
  }

  listen() {
    this.slider.addEventListener("input", () => this.choose(Number(this.slider.value)));
    this.buttons.forEach((button, k) => {
      button.addEventListener("click", () => this.choose(k));
      button.addEventListener("keydown", (event) => this.key(event, k));
    });
    for (const row of document.querySelectorAll("#counts tbody tr"))
      row.addEventListener("click", () => this.choose(Number(row.dataset.member)));
    for (const box of document.querySelectorAll("input.toggle")) {
      box.addEventListener("change", () => {
        this.hidden[box.checked ? "delete" : "add"](box.value);
        this.draw();
      });
    }
    this.canvas.addEventListener("pointermove", (event) => this.tell(event));
    this.canvas.addEventListener("pointerleave", () => (this.place.textContent = ""));
  }

  key(event, k) {
    const last = this.buttons.length - 1;
    const to = {ArrowLeft: k - 1, ArrowUp: k - 1, ArrowRight: k + 1, ArrowDown: k + 1, Home: 0, End: last}[event.key];
    if (to === undefined) return;
    event.preventDefault();
    this.choose(Math.min(last, Math.max(0, to)));
    this.buttons[this.current].focus();
  }

  // The coordinates under the pointer.
  tell(event) {
    const box = this.canvas.getBoundingClientRect();
    const {plane} = this.pictures[this.current];
    const at = plane.fromPixels(event.clientX - box.left, event.clientY - box.top);
    this.place.innerHTML = plane.holds(at)
      ? this.model.coordinates
          .map((axis, k) => `${htmlLabel(axis)} = ${numberText(at[k], 3)} ${htmlUnit(this.model, axis)}`.trim())
          .join(", ")
      : "";
  }

  choose(k) {
    this.current = k;
    const {constant, members} = this.model;
    const text = withMinus(members[k].text);
    this.slider.value = k;
    this.slider.setAttribute("aria-valuetext", `${constant.name} = ${text}, ${k + 1} of ${members.length}`);
    for (const shown of document.querySelectorAll(".value")) shown.innerHTML = `${htmlLabel(constant)} = ${htmlText(text)}`;
    this.canvas.setAttribute("aria-label", `Output portrait for ${constant.name} = ${text}`);
    this.buttons.forEach((button, i) => button.setAttribute("aria-pressed", String(i === k)));
    for (const cards of document.querySelectorAll("#result .cards")) cards.hidden = Number(cards.dataset.member) !== k;
    for (const row of document.querySelectorAll("#counts tbody tr"))
      row.classList.toggle("current", Number(row.dataset.member) === k);
    if (this.canvas.width > 0) this.drawLarge();
  }

  draw() {
    this.buttons.forEach((button, k) => {
      const canvas = button.querySelector("canvas");
      this.paint(k, canvas, canvas.clientWidth, smallPad);
    });
    this.drawLarge();
  }

  drawLarge() {
    const height = this.paint(this.current, this.canvas, this.frame.clientWidth);
    if (height) this.frame.style.height = `${height}px`;
  }

  paint(k, canvas, width, pad) {
    if (!width) return 0;
    const picture = this.pictures[k],
      ratio = devicePixelRatio || 1,
      height = picture.layOut(width, pad);
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    if (pad) canvas.style.height = `${height}px`;
    picture.paint(canvas, ratio, pageColours(canvas));
    this.paintSpots(k, canvas.getContext("2d"), pad ? 2.6 : 5);
    return height;
  }

  paintSpots(k, context, radius) {
    const {plane, colours} = this.pictures[k];
    for (const {name, x, y} of this.spots[k]) {
      if (this.hidden.has(name)) continue;
      context.beginPath();
      context.arc(plane.toX(x), plane.toY(y), radius, 0, 7);
      context.fillStyle = colours.of({name});
      context.strokeStyle = colours.paper;
      context.lineWidth = 0.6 * radius;
      context.stroke();
      context.fill();
    }
  }
}

function showFamily() {
  takeTheme();
  const family = new Family(readFamily());
  followTheme(() => family.draw());
  window.corank = {family, model: family.model};
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

showFamily();
