// The picture on the screen: zoom, pan, the wipe against a snapshot, regions, and the object under the pointer.
import { luminanceOf } from "./color.js";

const kSoon_ms = 60;

export class Stage {
  constructor(element, canvas, wipe, tools) {
    Object.assign(this, { element, canvas, wipe, tools, scale: 1, x: 0, y: 0, share: 0.5, placed: [] });
    this.probe = element.querySelector("#probe");
    element.addEventListener("wheel", (e) => this.wheel(e), { passive: false });
    element.addEventListener("pointerdown", (e) => this.down(e));
    element.addEventListener("pointermove", (e) => this.move(e));
    element.addEventListener("pointerup", (e) => this.up(e));
    element.addEventListener("pointerleave", () => { this.pixel = null; this.showProbe(); });
    new ResizeObserver(() => (this.fitted ? this.fit() : this.place())).observe(element);
  }

  fit() {
    const { width, height } = this.element.getBoundingClientRect();
    this.scale = Math.min(width / this.canvas.width, height / this.canvas.height);
    this.x = (width - this.scale * this.canvas.width) / 2;
    this.y = (height - this.scale * this.canvas.height) / 2;
    this.fitted = true;
    this.place();
  }
  oneToOne() {
    const { width, height } = this.element.getBoundingClientRect();
    this.zoomTo(1 / devicePixelRatio, width / 2, height / 2);
  }
  zoomTo(scale, atX, atY) {
    const by = scale / this.scale;
    this.x = atX - by * (atX - this.x), this.y = atY - by * (atY - this.y);
    this.scale = scale, this.fitted = false;
    this.place();
  }
  place() {
    const transform = `translate(${this.x}px, ${this.y}px) scale(${this.scale})`;
    this.canvas.style.transform = transform;
    for (const call of this.placed) call();
    if (!this.kept) return;
    const edge = this.share * this.element.clientWidth;
    this.kept.style.transform = transform;
    const cut = Math.min(Math.max((edge - this.x) / this.scale, 0), this.canvas.width);
    this.kept.style.clipPath = `inset(0 ${this.canvas.width - cut}px 0 0)`;
    this.wipe.style.left = `${edge}px`;
  }

  /** Calls a function now and whenever the picture has moved on the screen. */
  whenPlaced(call) { this.placed.push(call); call(); }
  /** Puts an element over these pixels. */
  cover(element, { x, y, width, height }) {
    Object.assign(element.style, { left: `${this.x + this.scale * x}px`, top: `${this.y + this.scale * y}px`,
      width: `${this.scale * width}px`, height: `${this.scale * height}px` });
  }
  /** The pixels that are in view. */
  inView() {
    const { width, height } = this.element.getBoundingClientRect();
    return this.regionOf({ x: -this.x / this.scale, y: -this.y / this.scale }, { x: (width - this.x) / this.scale, y: (height - this.y) / this.scale });
  }
  /** The pixels between two places; null if they are outside of the picture. */
  regionOf(a, b) {
    const inside = (v, most) => Math.round(Math.min(Math.max(v, 0), most));
    const x = [a.x, b.x].map((v) => inside(v, this.canvas.width)).sort((p, q) => p - q);
    const y = [a.y, b.y].map((v) => inside(v, this.canvas.height)).sort((p, q) => p - q);
    return x[0] < x[1] && y[0] < y[1] ? { x: x[0], y: y[0], width: x[1] - x[0], height: y[1] - y[0] } : null;
  }
  /** The next drag chooses a region, which is passed to `choose`. */
  askForRegion(choose) { this.choose = choose; this.element.classList.toggle("chooses", Boolean(choose)); }

  /** Puts this canvas beside the picture, to the left of the wipe; null: none. */
  compareWith(canvas) {
    this.kept?.remove();
    this.kept = canvas;
    if (!canvas) return this.toggleWipe(false);
    canvas.id = "kept";
    canvas.style.cssText = "position:absolute;transform-origin:0 0;image-rendering:pixelated";
    this.canvas.after(canvas);
    this.toggleWipe(!this.wipe.hidden);
  }
  toggleWipe(on = this.wipe.hidden) {
    this.wipe.hidden = !on || !this.kept;
    if (this.kept) this.kept.hidden = this.wipe.hidden;
    this.place();
  }

