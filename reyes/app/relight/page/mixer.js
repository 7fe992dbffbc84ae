// The picture: layers of half floats, each with a weight, mixed by what is fastest in the browser. Layer 0 is the whole
// picture. Where it is fresh, it is shown instead of the sum of the others. The last layer is a variable, shown alone.
import { halves } from "./color.js";
import { Painter } from "./painter.js";
import { PlainPainter } from "./plain_painter.js";

export class Mixer {
  /** layers: the number of layers, with layer 0 and without the variable. way: "plain" or "webgl"; without it the faster one. */
  constructor(canvas, width, height, layers, way) {
    Object.assign(this, { width, height, variable: layers, hasFresh: false });
    canvas.width = width;
    canvas.height = height;
    this.halves = new Array(layers + 1).fill(null);
    /** The received parts of each layer, by their places. */
    this.parts = this.halves.map(() => new Map());
    this.isFresh = new Uint8Array(width * height);
    this.painter = (way === "plain" ? null : Painter.on(canvas, layers + 1, way === "webgl")) ?? new PlainPainter(canvas, this);
  }
  get isPlain() { return this.painter instanceof PlainPainter; }

  put(block) {
    const { layer, x, y, width, height, step, version } = block;
    const to = (this.halves[layer] ??= new Uint16Array(3 * this.width * this.height));
    const half = step === 1 ? block.half : spread(block);
    this.painter.put({ layer, x, y, width, height, half });
    for (let row = 0; row < height; ++row)
      to.set(half.subarray(3 * width * row, 3 * width * (row + 1)), 3 * ((y + row) * this.width + x));
    if (width === this.width && height === this.height) this.parts[layer].clear();
    this.parts[layer].set(`${x},${y}`, { x, y, width, height, step, version, time: performance.now() });
  }
  /** Sets whether layer 0 is the whole picture in a rectangle, in place of the sum of the layers. */
  fresh(x, y, width, height, value) {
    if (!value && !this.hasFresh) return;
    this.hasFresh = value || width < this.width || height < this.height;
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
  /** The least and the greatest of every seventh number of the variable. Infinite numbers stand for no surface and do not count. */
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
  const out = new Uint16Array(3 * width * height), columns = Math.ceil(width / step), row = 3 * width;
  for (let y = 0, square = 0; y < height; y += step, square += 3 * columns) {
    const begin = y * row;
    for (let x = 0, to = begin; x < width; ++x, to += 3) {
      const from = square + 3 * Math.floor(x / step);
      out[to] = half[from];
      out[to + 1] = half[from + 1];
      out[to + 2] = half[from + 2];
    }
    for (let same = y + 1; same < Math.min(y + step, height); ++same) out.copyWithin(same * row, begin, begin + row);
  }
  return out;
};
