// The picture: layers of half floats, each with a weight, mixed where the browser can do it fastest. Layer 0 is the whole
// picture; where it is fresh, it is shown instead of the sum of the others. The last one is a variable, shown alone.
import { halves, shade } from "./color.js";
import { Painter } from "./painter.js";

/** The same without WebGL2. Only what changes is taken off the sum and added to it. */
class PlainPainter {
  constructor(canvas, mixer) {
    this.mixer = mixer;
    this.context = canvas.getContext("2d");
    this.image = this.context.createImageData(canvas.width, canvas.height);
    this.image.data.fill(255);
    this.sum = new Float32Array(3 * canvas.width * canvas.height);
  }
  /** Before a block takes the place of what the layer has there, and after. */
  leave(block) { this.change(block, -1); }
  put(block) { this.change(block, 1); }
  change({ layer, x, y, width, height }, sign) {
    const weight = this.weights?.[layer], half = this.mixer.halves[layer];
    if (layer === 0 || !weight || !half) return;
    for (let row = y; row < y + height; ++row) {
      const begin = 3 * (row * this.mixer.width + x);
      this.add(half, weight.map((w) => sign * w), begin, begin + 3 * width);
    }
  }
  /** Sums anew, without the rounding of changes. */
  settle() { this.weights = null; }
  fresh() {}
  add(half, [r, g, b], begin, end) {
    const { sum } = this;
    for (let i = begin; i < end; i += 3) {
      sum[i] += r * halves[half[i]];
      sum[i + 1] += g * halves[half[i + 1]];
      sum[i + 2] += b * halves[half[i + 2]];
    }
  }
  mix(weights) {
    if (!this.weights) this.sum.fill(0);
    const before = this.weights ?? weights.map(() => [0, 0, 0]);
    weights.forEach((w, i) => {
      const half = this.mixer.halves[i], more = w.map((v, c) => v - before[i][c]);
      if (i > 0 && half && more.some((v) => v !== 0)) this.add(half, more, 0, this.sum.length);
    });
    this.weights = weights;
  }
  paint(weights, view) {
    const { mixer, sum } = this, { isFresh } = mixer, to = this.image.data, look = shade(view), whole = mixer.halves[0];
    if (view.range) {
      const half = mixer.halves[mixer.variable];
      for (let i = 0, at = 0; half && i < half.length; i += 3, at += 4) look(halves[half[i]], halves[half[i + 1]], halves[half[i + 2]], to, at);
    } else {
      this.mix(weights);
      const e = view.exposure, w = view.wholeExposure;
      for (let p = 0, i = 0; p < isFresh.length; ++p, i += 3) {
        if (isFresh[p]) look(w * halves[whole[i]], w * halves[whole[i + 1]], w * halves[whole[i + 2]], to, 4 * p);
        else look(e * sum[i], e * sum[i + 1], e * sum[i + 2], to, 4 * p);
      }
    }
    this.context.putImageData(this.image, 0, 0);
  }
}

export class Mixer {
  /** layers: the number of those that are mixed and of layer 0. way: "plain" or "webgl"; without it the faster one. */
  constructor(canvas, width, height, layers, way) {
    Object.assign(this, { width, height, variable: layers });
    canvas.width = width;
    canvas.height = height;
    this.halves = new Array(layers + 1).fill(null);
    /** What is known of each layer: the parts that have come, by their place. */
    this.parts = this.halves.map(() => new Map());
    this.isFresh = new Uint8Array(width * height);
    this.painter = (way === "plain" ? null : Painter.on(canvas, layers + 1, way === "webgl")) ?? new PlainPainter(canvas, this);
  }
  get isPlain() { return this.painter instanceof PlainPainter; }

  put(block) {
    const { layer, x, y, width, height, step, version } = block;
    this.painter.leave(block);
    const to = (this.halves[layer] ??= new Uint16Array(3 * this.width * this.height));
    const half = step === 1 ? block.half : spread(block);
    for (let row = 0; row < height; ++row)
      to.set(half.subarray(3 * width * row, 3 * width * (row + 1)), 3 * ((y + row) * this.width + x));
    if (width === this.width && height === this.height) this.parts[layer].clear();
    this.parts[layer].set(`${x},${y}`, { x, y, width, height, step, version, time: performance.now() });
    this.painter.put({ layer, x, y, width, height, half });
  }
  /** Says whether layer 0 is the picture there. */
  fresh(x, y, width, height, value) {
    for (let row = y; row < y + height; ++row) this.isFresh.fill(value ? 1 : 0, row * this.width + x, row * this.width + x + width);
    this.painter.fresh(x, y, width, height, value);
  }
  settle() { this.painter.settle(); }
  paint(weights, view) { this.painter.paint(weights, view); }

  colorAt(layer, x, y) {
    const half = this.halves[layer], p = 3 * (y * this.width + x);
    return half ? [0, 1, 2].map((c) => halves[half[p + c]]) : [0, 0, 0];
  }
  /** What each layer brings to a pixel, and whether layer 0 is shown there. */
  at(x, y, weights) {
    const shares = weights.map((w, i) => this.colorAt(i, x, y).map((v, c) => v * w[c]));
    return { shares, isWhole: this.isFresh[y * this.width + x] === 1 };
  }
  /** The least and the greatest number of the variable, but for those that stand for nothing. */
  rangeOfVariable() {
    const half = this.halves[this.variable];
    let least = Infinity, most = -Infinity;
    for (let i = 0; half && i < half.length; i += 7) {
      const v = halves[half[i]];
      if (Math.abs(v) >= 65504) continue;
      least = Math.min(least, v);
      most = Math.max(most, v);
    }
    return least < most ? [least, most] : [0, 1];
  }
}

/** The pixels of a block whose squares have one colour each. */
const spread = ({ width, height, step, half }) => {
  const out = new Uint16Array(3 * width * height), columns = Math.ceil(width / step);
  for (let y = 0, to = 0; y < height; ++y) {
    const row = columns * Math.floor(y / step);
    for (let x = 0; x < width; ++x, to += 3) {
      const from = 3 * (row + Math.floor(x / step));
      out[to] = half[from];
      out[to + 1] = half[from + 1];
      out[to + 2] = half[from + 2];
    }
  }
  return out;
};
