// Moves the mechanism along a curve of configurations, a set of dimension 1 or a self-motion: a button and a slider in the panel.
import {Curve} from "./curve.js";

const secondsOf = (length) => Math.min(14, Math.max(3, 2.5 * length));

export class Player {
  constructor(panel, root) {
    this.panel = panel;
    this.root = root;
    this.button = root.querySelector(".play");
    this.slider = root.querySelector("input");
    this.button.addEventListener("click", () => (this.playing ? this.stop() : this.play()));
    this.slider.addEventListener("input", () => this.scrub());
    // Who asks for less motion moves the slider.
    const calm = matchMedia("(prefers-reduced-motion: reduce)");
    const follow = () => {
      this.button.hidden = calm.matches;
      if (calm.matches) this.stop();
    };
    calm.addEventListener("change", follow);
    this.label();
    follow();
  }

  motionOf(set, box) {
    return set.motions.find(({boxes}) => boxes.includes(box));
  }

  isOnCurve(set, box) {
    return (this.motionOf(set, box) ?? set).dimension === 1;
  }

  // The boxes that the curve through a box goes through; those of a self-motion have one among themselves.
  boxesOf(set, box) {
    const motion = this.motionOf(set, box);
    if (motion) return motion.boxes;
    const others = new Set(set.motions.flatMap(({boxes}) => boxes)),
      pending = this.panel.model.verdicts.indexOf("pending");
    return Array.from({length: set.count}, (_, k) => k).filter((k) => set.verdicts[k] !== pending && !others.has(k));
  }

  // What is shown now may be played from; null: nothing is.
  offer(configuration) {
    this.curve = null;
    this.root.hidden = !configuration || !this.isOnCurve(configuration.set, configuration.box);
    this.slider.value = 0;
  }

  // Finds the curve and the place on it; is there one that moves?
  locate() {
    const now = this.panel.current;
    if (this.root.hidden || !now) return false;
    if (!this.curve) {
      this.curve = new Curve(now.set, this.boxesOf(now.set, now.box), now.box);
      this.t = this.curve.locate(now.x);
      this.showPlace();
    }
    if (!(this.curve.length > 1e-6)) this.root.hidden = true;
    return !this.root.hidden;
  }

  showPlace() {
    const {length} = this.curve;
    this.slider.value = length > 0 ? (1000 * this.t) / length : 0;
    this.slider.setAttribute("aria-valuetext", `${Math.round(this.slider.value / 10)} % of the way`);
  }

  scrub() {
    const value = Number(this.slider.value);
    this.stop();
    if (!this.locate()) return;
    this.panel.pinned = true;
    this.t = (value / 1000) * this.curve.length;
    this.slider.value = value;
    this.panel.show(this.curve.at(this.t));
  }

  play() {
    if (!this.locate()) return;
    this.panel.pinned = true;
    this.playing = true;
    this.direction ??= 1;
    this.panel.text.setAttribute("aria-live", "off");
    this.label();
    let before = null;
    const frame = (now) => {
      if (!this.playing) return;
      // A page that was hidden for a while goes on where it was.
      const share = before === null ? 0 : Math.min(0.1, (now - before) / 1000) / secondsOf(this.curve.length);
      before = now;
      this.advance(share * this.curve.length);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  // Round and round a closed curve, to and fro on one with ends.
  advance(by) {
    const {length, closed} = this.curve;
    this.t += this.direction * by;
    if (closed) this.t = (this.t + length) % length;
    else if (this.t > length || this.t < 0) {
      this.direction = -this.direction;
      this.t = Math.min(length, Math.max(0, this.t));
    }
    this.showPlace();
    this.panel.show(this.curve.at(this.t));
  }

  stop() {
    if (!this.playing) return;
    this.playing = false;
    this.panel.text.setAttribute("aria-live", "polite");
    this.label();
  }

  label() {
    this.button.textContent = this.playing ? "❚❚" : "▶";
    const title = this.playing ? "Stop" : "Move along the curve";
    this.button.title = title;
    this.button.setAttribute("aria-label", title);
  }
}
