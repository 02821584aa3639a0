// The plane of two coordinates in pixels, and its axes.
import {isAngle, unitOf, withMinus} from "./values.js";

const roomForNumbers = {left: 56, right: 12, top: 12, bottom: 40};

// From the units of two axes to pixels of a picture with a given width. Two lengths have one scale, and so have two angles; the plane is
// centred in the picture and goes on where there is room. `pad`: about the plane; too little of it for numbers means none.
export class Plane {
  constructor(axes, [[x0, x1], [y0, y1]], width, pad = roomForNumbers) {
    const inner = width - pad.left - pad.right;
    const alike = isAngle(axes[0]) === isAngle(axes[1]);
    const wanted = alike ? (inner * (y1 - y0)) / (x1 - x0) : inner;
    const height = Math.min(Math.max(wanted, 0.55 * inner), 1.2 * inner);
    let sx = inner / (x1 - x0);
    let sy = height / (y1 - y0);
    if (alike) sx = sy = Math.min(sx, sy);
    const extraX = (inner / sx - (x1 - x0)) / 2;
    const extraY = (height / sy - (y1 - y0)) / 2;
    Object.assign(this, {
      x0: x0 - extraX,
      x1: x1 + extraX,
      y0: y0 - extraY,
      y1: y1 + extraY,
      sx,
      sy,
      pad,
      inner,
      height,
      width,
    });
    this.fullHeight = height + pad.top + pad.bottom;
  }

  toX(x) {
    return this.pad.left + (x - this.x0) * this.sx;
  }
  toY(y) {
    return this.pad.top + (this.y1 - y) * this.sy;
  }
  fromPixels(px, py) {
    return [this.x0 + (px - this.pad.left) / this.sx, this.y1 - (py - this.pad.top) / this.sy];
  }
  holds([x, y]) {
    return x >= this.x0 && x <= this.x1 && y >= this.y0 && y <= this.y1;
  }
}

// Decoration of the plane: distances at which marks stand, and their texts.
function ticks(low, high, angle, most) {
  const marks = [];
  if (angle && high - low > 3) {
    const names = {"-2": "−π", "-1": "−π/2", 0: "0", 1: "π/2", 2: "π"};
    for (const [k, text] of Object.entries(names)) marks.push({at: (k * Math.PI) / 2, text});
    return marks.filter(({at}) => at >= low - 1e-9 && at <= high + 1e-9);
  }
  const rough = (high - low) / most,
    power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= rough * 0.999);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
    marks.push({at: k * step, text: withMinus((k * step).toFixed(digits))});
  }
  return marks;
}

// Paints the paper, grid lines, numbers and the names of the axes.
export function drawAxes(context, model, axes, plane, colours) {
  const {pad, inner, height, x0, x1, y0, y1} = plane;
  const numbered = pad.left >= roomForNumbers.left;
  context.fillStyle = colours.paper;
  context.fillRect(pad.left, pad.top, inner, height);
  context.strokeStyle = colours.faint;
  context.lineWidth = 1;
  context.fillStyle = colours.quiet;
  context.font = "12px system-ui, sans-serif";
  const line = (ax, ay, bx, by) => {
    context.beginPath();
    context.moveTo(Math.round(ax) + 0.5, Math.round(ay) + 0.5);
    context.lineTo(Math.round(bx) + 0.5, Math.round(by) + 0.5);
    context.stroke();
  };
  context.textAlign = "center";
  context.textBaseline = "top";
  for (const {at, text} of ticks(x0, x1, isAngle(axes[0]), Math.max(3, inner / 80))) {
    line(plane.toX(at), pad.top, plane.toX(at), pad.top + height);
    if (numbered) context.fillText(text, plane.toX(at), pad.top + height + 6);
  }
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const {at, text} of ticks(y0, y1, isAngle(axes[1]), Math.max(3, height / 60))) {
    line(pad.left, plane.toY(at), pad.left + inner, plane.toY(at));
    if (numbered) context.fillText(text, pad.left - 6, plane.toY(at));
  }
  if (!numbered) return;
  drawAxisName(context, model, colours, axes[0], pad.left + inner / 2, pad.top + height + 30, 0);
  drawAxisName(context, model, colours, axes[1], 10, pad.top + height / 2, -Math.PI / 2);
}

function drawAxisName(context, model, colours, axis, x, y, turn) {
  const unit = unitOf(model, axis),
    [base, subscript] = axis.label;
  context.save();
  context.translate(x, y);
  context.rotate(turn);
  context.fillStyle = colours.ink;
  context.textAlign = "left";
  context.textBaseline = "alphabetic";
  const pieces = [
    [base, "italic 15px Georgia, 'Times New Roman', serif", 4],
    [subscript, "11px Georgia, 'Times New Roman', serif", 8],
    [unit ? ` (${unit})` : "", "12px system-ui, sans-serif", 4],
  ];
  let width = 0;
  for (const [text, font] of pieces) {
    context.font = font;
    width += context.measureText(text).width;
  }
  let at = -width / 2;
  for (const [text, font, down] of pieces) {
    context.font = font;
    context.fillText(text, at, down);
    at += context.measureText(text).width;
  }
  context.restore();
}
