// How many boxes lie over each pixel, with fractions at the rims, so that boxes side by side show no seam.

// Adds the coverage of [a, b] over pixels of width 1 as differences at up to four places: out = [place, difference, …].
function edgeDifferences(a, b, size, out) {
  let n = 0;
  const edge = (at, sign) => {
    const pixel = Math.floor(at),
      rest = at - pixel;
    for (const [place, part] of [
      [pixel, 1 - rest],
      [pixel + 1, rest],
    ]) {
      if (place < size && part > 0) {
        out[n++] = Math.max(place, 0);
        out[n++] = sign * part;
      }
    }
  };
  edge(Math.max(a, 0), 1);
  edge(Math.max(b, 0), -1);
  return n;
}

// Row-major counts; `toX`, `toY` bring a projection to pixels (y down). Boxes for which `skip` is true do not count.
export function coverage(projection, width, height, toX, toY, skip) {
  const counts = new Float32Array(width * height);
  const xs = new Float64Array(8),
    ys = new Float64Array(8);
  for (let i = 0; i < projection.length; ++i) {
    if (skip(projection.owners[i])) continue;
    const left = toX(projection.x[2 * i]),
      right = toX(projection.x[2 * i + 1]);
    const top = toY(projection.y[2 * i + 1]),
      bottom = toY(projection.y[2 * i]);
    if (right <= 0 || left >= width || bottom <= 0 || top >= height) continue;
    const nx = edgeDifferences(left, right, width, xs),
      ny = edgeDifferences(top, bottom, height, ys);
    for (let v = 0; v < ny; v += 2) {
      for (let u = 0; u < nx; u += 2) counts[ys[v] * width + xs[u]] += ys[v + 1] * xs[u + 1];
    }
  }
  for (let row = 0; row < height; ++row) {
    for (let x = 1; x < width; ++x) counts[row * width + x] += counts[row * width + x - 1];
  }
  for (let row = 1; row < height; ++row) {
    for (let x = 0; x < width; ++x) counts[row * width + x] += counts[(row - 1) * width + x];
  }
  return counts;
}

// How strong the colour of C-space is where `count` boxes lie: translucent under one, stronger under more.
export const sheetTone = (count) => Math.min(0.62, 0.17 * Math.min(1, count) + 0.06 * Math.log2(Math.max(1, count)));

// Paints counts in one colour, `tone(count)` strong.
export function paintCoverage(context, counts, width, height, colour, tone) {
  const image = context.createImageData(width, height);
  for (let i = 0; i < counts.length; ++i) {
    if (counts[i] >= 1e-3) image.data[4 * i + 3] = 255 * tone(counts[i]);
  }
  context.putImageData(image, 0, 0);
  context.globalCompositeOperation = "source-in";
  context.fillStyle = colour;
  context.fillRect(0, 0, width, height);
}

// Paints sheets {colour, counts} over one another: the mean of the colours over a pixel, the stronger the more boxes lie there.
export function paintMixture(context, sheets, width, height) {
  const image = context.createImageData(width, height),
    colours = sheets.map(({colour}) => rgbOf(context, colour));
  for (let i = 0; i < width * height; ++i) {
    let total = 0,
      red = 0,
      green = 0,
      blue = 0;
    sheets.forEach(({counts}, k) => {
      const count = counts[i];
      if (count < 1e-3) return;
      // Of two sheets of one aspect the second adds no colour.
      const weight = Math.min(1, count);
      total += weight;
      red += weight * colours[k][0];
      green += weight * colours[k][1];
      blue += weight * colours[k][2];
    });
    if (total > 0) image.data.set([red / total, green / total, blue / total, 255 * Math.min(0.75, 0.55 * total)], 4 * i);
  }
  context.putImageData(image, 0, 0);
}

// A colour of CSS as the numbers of a pixel.
function rgbOf(context, colour) {
  context.fillStyle = colour;
  context.fillRect(0, 0, 1, 1);
  const [...pixel] = context.getImageData(0, 0, 1, 1).data;
  context.clearRect(0, 0, 1, 1);
  return pixel;
}
