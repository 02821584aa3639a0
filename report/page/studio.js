// Puts the studio together: what is typed and slid goes to the server, what comes back goes into the portraits.
import {Aspects, aspectLegend} from "./aspects.js";
import {axisOrder, firstOf} from "./axis_choice.js";
import {liveSet} from "./data.js";
import {pointOfBox} from "./newton.js";
import {Panel} from "./panel.js";
import {Portrait} from "./portrait.js";
import {clearest, sampleConfigurations} from "./samples.js";
import {Space} from "./space.js";
import {Bench} from "./studio_bench.js";
import {Editor} from "./studio_editor.js";
import {download, listenToDrops, modelOfFiles, shared, titleOf} from "./studio_files.js";
import {Link} from "./studio_link.js";
import {LinkageBoard} from "./studio_linkage.js";
import {Sliders} from "./studio_sliders.js";
import {Design} from "./studio_state.js";
import {followTheme, takeTheme} from "./theme.js";
import {groupedText, htmlText, isAngle} from "./values.js";

const element = (id) => document.getElementById(id);

class Studio {
  constructor() {
    takeTheme();
    const start = JSON.parse(element("start").textContent);
    this.templates = start.templates;
    this.model = null; // what the pictures show; null: nothing yet
    this.usual = [];
    this.hidden = new Set();
    this.times = []; // ms from a request to its first picture
    this.design = new Design(start, (kind) => this.changed(kind));
    this.editor = new Editor(document.querySelector(".editor"), element("problem"), (text) =>
      this.design.change("text", {text}),
    );
    this.sliders = new Sliders(
      element("constants"),
      (name, value) => this.setConstant(name, value),
      (name, range) => this.design.change("ranges", {ranges: {...this.design.now.ranges, [name]: range}}),
    );
    const token = new URLSearchParams(location.search).get("token");
    this.link = new Link(
      token,
      (event) => this.hear(event),
      (state) => this.showLink(state),
    );
    this.listen();
    this.changed("all");
    if (!start.text) this.openGallery();
  }

  setConstant(name, value) {
    const constants = {...this.design.now.constants};
    if (value === null) delete constants[name];
    else constants[name] = value;
    this.design.change(`constant ${name}`, {constants});
  }

  // The design is another one.
  changed(kind) {
    const {file, text} = this.design.now;
    if (kind === "all") this.editor.text = text;
    element("name").textContent = file;
    element("undo").disabled = this.design.before.length === 0;
    element("redo").disabled = this.design.after.length === 0;
    if (this.constants && kind !== "text" && kind !== "all")
      this.sliders.show(this.constants, this.design.now.constants, this.design.now.ranges);
    if (kind === "ranges") return;
    if (text.trim()) this.link.ask(this.design.request("picture", this.sets()));
  }

  sets() {
    return (
      this.design.now.sets ?? (this.usual.length > 0 ? this.usual : ["cspace", "forward", "inverse", "cspace-singular"])
    );
  }

  // --- what the server says

  hear(event) {
    this[`on_${event.event}`]?.(event);
  }

  on_sent({number, request}) {
    this.asked = {number, request, first: null};
    clearTimeout(this.slow);
    this.slow = setTimeout(() => document.body.classList.add("pending"), 150);
    element("status").textContent = request.want === "report" ? "making the report …" : "computing …";
    element("share-done").hidden = true;
  }

  on_model(event) {
    this.editor.showError(null);
    this.constants = event.constants;
    this.sliders.show(event.constants, this.design.now.constants, this.design.now.ranges);
    this.available = event.sets;
    this.usual = event.sets.filter(({usual, name}) => usual || name === "requirements").map(({name}) => name);
    element("notices").textContent = event.notices.join(" ");
    this.refused = new Map();
    if (!this.model) this.showSets();
  }

  on_error(event) {
    this.ended = event.number;
    clearTimeout(this.slow);
    document.body.classList.remove("pending");
    document.body.classList.add("broken");
    element("status").textContent = "the model has an error";
    element("share-done").hidden = true;
    this.editor.showError(event);
  }
  on_bad(event) {
    this.on_error({...event, line: 0});
  }

  on_refused({set, message}) {
    this.refused.set(set, message);
    this.showSets();
  }

