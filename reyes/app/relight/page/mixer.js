// The picture: layers of half floats, each with a weight, mixed where the browser can do it fastest. Layer 0 is the whole
// picture; where it is fresh, it is shown instead of the sum of the others. The last one is a variable, shown alone.
import { halves, shade } from "./color.js";
import { Painter } from "./painter.js";

/** The same without WebGL2. */
class PlainPainter {
  constructor(canvas, mixer) {
    this.mixer = mixer;
    this.context = canvas.getContext("2d");
    this.image = this.context.createImageData(canvas.width, canvas.height);
    this.image.data.fill(255);
  }
  put() {}
  fresh() {}
  paint(weights, view) {
    const { mixer } = this, to = this.image.data, count = mixer.width * mixer.height, last = mixer.halves.length - 1;
    const used = mixer.halves.map((half, i) => ({ half, w: weights[i] })).slice(1, last).filter(({ half }) => half);
    const look = shade(view), sum = [0, 0, 0], variable = view.range ? mixer.halves[last] : null;
    for (let p = 0; p < count; ++p) {
      for (let c = 0; c < 3; ++c) {
        const at = 3 * p + c;
        if (view.range) sum[c] = variable ? halves[variable[at]] : 0;
        else if (mixer.isFresh[p]) sum[c] = halves[mixer.halves[0][at]] * view.wholeExposure;
        else {
          sum[c] = 0;
          for (const { half, w } of used) sum[c] += w[c] * halves[half[at]];
          sum[c] *= view.exposure;
        }
      }
      look(sum, to, 4 * p);
    }
    this.context.putImageData(this.image, 0, 0);
  }
}

export class Mixer {
  /** layers: the number of those that are mixed and of layer 0. plain: WebGL2 is not asked for. */
  constructor(canvas, width, height, layers, plain) {
    Object.assign(this, { width, height, variable: layers });
    canvas.width = width;
    canvas.height = height;
    this.halves = new Array(layers + 1).fill(null);
    /** What is known of each layer: the parts that have come, by their place. */
    this.parts = this.halves.map(() => new Map());
    this.isFresh = new Uint8Array(width * height);
    this.painter = (plain ? null : Painter.on(canvas, layers + 1)) ?? new PlainPainter(canvas, this);
  }
  get isPlain() { return this.painter instanceof PlainPainter; }

  put(block) {
    const { layer, x, y, width, height, step, version } = block;
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
