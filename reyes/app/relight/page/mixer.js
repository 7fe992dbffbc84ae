// The picture: layers of half floats, each with a weight, mixed where the browser can do it fastest. Layer 0 is the whole
// picture; where it is fresh, it is shown instead of the sum of the others.
const kVertex = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0, 1); }`;

const fragmentOf = (layers) => `#version 300 es
precision highp float; precision highp sampler2DArray;
uniform sampler2DArray layers; uniform sampler2D fresh;
uniform vec3 weights[${layers}]; uniform float exposure, gamma; uniform int falseColor, height;
out vec4 seen;
vec3 encode(vec3 c) {
  c = max(c, 0.0);
  if (gamma > 0.0) return pow(c, vec3(1.0 / gamma));
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}
vec3 heat(float stops) {
  float t = clamp((stops + 8.0) / 12.0, 0.0, 1.0);
  return clamp(vec3(1.5 - abs(4.0 * t - 3.0), 1.5 - abs(4.0 * t - 2.0), 1.5 - abs(4.0 * t - 1.0)), 0.0, 1.0);
}
void main() {
  ivec2 at = ivec2(int(gl_FragCoord.x), height - 1 - int(gl_FragCoord.y));
  vec3 sum = vec3(0);
  if (texelFetch(fresh, at, 0).r > 0.5) sum = texelFetch(layers, ivec3(at, 0), 0).rgb;
  else for (int i = 1; i < ${layers}; ++i) sum += weights[i] * texelFetch(layers, ivec3(at, i), 0).rgb;
  sum *= exposure;
  float luminance = dot(sum, vec3(0.2126, 0.7152, 0.0722));
  seen = vec4(falseColor == 1 ? heat(log2(max(luminance, 1e-6))) : encode(sum), 1);
}`;

const kSrgbSteps = 4096;

/** The numbers that the 65536 half floats stand for. */
const halves = (() => {
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

class Painter {
  /** Returns null if the browser has no WebGL2 for a picture of this size. */
  static on(canvas, layers) {
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, preserveDrawingBuffer: true });
    if (!gl) return null;
    const most = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    if (canvas.width > most || canvas.height > most || layers > gl.getParameter(gl.MAX_ARRAY_TEXTURE_LAYERS)) return null;
    return new Painter(gl, canvas, layers);
  }

  constructor(gl, canvas, layers) {
    Object.assign(this, { gl, canvas, layers });
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, kVertex], [gl.FRAGMENT_SHADER, fragmentOf(layers)]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    gl.useProgram(program);
    this.place = (name) => gl.getUniformLocation(program, name);
    const texture = (unit, target) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(target, gl.createTexture());
      for (const p of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(target, p, gl.NEAREST);
      for (const p of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(target, p, gl.CLAMP_TO_EDGE);
    };
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    texture(0, gl.TEXTURE_2D_ARRAY);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.RGB16F, canvas.width, canvas.height, layers);
    texture(1, gl.TEXTURE_2D);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.R8, canvas.width, canvas.height);
    gl.uniform1i(this.place("layers"), 0);
    gl.uniform1i(this.place("fresh"), 1);
    gl.uniform1i(this.place("height"), canvas.height);
  }

  put({ layer, x, y, width, height, half }) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, x, y, layer, width, height, 1, gl.RGB, gl.HALF_FLOAT, half);
  }
  fresh(x, y, width, height, value) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE1);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, x, y, width, height, gl.RED, gl.UNSIGNED_BYTE,
      new Uint8Array(width * height).fill(value ? 255 : 0));
  }
  paint(weights, view) {
    const { gl } = this;
    gl.uniform3fv(this.place("weights"), weights.flat());
    gl.uniform1f(this.place("exposure"), view.exposure);
    gl.uniform1f(this.place("gamma"), view.gamma);
    gl.uniform1i(this.place("falseColor"), view.falseColor ? 1 : 0);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.finish();
  }
}

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
    const { mixer } = this, to = this.image.data, count = mixer.width * mixer.height;
    const table = Uint8ClampedArray.from({ length: kSrgbSteps + 1 }, (_, i) => 255 * encode(i / kSrgbSteps, view.gamma));
    const used = mixer.halves.map((half, i) => ({ half, w: weights[i] })).slice(1).filter(({ half }) => half);
    for (let p = 0; p < count; ++p) {
      const sum = [0, 0, 0];
      for (let c = 0; c < 3; ++c) {
        if (mixer.isFresh[p]) sum[c] = halves[mixer.halves[0][3 * p + c]];
        else for (const { half, w } of used) sum[c] += w[c] * halves[half[3 * p + c]];
        sum[c] *= view.exposure;
        to[4 * p + c] = table[Math.min(Math.max(Math.round(sum[c] * kSrgbSteps), 0), kSrgbSteps)];
      }
      if (view.falseColor)
        heat(0.2126 * sum[0] + 0.7152 * sum[1] + 0.0722 * sum[2]).forEach((v, c) => (to[4 * p + c] = 255 * v));
    }
    this.context.putImageData(this.image, 0, 0);
  }
}

export class Mixer {
  /** plain: WebGL2 is not asked for. */
  constructor(canvas, width, height, layers, plain) {
    Object.assign(this, { width, height });
    canvas.width = width, canvas.height = height;
    this.halves = new Array(layers).fill(null);
    this.isFresh = new Uint8Array(width * height);
    this.painter = (plain ? null : Painter.on(canvas, layers)) ?? new PlainPainter(canvas, this);
  }
  get isPlain() { return this.painter instanceof PlainPainter; }

  put(block) {
    const { layer, x, y, width, height, half } = block;
    const to = (this.halves[layer] ??= new Uint16Array(3 * this.width * this.height));
    for (let row = 0; row < height; ++row)
      to.set(half.subarray(3 * width * row, 3 * width * (row + 1)), 3 * ((y + row) * this.width + x));
    this.painter.put(block);
  }
  /** Says whether layer 0 is the picture there. */
  fresh(x, y, width, height, value) {
    for (let row = y; row < y + height; ++row) this.isFresh.fill(value ? 1 : 0, row * this.width + x, row * this.width + x + width);
    this.painter.fresh(x, y, width, height, value);
  }
  paint(weights, view) { this.painter.paint(weights, view); }

  /** What each layer brings to a pixel, and whether layer 0 is shown there. */
  at(x, y, weights) {
    const p = y * this.width + x;
    const shares = this.halves.map((half, i) =>
      [0, 1, 2].map((c) => (half ? weights[i][c] * halves[half[3 * p + c]] : 0)));
    return { shares, isWhole: this.isFresh[p] === 1 };
  }
}