  on_progress({set, share, boxes, pass}) {
    const bar = element("share-done");
    bar.hidden = false;
    bar.value = share;
    element("status").textContent =
      `${pass === 0 ? "looking at" : "refining"} ${this.titleOf(set)}: ${groupedText(boxes)} boxes`;
  }

  on_picture(event) {
    const {number, pass, model} = event;
    const begins = this.asked.first === null;
    const known = begins ? new Map() : new Map(this.model.sets.map((set) => [set.name, set]));
    for (const set of model.sets) known.set(set.name, liveSet(set));
    const order = this.asked.request.sets;
    const sets = [...known.values()].sort((a, b) => order.indexOf(a.name) - order.indexOf(b.name));
    this.cards = {...(begins ? {} : this.cards), ...Object.fromEntries(model.sets.map(({name, card}) => [name, card]))};
    // Without a set that was asked for: it comes later.
    const partial = pass === 0 && order.some((name) => !known.has(name) && !this.refused.has(name));
    this.model = {...model, sets, aspects: null, partial};
    this.shown = {number, pass, constants: this.asked.request.constants};
    clearTimeout(this.slow);
    document.body.classList.remove("pending", "broken");
    this.draw();
    if (begins) {
      this.asked.first = performance.now() - this.link.sent;
      this.times.push(this.asked.first);
      if (this.times.length > 1000) this.times.shift();
    }
    element("status").textContent = pass === 0 ? "coarse boxes …" : "finer boxes …";
    if (partial) return;
    this.showSets();
    element("findings").innerHTML = sets.map(({name}) => this.cards[name]).join("");
  }

  on_aspects({aspects, summary}) {
    const cspace = this.model.sets.find(({singular}) => !singular);
    this.model.aspects = aspects && cspace ? new Aspects(cspace, aspects) : null;
    this.aspectWords =
      summary ??
      "Nothing is known of aspects: they need C-space as a whole, of dimension 1 or 2, and as many inputs as outputs.";
    this.showAspects();
  }

  on_done({number, complete, seconds}) {
    this.ended = number;
    this.showSets();
    element("share-done").hidden = true;
    const first = this.asked.first === null ? "" : `first picture after ${Math.round(this.asked.first)} ms, `;
    element("status").textContent =
      `${first}done after ${seconds.toFixed(2)} s${complete ? ": every solution is in a box" : "; a limit ended a search: what is missing is shown as not searched"}`;
    if (this.asked.request.want === "report") this.link.ask(this.design.request("picture", this.sets()));
  }

  on_report({name, html}) {
    download(`${name}-report.html`, html, "text/html");
    this.lastReport = html.length;
  }

  showLink(state) {
    const banner = element("banner");
    banner.hidden = state === "open";
    this.linkState = state;
    if (state === "lost") banner.textContent = "The studio’s server does not answer: it has ended, or shows too many windows. Your model is still here: Save keeps it.";
    if (state === "ended") banner.textContent = "Another run of corank studio answers here. Open the address that it prints; your model is still here: Save keeps it.";
  }

  // --- pictures

  draw() {
    const {model} = this;
    document.querySelector("#portraits .aspects-legend").hidden = !model.aspects;
    const order = axisOrder(model).sort((a, b) => this.rankOf(model, a) - this.rankOf(model, b));
    const filled = model.sets.filter(({count}) => count > 0);
    const base = filled.find(({singular}) => !singular) ?? filled[0];
    const three = [...new Set([...order, 0, 1, 2].filter((i) => i < model.coordinates.length))].slice(0, 3);
    document.body.classList.toggle("undrawn", model.drawing.points.length === 0);
    if (!this.samples || !model.partial) this.samples = sampleConfigurations(model, base, 80);
    const {samples} = this;
    const everywhere = samples.map(({values}) => values);
    if (!this.panel) this.build(model, order, three, everywhere);
    else {
      for (const [role, portrait] of this.views) portrait.setModel(model, firstOf(order, model, role));
      this.panel.setModel(model, everywhere);
      this.showSpaceLater(model, three);
    }
    this.bench.setModel(model, () => (model.partial ? null : this.typical(samples)));
    if (!this.bench.dragging && this.bench.x) this.bench.end();
  }

