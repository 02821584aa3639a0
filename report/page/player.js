// Moves the mechanism along the curve on which the panel's configuration lies: a set of dimension 1 or a self-motion.
import {Curve} from "./curve.js";
import {Playback} from "./playback.js";

export class Player extends Playback {
  constructor(panel, root) {
    super(panel, root);
    this.panel = panel;
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

  // Finds the curve and the place on it.
  locate() {
    const now = this.panel.current;
    if (this.root.hidden || !now) return false;
    if (!this.curve) {
      this.curve = new Curve(now.set, this.boxesOf(now.set, now.box), now.box);
      this.t = this.curve.locate(now.x);
      this.showPlace();
    }
    this.root.hidden = !super.locate();
    return !this.root.hidden;
  }

  taken() {
    this.panel.pinned = true;
  }
}
