// A planar linkage that is drawn by clicks, and its text in the parts language.

const size = {width: 12, height: 6.4}, // of the board, in units of length
  snap = 0.1,
  near = 0.28; // a click means a joint that is no farther
const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";

const number = (x) => String(Number(x.toFixed(3)));

// `linkage`: {joints: [{x, y}], links: [[joint, joint, …]], ground: [joint …], motors: [joint …], output: joint or null}. Throws an
// Error that says what is missing.
export function linkageText({joints, links, ground, motors, output}) {
  const name = (i) => letters[i];
  if (links.length === 0) throw new Error("draw links: each joins two joints or more");
  if (ground.length === 0) throw new Error("fix a joint to the ground");
  if (motors.length === 0) throw new Error("give a joint a motor");
  if (output === null) throw new Error("choose the joint whose position is the output");
  const bodies = joints.map((_, i) => [
    ...(ground.includes(i) ? ["base"] : []),
    ...links.flatMap((link, k) => (link.includes(i) ? [`link${k + 1}`] : [])),
  ]);
  const loose = motors.find((i) => bodies[i].length < 2);
  if (loose !== undefined) throw new Error(`the motor at ${name(loose)} joins nothing: link it, or fix it to the ground`);
  const carrier = bodies[output].find((body) => body !== "base");
  if (ground.includes(output) || !carrier) throw new Error(`${name(output)} does not move: choose another output`);

  const constants = [],
    parts = [],
    lines = [];
  const constant = (word, value) => {
    constants.push(`${word} := ${number(value)}`);
    return word;
  };
  const origin = joints[ground[0]];
  parts.push(
    `base : ${ground
      .map((i, k) => {
        const [x, y] = [joints[i].x - origin.x, joints[i].y - origin.y];
        const place =
          k === 0 ? "0, 0" : `${constant(`x${name(i)}`, x)}, ${number(y) === "0" ? "0" : constant(`y${name(i)}`, y)}`;
        return `point ${name(i)} (${place}, 0)`;
      })
      .join("   ")}`,
  );
  links.forEach((link, k) => {
    const [a, b, ...more] = link,
      along = [joints[b].x - joints[a].x, joints[b].y - joints[a].y],
      length = Math.hypot(...along);
    const points = [`point ${name(a)} (0, 0, 0)`, `point ${name(b)} (${constant(`l${name(a)}${name(b)}`, length)}, 0, 0)`];
    for (const i of more) {
      const off = [joints[i].x - joints[a].x, joints[i].y - joints[a].y];
      const u = (off[0] * along[0] + off[1] * along[1]) / length,
        v = (off[1] * along[0] - off[0] * along[1]) / length;
      points.push(`point ${name(i)} (${constant(`u${name(i)}_${k + 1}`, u)}, ${constant(`v${name(i)}_${k + 1}`, v)}, 0)`);
    }
    parts.push(`link${k + 1} : ${points.join("   ")}`);
  });
  const axis = (body, i) => `${body} ${name(i)} + (0, 0, 1)`;
  bodies.forEach((list, i) => {
    list.slice(1).forEach((body, k) => {
      const motor = k === 0 && motors.includes(i);
      const word = motor ? `theta${motors.indexOf(i) + 1}` : `${name(i)}${k === 0 ? "" : k + 1}`;
      lines.push(`revolute ${word} : ${axis(list[0], i)}   ${axis(body, i)}${motor ? "   actuated" : ""}`);
    });
  });
  return [
    "% A planar linkage, drawn in the studio.",
    "",
    "[CONSTANTS]",
    ...constants,
    "",
    "[LINKS]",
    ...parts,
    "",
    "[JOINTS]",
    ...lines,
    "",
    "[OUTPUTS]",
    `${name(output)} : position of ${carrier}.${name(output)}`,
    "",
  ].join("\n");
}

const tools = {
  joint: ["Joints", "Click where joints are. Click a joint and drag it to move it."],
  link: [
    "Links",
    "Click two joints to join them by a link. With Shift, click more joints of the same link; the next click ends it.",
  ],
  ground: ["Ground", "Click the joints that are fixed to the ground."],
  motor: ["Motors", "Click the joints that a motor turns: as many as the linkage has degrees of freedom."],
  output: ["Output", "Click the joint whose position is the output."],
  erase: ["Erase", "Click a joint to take it away, with its links."],
};

export class LinkageBoard {
  // `onDone(text)`: the linkage is to be used.
  constructor(dialog, onDone) {
    Object.assign(this, {dialog, onDone});
    this.board = dialog.querySelector(".board");
    this.hint = dialog.querySelector("#drawing-hint");
    this.problem = dialog.querySelector("#drawing-problem");
    this.board.setAttribute("viewBox", `0 0 ${size.width} ${size.height}`);
    this.cursor = [size.width / 2, size.height / 2];
    this.clear();
    const bar = dialog.querySelector(".drawing-tools");
    for (const [tool, [title]] of Object.entries(tools)) {
      const button = document.createElement("button");
      Object.assign(button, {type: "button", textContent: title});
      button.dataset.tool = tool;
      button.addEventListener("click", () => this.choose(tool));
      bar.append(button);
    }
    const anew = document.createElement("button");
    Object.assign(anew, {type: "button", textContent: "Clear"});
    anew.addEventListener("click", () => this.clear());
    bar.append(anew);
    dialog.querySelector("#drawing-done").addEventListener("click", () => this.use());
    this.board.addEventListener("pointerdown", (event) => this.press(event));
    this.board.addEventListener("pointermove", (event) => this.pull(event));
    for (const name of ["pointerup", "pointercancel"]) this.board.addEventListener(name, () => (this.held = null));
    this.board.addEventListener("keydown", (event) => this.key(event));
    this.choose("joint");
  }

