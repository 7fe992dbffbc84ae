// Shows what is being computed, how old the picture is, and where bounced light does not follow the edit.
import { element } from "./controls.js";
import { link } from "./server.js";

const seconds = (ms) => (ms < 1000 ? "now" : ms < 120e3 ? `${Math.round(ms / 1000)} s` : `${Math.round(ms / 60e3)} min`);
const megabytes = (bytes) => `${(bytes / 1e6).toFixed(bytes < 1e7 ? 1 : 0)} MB`;

export class Work {
  /** into: rows of the layers; overlay: a canvas of the picture's size. */
  constructor(into, overlay, stage, mixer, scene) {
    Object.assign(this, { into, overlay, stage, mixer, scene, shows: false });
    overlay.width = Math.ceil(scene.width / 4);
    overlay.height = Math.ceil(scene.height / 4);
    stage.whenPlaced(() => stage.cover(overlay, { x: 0, y: 0, width: scene.width, height: scene.height }));
    this.rows = scene.layers.slice(1).map((layer) => {
      const row = element("div", { className: "bar" }, element("span", { textContent: layer.name }), element("span", {}, element("i")), element("span"));
      into.append(row);
      return row;
    });
    this.text = element("p");
    into.append(this.text);
  }

  /** Whether a received part of a layer is of an earlier version than the program's. */
  isOld(part, status, layer) { return part.version !== status.layers[layer].version; }

  show(status) {
    this.status = status;
    const now = performance.now();
    let oldest = 0, coarse = 0, parts = 0;
    this.rows.forEach((row, i) => {
      const layer = i + 1, { left } = status.layers[layer];
      row.querySelector("i").style.width = `${100 * (1 - left)}%`;
      row.lastChild.textContent = left > 0 ? `${Math.round(100 * (1 - left))} %` : "done";
      for (const part of this.mixer.parts[layer].values()) {
        ++parts;
        if (part.step > 1) ++coarse;
        if (this.isOld(part, status, layer)) oldest = Math.max(oldest, now - part.time);
      }
    });
    this.text.textContent = `${oldest > 0 ? `The oldest part that an edit has changed is ${seconds(oldest)} old` : "What is seen is the present edit"}` +
      `${coarse > 0 ? `; ${Math.round((100 * coarse) / parts)} % of the parts are coarse` : ""}. ` +
      `Link: ${megabytes(link.rate)}/s, ${megabytes(link.received)} so far.`;
    if (this.shows) this.paint();
  }

  toggle() {
    this.shows = !this.shows;
    this.overlay.hidden = !this.shows;
    if (this.shows) this.paint();
    return this.shows;
  }
  /** Red: of an earlier edit. Yellow: coarse. Blue frames: bounced light that was gathered anew. */
  paint() {
    if (!this.status) return;
    const g = this.overlay.getContext("2d");
    const box = ({ x, y, width, height }) => [x / 4, y / 4, width / 4, height / 4];
    g.clearRect(0, 0, this.overlay.width, this.overlay.height);
    for (let layer = 1; layer < this.scene.layers.length; ++layer)
      for (const part of this.mixer.parts[layer].values()) {
        g.fillStyle = this.isOld(part, this.status, layer) ? "#ff404060" : part.step > 1 ? "#ffd04040" : "transparent";
        g.fillRect(...box(part));
      }
    g.strokeStyle = "#60a0ff";
    for (const [x0, y0, x1, y1] of this.status.gathered) g.strokeRect(...box({ x: x0, y: y0, width: x1 - x0, height: y1 - y0 }));
  }
  /** How old a pixel is. */
  at(x, y) {
    if (!this.status) return "";
    const holds = (p) => x >= p.x && y >= p.y && x < p.x + p.width && y < p.y + p.height;
    const here = this.mixer.parts.slice(1, -1).flatMap((parts, i) => [...parts.values()].filter(holds).map((p) => ({ p, layer: i + 1 })));
    const old = here.filter(({ p, layer }) => this.isOld(p, this.status, layer));
    if (old.length > 0) return `of an edit ${seconds(performance.now() - Math.min(...old.map(({ p }) => p.time)))} ago`;
    return here.some(({ p }) => p.step > 1) ? "coarse" : "";
  }
}
