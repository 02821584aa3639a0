// Puts the studio together: what is typed and slid goes to the server, what comes back goes into the pictures.
import {liveSet} from "./data.js";
import {Editor} from "./studio_editor.js";
import {download, listenToDrops, modelOfFiles, shared, titleOf} from "./studio_files.js";
import {Link} from "./studio_link.js";
import {LinkageBoard} from "./studio_linkage.js";
import {setsLegend} from "./studio_sets.js";
import {Sights, element} from "./studio_sights.js";
import {Sliders} from "./studio_sliders.js";
import {Design} from "./studio_state.js";
import {followTheme, takeTheme} from "./theme.js";
import {groupedText, htmlText} from "./values.js";

class Studio {
  constructor() {
    takeTheme();
    const start = JSON.parse(element("start").textContent);
    this.templates = start.templates;
    this.model = null; // what the pictures show; null: nothing yet
    this.sights = new Sights();
    this.usual = [];
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
    if (kind === "all") {
      this.editor.text = text;
      element("require").value = this.design.now.require.join("; ");
    }
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
    // With requirements there is a set more.
    const {want, sets} = this.asked.request;
    if (want === "picture" && this.sets().join() !== sets.join()) this.link.ask(this.design.request("picture", this.sets()));
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
    const making = this.asked.request.want === "report" ? "making the report: " : "";
    element("status").textContent =
      `${making}${pass === 0 ? "looking at" : "refining"} ${this.titleOf(set)}: ${groupedText(boxes)} boxes`;
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
    this.sights.draw(this.model);
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

  on_colours({colours, summary}) {
    this.sights.showColours(colours, summary.split("\n")[0]);
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
    if (state === "lost")
      banner.textContent =
        "The studio’s server does not answer: it has ended, or shows too many windows. Your model is still here: Save keeps it.";
    if (state === "ended")
      banner.textContent =
        "Another run of corank studio answers here. Open the address that it prints; your model is still here: Save keeps it.";
  }

  // --- sets

  titleOf(name) {
    return this.available?.find((set) => set.name === name)?.title ?? name;
  }

  showSets() {
    const root = element("sets"),
      chosen = this.sets();
    const shown = new Map((this.model?.sets ?? []).map((set) => [set.name, set]));
    const open = root.querySelector("details")?.open;
    const html = setsLegend({...this, chosen, shown, open, design: this.design.now});
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
    element("require").addEventListener("change", ({target}) => {
      const require = target.value.split(";").map((line) => line.trim());
      this.design.change("require", {require: require.filter(Boolean)});
    });
    element("sets").addEventListener("change", ({target}) => {
      if (target.matches(".toggle")) this.chooseSet(target.value, target.checked);
      if (target.matches(".fine")) this.design.change("fine", {fine: target.checked});
      if (target.matches(".colours")) this.design.change("colours", {colours: target.value});
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
      this.sights.redraw();
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
    this.sights.forget();
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