  // Of one role lengths come before angles: a place in the plane is what one looks for first.
  rankOf({coordinates}, i) {
    return 2 * ["output", "input", "passive", "auxiliary"].indexOf(coordinates[i].role) + (isAngle(coordinates[i]) ? 1 : 0);
  }

  // The view in space takes longest to draw: it comes when nothing has changed for a while, and shows nothing until then.
  showSpaceLater(model, three) {
    if (!this.space) return;
    element("space").classList.add("waiting");
    clearTimeout(this.spaceTimer);
    this.spaceTimer = setTimeout(() => {
      if (model !== this.model || model.partial) return;
      this.space.setModel(model, three);
      this.space.mark(this.panel.current);
      element("space").classList.remove("waiting");
    }, 250);
  }

  // A configuration to begin with: clear to see, and not next to a singularity.
  typical(samples) {
    const far = samples
      .map((sample) => ({...sample, distance: this.bench.distanceAt(this.model, pointOfBox(sample.set, sample.box).x)}))
      .sort((a, b) => b.distance - a.distance);
    const sample = clearest(this.model, far.slice(0, Math.ceil(far.length / 3)));
    return sample && Float64Array.from({length: sample.set.configuration}, (_, j) => sample.set.middle(sample.box, j));
  }

  build(model, order, three, everywhere) {
    this.panel = new Panel(model, element("panel"), everywhere, (configuration) => {
      for (const [, portrait] of this.views) portrait.show(configuration);
      this.space?.mark(configuration);
      if (configuration) this.bench.take(configuration);
    });
    const listener = {
      hover: () => {},
      pin: (candidates, place, portrait) => candidates.length > 0 && this.panel.pin(candidates, place, portrait),
      step: (direction) => this.panel.step(direction),
      escape: () => this.panel.unpin(),
    };
    this.views = ["output", "input"].map((role) => [
      role,
      new Portrait(model, element(`${role}-portrait`), firstOf(order, model, role), listener),
    ]);
    for (const [, portrait] of this.views) portrait.hidden = portrait.picture.hidden = this.hidden;
    if (three.length === 3) {
      this.space = new Space(model, element("space"), three, (set, box) => this.panel.pinBox(set, box));
      this.space.hidden = this.hidden;
    }
    this.bench = new Bench(
      this.panel,
      this.views.map(([, portrait]) => portrait),
      element("panel"),
    );
  }

  redraw() {
    if (!this.model) return;
    for (const [, portrait] of this.views) portrait.draw();
    this.space?.build();
  }

  // --- sets

  titleOf(name) {
    return this.available?.find((set) => set.name === name)?.title ?? name;
  }

  showSets() {
    const root = element("sets"),
      chosen = this.sets();
    const shown = new Map((this.model?.sets ?? []).map((set) => [set.name, set]));
    const item = ({name, title}) => {
      const set = shown.get(name),
        refused = this.refused?.get(name);
      const undecided = set ? set.verdicts.filter((v) => this.model.verdicts[v] === "undecided").length : 0;
      const counts = refused
        ? `<small title="${htmlText(refused)}">not for this robot</small>`
        : set && chosen.includes(name)
          ? `<small>${groupedText(set.count)}${undecided ? ` · <span class="verdict undecided">${groupedText(undecided)} undecided</span>` : ""}</small>`
          : "";
      return `<label><input type="checkbox" class="toggle" value="${name}"${chosen.includes(name) ? " checked" : ""}><span class="swatch ${name}"></span>${title}&nbsp;${counts}</label>`;
    };
    const main = this.available.filter(({name, usual}) => usual || chosen.includes(name) || name === "requirements");
    const rest = this.available.filter((set) => !main.includes(set));
    const open = root.querySelector("details")?.open;
    const html = `${main.map(item).join("")}<span class="item"><span class="ring"></span>undecided</span><span class="item"><span class="swatch pending"></span>not searched</span><label><input type="checkbox" class="by-aspect"${this.design.now.aspects ? " checked" : ""}>aspects in colour</label><label title="Slower robots are quicker to change without"><input type="checkbox" class="fine"${this.design.now.fine ? " checked" : ""}>finer boxes</label><details${open ? " open" : ""}><summary>more sets</summary>${rest.map(item).join("")}</details>`;
    if (html === this.setsHtml) return;
    const focus = document.activeElement?.value;
    this.setsHtml = root.innerHTML = html;
    if (focus) root.querySelector(`input[value="${CSS.escape(focus)}"]`)?.focus();
  }

