// A path in a portrait: a line, and its two ends.
import {coordinateValue, fullTurn, isAngle} from "./values.js";

export class Trace {
  // `line`: configurations along the path, none where there is no path; `ends`: the two ends. Variables of C-space.
  constructor(line, ends) {
    Object.assign(this, {line, ends});
    this.points = [...line, ...ends];
  }

  // The line over two axes in the units of these, in stretches that no angle jumps in.
  stretches(axes) {
    const found = [[]];
    let last = null;
    for (const x of this.line) {
      const at = axes.map((axis) => coordinateValue(x, axis));
      const turn = at.map((value, k) =>
        last && isAngle(axes[k]) ? fullTurn * Math.round((value - last[k]) / fullTurn) : 0,
      );
      if (turn.some((by) => by !== 0)) {
        found[found.length - 1].push(at.map((value, k) => value - turn[k]));
        found.push([last.map((value, k) => value + turn[k])]);
      }
      found[found.length - 1].push(at);
      last = at;
    }
    return found;
  }

  draw(context, {plane, axes, colours}) {
    context.save();
    context.beginPath();
    context.rect(plane.pad.left, plane.pad.top, plane.inner, plane.height);
    context.clip();
    context.lineJoin = context.lineCap = "round";
    const stretches = this.stretches(axes);
    for (const [colour, width] of [
      [colours.paper, 6],
      [colours.way, 3],
    ]) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.beginPath();
      for (const stretch of stretches)
        stretch.forEach(([x, y], i) => context[i === 0 ? "moveTo" : "lineTo"](plane.toX(x), plane.toY(y)));
      context.stroke();
    }
    context.restore();
    this.ends.forEach((x, end) => {
      context.beginPath();
      context.arc(plane.toX(coordinateValue(x, axes[0])), plane.toY(coordinateValue(x, axes[1])), 5, 0, 7);
      context.fillStyle = end === 0 ? colours.paper : colours.way;
      context.fill();
      context.strokeStyle = colours.way;
      context.lineWidth = 2.5;
      context.stroke();
    });
  }

  // Which configuration of the line is seen nearest to a place, within so many pixels; −1: none.
  nearest([x, y], {plane, axes}, most) {
    let best = -1,
      least = most;
    this.line.forEach((point, i) => {
      const far = Math.hypot(
        plane.sx * (coordinateValue(point, axes[0]) - x),
        plane.sy * (coordinateValue(point, axes[1]) - y),
      );
      if (far < least) [best, least] = [i, far];
    });
    return best;
  }
}
