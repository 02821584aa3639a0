// What a user has made: the model's text, values of its constants, the sets to be seen; and its history.

const together = 700; // ms within which changes of one kind are one step

export class Design {
  // `start`: {file, text, loops, constants}. `onChange(kind)`: "text", "constants", "sets", "all".
  constructor(start, onChange) {
    this.onChange = onChange;
    this.now = Design.from(start);
    this.before = [];
    this.after = [];
    this.kind = null;
  }

  static from({
    file = "model.cuik",
    text = "",
    loops = "",
    constants = {},
    sets = null,
    ranges = {},
    colours = "",
    require = [],
    fine = true,
  }) {
    return {
      file,
      text,
      loops,
      constants: {...constants},
      sets: sets && [...sets],
      ranges: {...ranges},
      colours,
      require: [...require],
      fine,
    };
  }

  change(kind, values) {
    const time = performance.now();
    if (kind !== this.kind || time > this.time + together) this.before.push(this.now);
    if (this.before.length > 500) this.before.shift();
    [this.kind, this.time] = [kind, time];
    this.after = [];
    this.now = {...this.now, ...values};
    this.onChange(kind);
  }

  // Another model altogether.
  begin(start) {
    this.kind = null;
    this.change("all", Design.from(start));
    this.kind = null;
  }

  go(from, to) {
    if (from.length === 0) return;
    to.push(this.now);
    this.now = from.pop();
    this.kind = null;
    this.onChange("all");
  }
  undo() {
    this.go(this.before, this.after);
  }
  redo() {
    this.go(this.after, this.before);
  }

  // What the server is asked for.
  request(want, sets) {
    const {file, text, loops, constants, colours, require, fine} = this.now;
    return {want, file, text, ...(loops ? {loops} : {}), constants, sets, colours, require, fine};
  }

  // The command line that computes the same from the file.
  command(subcommand, sets, usual) {
    const {file, loops, constants, require} = this.now;
    const quoted = (word) => (/^[\w./=:+-]+$/.test(word) ? word : `'${word.replace(/'/g, `'\\''`)}'`);
    const words = ["corank", subcommand, quoted(file)];
    if (loops) words.push("--loops", quoted(`${file.replace(/\.urdf$/, "")}.loops`));
    if (sets && sets.join() !== usual.join()) words.push("--sets", sets.join());
    for (const text of require) words.push("--require", quoted(text));
    for (const [name, value] of Object.entries(constants)) words.push("-D", quoted(`${name}=${value}`));
    return words.join(" ");
  }
}
