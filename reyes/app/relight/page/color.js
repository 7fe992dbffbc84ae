// Turns numbers of light into colours of a screen. painter.js does the same in GLSL.

/** Names of view transforms, in the order of their numbers. "soft" is equation 4 of Reinhard et al. 2002 for each channel,
    with white at 4. */
export const kTransforms = ["standard", "soft", "linear"];
export const kWhite = 4;
const kSteps = 16384;

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

const kLargest = 1;  // what is brighter is white

/** Colours are numbers of 32 bits here, as ImageData holds them: red in the lowest byte, alpha in the highest. */
export const kOpaque = 0xff000000;

/** The bytes of a screen for light of 0, 1 / perUnit, 2 / perUnit...; what is brighter has the last one. */
export const tableOf = ({ gamma, transform }) => {
  const most = transform === 1 ? kWhite : kLargest, perUnit = kSteps / most;
  const soft = transform === 1 ? (v) => (v * (1 + v / kWhite ** 2)) / (1 + v) : (v) => v;
  const bytes = Uint8ClampedArray.from({ length: kSteps + 1 }, (_, i) => {
    const v = soft(i / perUnit);
    return 255 * (transform === 2 ? v : encode(v, gamma));
  });
  return { bytes, perUnit };
};

/** The colours that stand for numbers r, g, b of a variable, or for how bright light is. */
export const lookOf = ({ range }) => {
  const byte = (v) => Math.round(Math.min(Math.max(v, 0), 255));
  const packed = (r, g, b) => kOpaque | (byte(b) << 16) | (byte(g) << 8) | byte(r);
  const scaled = (v) => (255 * (v - range[0])) / (range[1] - range[0]);
  if (range) return (r, g, b) => packed(scaled(r), scaled(g), scaled(b));
  return (r, g, b) => packed(...heat(luminanceOf([r, g, b])).map((v) => 255 * v));
};
