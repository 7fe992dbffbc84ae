// Paints the mixer's picture by JavaScript, for browsers without a GPU for WebGL2. It keeps the weighted sum of the layers,
// and sums and paints no more of the picture than has changed.
import { halves, kOpaque, lookOf, tableOf } from "./color.js";

const union = (a, b) => {
  if (!a) return b;
  const x = Math.min(a.x, b.x), y = Math.min(a.y, b.y);
  return { x, y, width: Math.max(a.x + a.width, b.x + b.width) - x, height: Math.max(a.y + a.height, b.y + b.height) - y };
};

export class PlainPainter {
  constructor(canvas, mixer) {
    this.mixer = mixer;
    this.context = canvas.getContext("2d");
    this.image = this.context.createImageData(canvas.width, canvas.height);
    this.pixels = new Uint32Array(this.image.data.buffer);
    this.sum = new Float32Array(3 * canvas.width * canvas.height);
    this.weights = null;  // of the sum; null: it is to be summed anew
    this.view = "";       // of what is on the canvas
    /** The rectangle that is to be painted again. */
    this.changed = { x: 0, y: 0, width: canvas.width, height: canvas.height };
  }

  /** The block takes the place of what the layer has there, which the mixer still holds. */
  put({ layer, x, y, width, height, half }) {
    this.changed = union(this.changed, { x, y, width, height });
    const weight = this.weights?.[layer];
    if (layer === 0 || !weight) return;
    const { sum } = this, before = this.mixer.halves[layer], [r, g, b] = weight;
    for (let row = 0, from = 0; row < height; ++row) {
      const begin = 3 * ((y + row) * this.mixer.width + x), end = begin + 3 * width;
      for (let i = begin; i < end; i += 3, from += 3) {
        sum[i] += r * (halves[half[from]] - halves[before[i]]);
        sum[i + 1] += g * (halves[half[from + 1]] - halves[before[i + 1]]);
        sum[i + 2] += b * (halves[half[from + 2]] - halves[before[i + 2]]);
      }
    }
  }
  fresh(x, y, width, height) { this.changed = union(this.changed, { x, y, width, height }); }
  /** Sums anew, without the rounding of changes. */
  settle() { this.weights = null; }

  paint(weights, view) {
    const name = JSON.stringify(view);
    if (name !== this.view) {
      this.view = name;
      this.table = tableOf(view);
      this.changeAll();
    }
    if (!view.range) this.mix(weights);
    if (!this.changed) return;
    const { x, y, width, height } = this.changed;
    for (let row = y; row < y + height; ++row) {
      const begin = row * this.mixer.width + x;
      if (view.range || view.falseColor) this.paintSlowly(view, begin, begin + width);
      else this.paintSum(view, begin, begin + width);
    }
    this.context.putImageData(this.image, 0, 0, x, y, width, height);
    this.changed = null;
  }
  changeAll() { this.changed = { x: 0, y: 0, width: this.image.width, height: this.image.height }; }

  /** Brings the sum to these weights. */
  mix(weights) {
    const before = this.weights ?? weights.map(() => [0, 0, 0]);
    if (!this.weights) this.sum.fill(0);
    let changes = !this.weights;
    weights.forEach((w, i) => {
      const half = this.mixer.halves[i], more = w.map((v, c) => v - before[i][c]);
      if (i === 0 || !half || more.every((v) => v === 0)) return;
      this.add(half, more);
      changes = true;
    });
    this.weights = weights;
    if (changes) this.changeAll();
  }
  add(half, [r, g, b]) {
    const { sum } = this;
    for (let i = 0; i < sum.length; i += 3) {
      sum[i] += r * halves[half[i]];
      sum[i + 1] += g * halves[half[i + 1]];
      sum[i + 2] += b * halves[half[i + 2]];
    }
  }

  paintSum({ exposure, wholeExposure }, begin, end) {
    const { pixels, sum } = this, { isFresh } = this.mixer, whole = this.mixer.halves[0];
    const { bytes, perUnit } = this.table, most = bytes.length - 1, e = exposure * perUnit, w = wholeExposure * perUnit;
    const at = (v) => bytes[v > 0 ? (v < most ? (v + 0.5) | 0 : most) : 0];
    for (let p = begin, i = 3 * begin; p < end; ++p, i += 3)
      pixels[p] = isFresh[p]
        ? kOpaque | (at(w * halves[whole[i + 2]]) << 16) | (at(w * halves[whole[i + 1]]) << 8) | at(w * halves[whole[i]])
        : kOpaque | (at(e * sum[i + 2]) << 16) | (at(e * sum[i + 1]) << 8) | at(e * sum[i]);
  }
  /** Numbers of a variable, and false colours. */
  paintSlowly(view, begin, end) {
    const { pixels, sum } = this, { isFresh } = this.mixer, look = lookOf(view);
    const { exposure, wholeExposure } = view, shown = this.mixer.halves[view.range ? this.mixer.variable : 0];
    for (let p = begin, i = 3 * begin; p < end; ++p, i += 3) {
      if (view.range) pixels[p] = shown ? look(halves[shown[i]], halves[shown[i + 1]], halves[shown[i + 2]]) : kOpaque;
      else if (isFresh[p]) pixels[p] = look(...[0, 1, 2].map((c) => wholeExposure * halves[shown[i + c]]));
      else pixels[p] = look(exposure * sum[i], exposure * sum[i + 1], exposure * sum[i + 2]);
    }
  }
}
