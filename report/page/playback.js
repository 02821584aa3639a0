// Moves a mechanism along a curve of configurations: a button, a slider and, where the page has one, a choice of the speed.

const secondsOf = (length) => Math.min(14, Math.max(3, 2.5 * length));

// `curve` has length, closed, at(t) for t from 0 to its length. `view` has text, an element, and show(configuration).
export class Playback {
  constructor(view, root) {
    this.view = view;
    this.root = root;
    this.t = 0;
    this.direction = 1;
    this.button = root.querySelector(".play");
    this.slider = root.querySelector("input");
    this.speed = root.querySelector("select.speed");
    this.button.addEventListener("click", () => (this.playing ? this.stop() : this.play()));
    this.slider.addEventListener("input", () => this.scrub());
    // Who asks for less motion moves the slider.
    const calm = matchMedia("(prefers-reduced-motion: reduce)");
    const follow = () => {
      this.button.hidden = calm.matches;
      if (this.speed) this.speed.hidden = calm.matches;
      if (calm.matches) this.stop();
    };
    calm.addEventListener("change", follow);
    this.label();
    follow();
  }

  // Is there a curve that moves?
  locate() {
    return Boolean(this.curve) && this.curve.length > 1e-6;
  }

  // Is told when the user moves the mechanism.
  taken() {}

  showPlace() {
    const {length} = this.curve;
    this.slider.value = length > 0 ? (1000 * this.t) / length : 0;
    this.slider.setAttribute("aria-valuetext", `${Math.round(this.slider.value / 10)} % of the way`);
  }

  scrub() {
    const value = Number(this.slider.value);
    this.stop();
    if (!this.locate()) return;
    this.taken();
    this.t = (value / 1000) * this.curve.length;
    this.slider.value = value;
    this.view.show(this.curve.at(this.t));
  }

  // Goes to a place.
  seek(t) {
    this.stop();
    this.t = Math.min(this.curve.length, Math.max(0, t));
    this.showPlace();
    this.view.show(this.curve.at(this.t));
  }

  play() {
    if (!this.locate()) return;
    this.taken();
    this.playing = true;
    this.view.text.setAttribute("aria-live", "off");
    this.label();
    let before = null;
    const frame = (now) => {
      if (!this.playing) return;
      this.advance(before === null ? 0 : this.stepOf((now - before) / 1000));
      before = now;
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  // How far the mechanism comes in so many seconds. A page that was hidden for a while goes on where it was.
  stepOf(seconds) {
    const {length} = this.curve;
    return (Math.min(0.1, seconds) / secondsOf(length)) * length * Number(this.speed?.value ?? 1);
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
    this.view.show(this.curve.at(this.t));
  }

  stop() {
    if (!this.playing) return;
    this.playing = false;
    this.view.text.setAttribute("aria-live", "polite");
    this.label();
  }

  label() {
    this.button.textContent = this.playing ? "❚❚" : "▶";
    const title = this.playing ? "Stop" : "Move along the curve";
    this.button.title = title;
    this.button.setAttribute("aria-label", title);
  }
}