  chooseSet(name, on) {
    const chosen = this.sets().filter((set) => set !== name);
    const order = this.available.map((set) => set.name);
    const sets = on ? [...chosen, name].sort((a, b) => order.indexOf(a) - order.indexOf(b)) : chosen;
    if (sets.length === 0) return this.showSets();
    this.design.change("sets", {sets});
  }

  showAspects() {
    const {aspects} = this.model,
      list = document.querySelector("#portraits .aspects-legend");
    list.replaceChildren();
    list.hidden = !this.design.now.aspects;
    if (aspects)
      aspectLegend(aspects, element("portraits"), (on) => this.views.forEach(([, p]) => p.setByAspect(on)), () => this.redraw());
    if (this.space) this.space.byAspect = Boolean(aspects);
    list.insertAdjacentHTML("afterbegin", `<span class="item">${htmlText(this.aspectWords.split("\n")[0])}</span>`);
    this.redraw();
  }

  // --- buttons and keys

  listen() {
    const on = (id, action) => element(id).addEventListener("click", action);
    on("undo", () => this.design.undo());
    on("redo", () => this.design.redo());
    on("save", () => this.save());
    on("reset", () => this.design.change("reset", {constants: {}}));
    on("share", () =>
      download(this.design.now.file.replace(/\.[a-z]+$/, "") + ".studio.json", shared(this.design), "application/json"),
    );
    on("report", () => this.link.ask({...this.design.request("report", this.sets()), command: this.command()}));
    on("command", () => this.copyCommand());
    on("new", () => this.openGallery());
    on("open", () => element("file").click());
    on("draw", () => (element("gallery").close(), element("drawing").showModal()));
    element("file").addEventListener("change", ({target}) => (this.take(target.files), (target.value = "")));
    listenToDrops((files) => this.take(files));
    this.board = new LinkageBoard(element("drawing"), (text) => this.begin({file: "linkage.cuik", text}));
    element("sets").addEventListener("change", ({target}) => {
      if (target.matches(".toggle")) this.chooseSet(target.value, target.checked);
      if (target.matches(".fine")) this.design.change("fine", {fine: target.checked});
      if (target.matches(".by-aspect")) this.design.change("aspects", {aspects: target.checked});
    });
    addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey)) return;
      const key = event.key.toLowerCase();
      if (key === "s") this.save();
      else if (key === "z" && event.shiftKey) this.design.redo();
      else if (key === "z") this.design.undo();
      else if (key === "y") this.design.redo();
      else return;
      event.preventDefault();
    });
    followTheme(() => {
      this.redraw();
      this.panel?.picture.redraw();
    });
  }

  save() {
    download(this.design.now.file, this.editor.text);
  }

  command() {
    return this.design.command("report", this.sets(), this.usual);
  }

  async copyCommand() {
    const command = this.command();
    this.copied = command;
    try {
      await navigator.clipboard.writeText(command);
      element("status").textContent = `copied: ${command}`;
    } catch {
      element("status").textContent = command;
    }
  }

  async take(files) {
    try {
      this.begin(await modelOfFiles(files));
    } catch (error) {
      this.editor.showError({message: error.message, line: 0});
    }
  }

  begin(start) {
    this.samples = null;
    if (this.bench) this.bench.x = null;
    this.design.begin(start);
  }

  openGallery() {
    const root = document.querySelector("#gallery .templates");
    root.replaceChildren(
      ...this.templates.map((template) => {
        const {name, words} = titleOf(template),
          button = document.createElement("button");
        button.type = "button";
        button.className = "template";
        button.innerHTML = `<b>${htmlText(name)}</b><span>${htmlText(words)}</span>`;
        button.addEventListener("click", () => {
          element("gallery").close();
          this.begin({file: `${template.name.replace(/^.*\//, "")}.cuik`, text: template.text});
        });
        return button;
      }),
    );
    element("gallery").showModal();
  }
}

const studio = new Studio();
window.corank = {studio};
document.documentElement.dataset.ready = String(Math.round(performance.now()));