  clear() {
    Object.assign(this, {joints: [], links: [], ground: [], motors: [], output: null, open: null});
    this.draw();
  }

  choose(tool) {
    this.tool = tool;
    this.open = null;
    this.hint.textContent = tools[tool][1];
    for (const button of this.dialog.querySelectorAll("[data-tool]"))
      button.setAttribute("aria-pressed", String(button.dataset.tool === tool));
    this.draw();
  }

  place(event) {
    const {x, y} = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.board.getScreenCTM().inverse());
    return [x, y];
  }

  jointAt([x, y]) {
    let best = -1,
      least = near;
    this.joints.forEach((joint, i) => {
      const far = Math.hypot(joint.x - x, size.height - joint.y - y);
      if (far < least) [best, least] = [i, far];
    });
    return best;
  }

  press(event) {
    const at = this.place(event);
    this.click(at, event.shiftKey);
    if (this.tool !== "joint") return;
    this.held = this.jointAt(at);
    this.board.setPointerCapture(event.pointerId);
  }

  pull(event) {
    if (!(this.held >= 0) || this.held === null) return;
    const [x, y] = this.snapped(this.place(event));
    Object.assign(this.joints[this.held], {x, y: size.height - y});
    this.draw();
  }

  snapped([x, y]) {
    const to = (value, most) => Math.min(most - 0.3, Math.max(0.3, Math.round(value / snap) * snap));
    return [to(x, size.width), to(y, size.height)];
  }

  // `more`: the joint goes on with the link that was drawn last.
  click(at, more) {
    const i = this.jointAt(at);
    this.problem.textContent = "";
    const toggle = (list) => (list.includes(i) ? list.filter((k) => k !== i) : [...list, i]);
    if (this.tool === "joint") {
      if (i < 0 && this.joints.length < letters.length) {
        const [x, y] = this.snapped(at);
        this.joints.push({x, y: size.height - y});
      }
    } else if (i < 0) {
      this.open = null;
    } else if (this.tool === "link") {
      const last = this.links[this.links.length - 1];
      if (more && last && this.open === null && !last.includes(i)) last.push(i);
      else if (this.open === null) this.open = i;
      else {
        if (this.open !== i) this.links.push([this.open, i]);
        this.open = null;
      }
    } else if (this.tool === "ground") this.ground = toggle(this.ground);
    else if (this.tool === "motor") this.motors = toggle(this.motors);
    else if (this.tool === "output") this.output = this.output === i ? null : i;
    else this.erase(i);
    this.draw();
  }

  erase(i) {
    const rest = (list) => list.filter((k) => k !== i).map((k) => (k > i ? k - 1 : k));
    this.joints.splice(i, 1);
    this.links = this.links.map(rest).filter((link) => link.length > 1);
    this.ground = rest(this.ground);
    this.motors = rest(this.motors);
    this.output = this.output === null || this.output === i ? null : this.output - (this.output > i ? 1 : 0);
  }

  key(event) {
    const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (step) {
      const far = event.shiftKey ? 5 * snap : snap;
      this.cursor = this.snapped(this.cursor.map((value, k) => value + far * step[k]));
    } else if (event.key === "Enter" || event.key === " ") this.click(this.cursor, event.shiftKey);
    else return;
    event.preventDefault();
    this.draw();
  }

  use() {
    try {
      const text = linkageText(this);
      this.dialog.close();
      this.onDone(text);
    } catch (error) {
      this.problem.textContent = error.message;
    }
  }

  draw() {
    const at = ({x, y}) => [x, size.height - y];
    const shapes = [];
    for (let x = 1; x < size.width; ++x) shapes.push(`<path class="grid" d="M${x} 0V${size.height}"/>`);
    for (let y = 0; y < size.height; ++y) shapes.push(`<path class="grid" d="M0 ${size.height - y}H${size.width}"/>`);
    for (const link of this.links) {
      const corners = link.map((i) => at(this.joints[i]).join(",")).join(" ");
      shapes.push(`<polygon class="bar${link.length > 2 ? " plate" : ""}" points="${corners}"/>`);
    }
    this.joints.forEach((joint, i) => {
      const [x, y] = at(joint);
      if (this.ground.includes(i)) shapes.push(`<path class="foot" d="M${x} ${y}l-.18 .3h.36Z"/>`);
      if (this.output === i) shapes.push(`<circle class="out" cx="${x}" cy="${y}" r=".22"/>`);
      const kind = `pin${this.motors.includes(i) ? " motor" : ""}${this.open === i ? " open" : ""}`;
      shapes.push(
        `<circle class="${kind}" cx="${x}" cy="${y}" r=".12"/><text x="${x + 0.2}" y="${y - 0.18}">${letters[i]}</text>`,
      );
    });
    shapes.push(`<path class="cursor" d="M${this.cursor[0] - 0.15} ${this.cursor[1]}h.3m-.15 -.15v.3"/>`);
    this.board.innerHTML = shapes.join("");
  }
}
