// How numbers of light become colours of a screen. painter.js says the same in GLSL.

/** Names of view transforms, in the order of their numbers. "soft" is equation 4 of Reinhard et al. 2002 for each channel,
    with white at 4. */
export const kTransforms = ["standard", "soft", "linear"];
export const kWhite = 4;
const kSrgbSteps = 4096;

/** The numbers that the 65536 half floats stand for. */
export const halves = (() => {
  const out = new Float32Array(65536);
  for (let h = 0; h < 65536; ++h) {
    const sign = h & 0x8000 ? -1 : 1, exponent = (h >> 10) & 31, mantissa = h & 1023;
    out[h] = sign * (exponent === 0 ? mantissa * 2 ** -24
      : exponent === 31 ? 65504 : (1 + mantissa / 1024) * 2 ** (exponent - 15));
  }
  return out;
})();

const encode = (c, gamma) =>
  gamma > 0 ? c ** (1 / gamma) : c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;

const heat = (luminance) => {
  const t = Math.min(Math.max((Math.log2(Math.max(luminance, 1e-6)) + 8) / 12, 0), 1);
  return [3, 2, 1].map((k) => Math.min(Math.max(1.5 - Math.abs(4 * t - k), 0), 1));
};

export const luminanceOf = (c) => 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];

/** A function that writes the colour of `sum` to `to` from `at` on. */
export const shade = ({ gamma, transform, falseColor, range }) => {
  if (range) return (sum, to, at) => sum.forEach((v, c) => (to[at + c] = (255 * (v - range[0])) / (range[1] - range[0])));
  if (falseColor) return (sum, to, at) => heat(luminanceOf(sum)).forEach((v, c) => (to[at + c] = 255 * v));
  const table = Uint8ClampedArray.from({ length: kSrgbSteps + 1 }, (_, i) =>
    255 * (transform === 2 ? i / kSrgbSteps : encode(i / kSrgbSteps, gamma)));
  const soft = transform === 1 ? (v) => (v * (1 + v / kWhite ** 2)) / (1 + v) : (v) => v;
  return (sum, to, at) => {
    for (let c = 0; c < 3; ++c) to[at + c] = table[Math.min(Math.round(soft(Math.max(sum[c], 0)) * kSrgbSteps), kSrgbSteps)];
  };
};