  placeAt(e) {
    const box = this.element.getBoundingClientRect();
    return { x: (e.clientX - box.left - this.x) / this.scale, y: (e.clientY - box.top - this.y) / this.scale };
  }
  pixelAt(e) {
    const at = this.placeAt(e), x = Math.floor(at.x), y = Math.floor(at.y);
    return x >= 0 && y >= 0 && x < this.canvas.width && y < this.canvas.height ? { x, y } : null;
  }
  wheel(e) {
    e.preventDefault();
    const box = this.element.getBoundingClientRect();
    const scale = Math.min(Math.max(this.scale * Math.exp(-e.deltaY / 400), 0.02), 64);
    this.zoomTo(scale, e.clientX - box.left, e.clientY - box.top);
  }
  down(e) {
    this.element.setPointerCapture(e.pointerId);
    this.drag = { x: e.clientX, y: e.clientY, moved: false, wipes: e.target === this.wipe, begin: this.choose ? this.placeAt(e) : null };
  }
  move(e) {
    this.pixel = this.pixelAt(e);
    this.showProbe();
    clearTimeout(this.telling);
    if (this.pixel) this.telling = setTimeout(({ x, y }) => this.tools.moved(x, y), kSoon_ms, this.pixel);
    if (!this.drag) return;
    const dx = e.clientX - this.drag.x, dy = e.clientY - this.drag.y;
    if (!this.drag.moved && Math.hypot(dx, dy) < 4) return;
    if (this.drag.begin) {
      this.choose(this.regionOf(this.drag.begin, this.placeAt(e)), false);
    } else if (this.drag.wipes) {
      const box = this.element.getBoundingClientRect();
      this.share = Math.min(Math.max((e.clientX - box.left) / box.width, 0), 1);
    } else {
      this.x += dx, this.y += dy, this.fitted = false;
    }
    Object.assign(this.drag, { x: e.clientX, y: e.clientY, moved: true });
    this.place();
  }
  up(e) {
    const at = this.pixelAt(e);
    if (this.drag?.begin) {
      const choose = this.choose;
      this.askForRegion(null);
      choose(this.drag.moved ? this.regionOf(this.drag.begin, this.placeAt(e)) : null, true);
    } else if (this.drag && !this.drag.moved && !this.drag.wipes && at) this.tools.clicked(at.x, at.y);
    this.drag = null;
  }

  say(text) { this.said = text; this.showProbe(); }
  /** What each light brings to the pixel under the pointer, as bars. */
  showProbe() {
    this.probe.hidden = !this.pixel;
    if (!this.pixel) return;
    const { x, y } = this.pixel, { shares, isWhole, more } = this.tools.at(x, y), luminance = luminanceOf;
    const lights = shares.slice(1), sum = [0, 1, 2].map((c) => lights.reduce((all, s) => all + s[c], 0));
    const seen = isWhole ? shares[0] : sum, most = Math.max(...lights.map(luminance), 1e-6);
    const line = document.createElement("div");
    line.textContent = `${x}, ${y}   ${seen.map((v) => v.toPrecision(4)).join("  ")}`;
    const bars = lights.map((share, i) => {
      const row = document.createElement("div"), name = document.createElement("span"), bar = document.createElement("span"),
        fill = document.createElement("i"), number = document.createElement("span");
      row.className = "bar", name.textContent = this.tools.layers[i + 1].name, number.textContent = luminance(share).toPrecision(3);
      const peak = Math.max(...share, 1e-9);
      fill.style.width = `${(100 * Math.max(luminance(share), 0)) / most}%`;
      fill.style.background = `rgb(${share.map((v) => Math.round(255 * Math.sqrt(Math.max(v, 0) / peak))).join(",")})`;
      bar.append(fill), row.append(name, bar, number);
      return row;
    });
    const said = document.createElement("div");
    said.textContent = [this.said, more].filter(Boolean).join("\n");
    this.probe.replaceChildren(line, ...bars, said);
  }
}
