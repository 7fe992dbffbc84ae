// Paints the mixer's picture by WebGL2. color.js does the same in JavaScript.
import { kWhite } from "./color.js";

const kVertex = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0, 1); }`;

const fragmentOf = (layers) => `#version 300 es
precision highp float; precision highp sampler2DArray;
uniform sampler2DArray layers; uniform sampler2D fresh;
uniform vec3 weights[${layers}]; uniform float exposure, wholeExposure, gamma; uniform int falseColor, transform, height;
uniform vec2 range; uniform int showsVariable;
out vec4 seen;
vec3 encode(vec3 c) {
  c = max(c, 0.0);
  if (transform == 2) return c;
  if (transform == 1) c = c * (1.0 + c / ${(kWhite ** 2).toFixed(1)}) / (1.0 + c);
  if (gamma > 0.0) return pow(c, vec3(1.0 / gamma));
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}
vec3 heat(float stops) {
  float t = clamp((stops + 8.0) / 12.0, 0.0, 1.0);
  return clamp(vec3(1.5 - abs(4.0 * t - 3.0), 1.5 - abs(4.0 * t - 2.0), 1.5 - abs(4.0 * t - 1.0)), 0.0, 1.0);
}
void main() {
  ivec2 at = ivec2(int(gl_FragCoord.x), height - 1 - int(gl_FragCoord.y));
  if (showsVariable == 1) {
    vec3 v = texelFetch(layers, ivec3(at, ${layers - 1}), 0).rgb;
    seen = vec4((v - range.x) / (range.y - range.x), 1);
    return;
  }
  vec3 sum = vec3(0);
  if (texelFetch(fresh, at, 0).r > 0.5) sum = wholeExposure * texelFetch(layers, ivec3(at, 0), 0).rgb;
  else {
    for (int i = 1; i < ${layers - 1}; ++i) sum += weights[i] * texelFetch(layers, ivec3(at, i), 0).rgb;
    sum *= exposure;
  }
  float luminance = dot(sum, vec3(0.2126, 0.7152, 0.0722));
  seen = vec4(falseColor == 1 ? heat(log2(max(luminance, 1e-6))) : encode(sum), 1);
}`;

export class Painter {
  /** Returns null if the browser has no WebGL2 for a picture of this size, or (unless it has to) without a GPU: JavaScript
      is ten times as fast then. */
  static on(canvas, layers, must) {
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, preserveDrawingBuffer: true, failIfMajorPerformanceCaveat: !must });
    if (!gl) return null;
    const most = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    if (canvas.width > most || canvas.height > most || layers > gl.getParameter(gl.MAX_ARRAY_TEXTURE_LAYERS)) return null;
    return new Painter(gl, canvas, layers);
  }

  constructor(gl, canvas, layers) {
    Object.assign(this, { gl, canvas, seen: new Uint8Array(4) });
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

  settle() {}
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
    gl.uniform3fv(this.place("weights"), [...weights.flat(), 0, 0, 0]);
    for (const name of ["exposure", "wholeExposure", "gamma"]) gl.uniform1f(this.place(name), view[name]);
    gl.uniform1i(this.place("falseColor"), view.falseColor ? 1 : 0);
    gl.uniform1i(this.place("transform"), view.transform);
    gl.uniform1i(this.place("showsVariable"), view.range ? 1 : 0);
    gl.uniform2fv(this.place("range"), view.range ?? [0, 1]);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, this.seen);  // finish() may return before the picture is there
  }
}
