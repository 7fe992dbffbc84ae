// Points of lights in the picture, such as a spot's "from" and "to". They are dragged parallel to the image, or with
// Shift towards the eye and away.
import { set, shaderOf, valueOf } from "./edit.js";

const kPixelsPerE = 200;  // a drag of this many pixels moves a point e times as near or as far

const times = (m, v) => [0, 1, 2, 3].map((row) => m[row] * v[0] + m[4 + row] * v[1] + m[8 + row] * v[2] + m[12 + row] * v[3]);

/** The inverse of a matrix of four columns, by Gauss and Jordan; null if there is none. */
export const inverse = (m) => {
  const rows = [0, 1, 2, 3].map((r) => [0, 1, 2, 3, 4, 5, 6, 7].map((c) => (c < 4 ? m[4 * c + r] : c - 4 === r ? 1 : 0)));
  for (let c = 0; c < 4; ++c) {
    const pivot = rows.slice(c).reduce((best, row) => (Math.abs(row[c]) > Math.abs(best[c]) ? row : best));
    if (pivot[c] === 0) return null;
    rows.splice(rows.indexOf(pivot), 1, rows[c]);
    rows[c] = pivot.map((x) => x / pivot[c]);
    for (let r = 0; r < 4; ++r) if (r !== c) rows[r] = rows[r].map((x, k) => x - rows[r][c] * rows[c][k]);
  }
  return [0, 1, 2, 3].flatMap((c) => rows.map((row) => row[4 + c]));
};

/** The pixel of a point, with the numbers that unproject() needs; null if the point is not in front of the eye. */
export const project = (matrix, point) => {
  const at = times(matrix, [...point, 1]);
  return at[3] > 0 ? { x: at[0] / at[3], y: at[1] / at[3], depth: at[2], w: at[3] } : null;
};
export const unproject = (back, { x, y, depth, w }) => {
  const at = times(back, [x * w, y * w, depth, w]);
  return at.slice(0, 3).map((c) => c / at[3]);
};

export class Handles {
  constructor(stage, scene, tools) {
    Object.assign(this, { stage, tools, all: [] });
    this.lights = scene.lights.map((light) => ({ light, back: inverse(light.pixelFromShader) })).filter(({ back }) => back);
    stage.whenPlaced(() => this.place());
  }

  /** Makes the handles of the shaders that the lights have now. */
  build() {
    const state = this.tools.state(), shaders = this.lights.map(({ light }) => shaderOf(state, "lights", light));
    if (this.shaders?.every((s, i) => s === shaders[i])) return;
    this.shaders = shaders;
    for (const { dot } of this.all) dot.remove();
    this.all = this.lights.flatMap(({ light, back }, i) =>
      shaders[i].params.filter((p) => p.type === "point").map((param) => this.handleOf(light, back, param)));
  }
  handleOf(light, back, param) {
    const { tools, stage } = this, dot = document.createElement("div");
    const handle = { dot, light, back, value: () => valueOf(tools.state(), "lights", light, param) };
    Object.assign(dot, { className: "handle", hidden: true, title: `${light.owner} ${param.name}` });
    dot.addEventListener("pointerdown", (e) => { e.stopPropagation(); dot.setPointerCapture(e.pointerId); handle.last = e; });
    dot.addEventListener("pointermove", (e) => {
      if (!handle.last) return;
      e.stopPropagation();
      const point = this.moved(handle, e.clientX - handle.last.clientX, e.clientY - handle.last.clientY, e.shiftKey);
      tools.change(`lights ${light.owner} ${param.name}`, (s) => set(s, "lights", light, param, point));
      handle.last = e;
    });
    dot.addEventListener("pointerup", (e) => { e.stopPropagation(); handle.last = null; });
    stage.element.append(dot);
    return handle;
  }

  moved({ light, back, value }, dx, dy, inDepth) {
    const at = project(light.pixelFromShader, value());
    if (!inDepth) return unproject(back, { ...at, x: at.x + dx / this.stage.scale, y: at.y + dy / this.stage.scale });
    const near = unproject(back, { x: at.x, y: at.y, depth: 0, w: 1 }), share = Math.exp(-dy / kPixelsPerE);
    return value().map((c, k) => near[k] + share * (c - near[k]));
  }

  toggle() { this.shown = !this.shown; this.place(); return this.shown; }
  place() {
    this.build();
    for (const { dot, light, value } of this.all) {
      const at = this.shown ? project(light.pixelFromShader, value()) : null;
      dot.hidden = !at;
      if (at) dot.style.transform = `translate(${this.stage.x + this.stage.scale * at.x}px, ${this.stage.y + this.stage.scale * at.y}px)`;
    }
  }
}
