// Pictures that are kept for comparison, each with its edit and a name.
import { element } from "./controls.js";

export class Snapshots {
  /** tools: picture() returns a canvas, back(state) makes a state the present one. */
  constructor(into, stage, tools) { Object.assign(this, { into, stage, tools, count: 0 }); }

  keep(state) {
    const from = this.tools.picture(), picture = element("canvas", { width: from.width, height: from.height });
    picture.getContext("2d").drawImage(from, 0, 0);
    const name = element("input", { value: `snapshot ${++this.count}`, ariaLabel: "Name of the snapshot" });
    const back = element("button", { textContent: "Back", title: "Make its edit the present one" });
    const row = element("div", { className: "row", title: "Compare with it" }, name, back, element("button", { textContent: "x", title: "Drop it" }));
    const choose = () => {
      for (const other of this.into.children) other.classList.toggle("chosen", other === row);
      this.stage.compareWith(picture);
    };
    back.onclick = () => this.tools.back(state);
    row.onclick = choose;
    row.lastChild.onclick = (e) => {
      e.stopPropagation();
      row.remove();
      if (row.classList.contains("chosen")) this.stage.compareWith(null);
    };
    this.into.append(row);
    choose();
  }
}
