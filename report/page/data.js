// What the page carries, decoded: the model, and for each set its boxes as outward-rounded floats. What a set is, it says itself:
// {name, title, singular, locked: whose rates are 0, layer: higher is drawn over lower, dot: radius of a point …}.

export function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

const PASSAGES = ["unproven", "barrier", "traversable"];

function floatsOf(bytes) {
  const aligned = bytes.byteOffset % 4 === 0 ? bytes : bytes.slice();
  return new Float32Array(aligned.buffer, aligned.byteOffset, bytes.length / 4);
}

// The boxes of a set: bounds[2 * (size * i + j)] and the number behind it enclose variable j in box i.
export class BoxSet {
  constructor(description, bounds, verdicts) {
    Object.assign(this, description);
    this.size = description.variables.length;
    this.bounds = bounds;
    this.verdicts = verdicts;
    this.types = bytesOfBase64(description.types || "");
    this.parts = description.conditions && bytesOfBase64(description.conditions.of);
    if (description.passage) {
      this.passages = bytesOfBase64(description.passage.of);
      this.sides = floatsOf(bytesOfBase64(description.passage.sides));
    }
  }
  // Those of the set, and of the part that the box is of.
  equationsOf(box) {
    const own = this.parts ? this.conditions.equations[this.parts[box]] : [];
    return own?.length ? [...this.equations, ...own] : this.equations;
  }
  // Of a workspace boundary: "unproven", "barrier" or "traversable"; of another set undefined.
  passageOf(box) {
    return this.passages && PASSAGES[this.passages[box]];
  }
  // From a barrier to where the output is kept, in the units of two outputs; null where that is not known of these axes, or points out
  // of their plane: what is seen then is no outline.
  sideOf(box, axes) {
    if (this.passageOf(box) !== "barrier") return null;
    const {outputs} = this.passage;
    const places = axes.map(({name}) => outputs.indexOf(name));
    const side = places.map((j) => (j < 0 ? NaN : this.sides[outputs.length * box + j]));
    const all = this.sides.subarray(outputs.length * box, outputs.length * (box + 1));
    return Math.hypot(...side) > 0.95 * Math.hypot(...all) ? side : null;
  }
  // The types of singularity that are proven of a box.
  typesOf(box) {
    return ["RO", "RPM", "II", "RI", "IO", "IIM"].filter((_, k) => (this.types[box] >> k) & 1);
  }
  lower(box, variable) {
    return this.bounds[2 * (this.size * box + variable)];
  }
  upper(box, variable) {
    return this.bounds[2 * (this.size * box + variable) + 1];
  }
  middle(box, variable) {
    const at = 2 * (this.size * box + variable);
    return 0.5 * (this.bounds[at] + this.bounds[at + 1]);
  }
  // Do two boxes have a configuration in common?
  touch(a, b) {
    for (let j = 0; j < this.configuration; ++j) {
      if (this.lower(a, j) > this.upper(b, j) || this.lower(b, j) > this.upper(a, j)) return false;
    }
    return true;
  }
}

// `id`: of the elements boxes-ID and verdicts-ID.
export function readSet(description, id) {
  const bytesOf = (what) => bytesOfBase64(document.getElementById(`${what}-${id}`).textContent.trim());
  return new BoxSet(description, floatsOf(bytesOf("boxes")), bytesOf("verdicts"));
}

// Of a description that holds its boxes.
export function liveSet({boxes, verdicts, ...description}) {
  return new BoxSet(description, floatsOf(bytesOfBase64(boxes)), bytesOfBase64(verdicts));
}

export function readModel() {
  const model = JSON.parse(document.getElementById("model").textContent);
  model.sets = model.sets.map((description) => readSet(description, description.name));
  return model;
}
