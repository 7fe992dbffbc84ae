// Lights, objects and the picture's shader as cards of controls.
import { colorOf, isFactor, isLitBy, offeredNames, set, setColor, setLitBy, shaderOf, swap, valueOf } from "./edit.js";
import { colorRow, control, element } from "./controls.js";

/** The name of a shader, where another one may be chosen or typed. */
const chooser = (slot, owner, tools) => {
  const id = `offered-${slot}`;
  const input = element("input", { className: "shader", spellcheck: false, title: "Another shader", ariaLabel: `Shader of ${owner.owner}` });
  input.setAttribute("list", id);
  input.onfocus = async () => {
    if (!document.getElementById(id))
      document.body.append(element("datalist", { id }, ...(await offeredNames(slot)).map((name) => new Option(name))));
    input.select();
  };
  input.onchange = async () => {
    try {
      if (input.value === "") input.value = owner.shader;
      await tools.changeLater(`${slot} ${owner.owner} shader`, (state) => swap(state, slot, owner, input.value));
    } catch (e) {
      tools.note(e.message);
    }
    input.value = shaderOf(tools.state(), slot, owner).shader;
  };
  return input;
};

/** The parameters of an owner's shader, made anew when it gets another one. */
class Params {
  constructor(slot, owner, tools, main) {
    Object.assign(this, { slot, owner, tools, main, first: element("div"), others: element("div") });
    this.more = element("details", {}, element("summary", { textContent: "More" }), this.others);
    this.input = chooser(slot, owner, tools);
  }
  build(shader) {
    const { slot, owner, tools } = this;
    const controls = shader.params.map((p) => ({
      isMain: this.main(p),
      ...control(`${owner.owner} ${p.name}`, p, () => valueOf(tools.state(), slot, owner, p),
        (values) => tools.change(`${slot} ${owner.owner} ${p.name}`, (s) => set(s, slot, owner, p, values))),
    }));
    this.first.replaceChildren(...controls.filter((c) => c.isMain).map((c) => c.row));
    this.others.replaceChildren(...controls.filter((c) => !c.isMain).map((c) => c.row));
    this.more.hidden = this.others.childElementCount === 0;
    this.controls = controls, this.shader = shader;
  }
  refresh() {
    const shader = shaderOf(this.tools.state(), this.slot, this.owner);
    if (shader !== this.shader) this.build(shader), (this.input.value = shader.shader);
    for (const c of this.controls) c.refresh();
  }
}

const card = (className, title, input, children, ...buttons) =>
  element("div", { className }, element("header", {}, element("strong", { textContent: title, title }), input, ...buttons), ...children);

const found = (asked, ...texts) => texts.join(" ").toLowerCase().includes(asked);

export const buildLights = (into, scene, tools) => {
  const cards = scene.lights.map((light) => {
    const params = new Params("lights", light, tools, isFactor), layer = scene.layers.find((l) => l.lights.includes(light.owner));
    const marks = layer ? ["solo", "mute"].map((which) => {
      const button = element("button", { textContent: which === "solo" ? "S" : "M", title: which });
      button.onclick = () => tools.toggle(which, layer.name);
      return { button, refresh: () => button.classList.toggle("on", tools.isMarked(which, layer.name)) };
    }) : [];
    const box = card("light", light.owner, params.input, [params.first, params.more], ...marks.map((m) => m.button));
    into.append(box);
    return { box, params, light, refresh: () => { params.refresh(); for (const m of marks) m.refresh(); } };
  });
  const refresh = () => { for (const c of cards) c.refresh(); };
  refresh();
  return { refresh, search: (asked) => { for (const c of cards) c.box.hidden = !found(asked, c.light.owner, c.params.input.value); } };
};

/** What a card of an object holds; it is made when the card is first opened, since there may be many. */
const contentOf = (object, scene, tools) => {
  const owner = (slot) => scene[slot].find((s) => s.owner === object.name);
  const surface = new Params("surfaces", owner("surfaces"), tools, () => true);
  const air = new Params("atmospheres", owner("atmospheres"), tools, () => true);
  const color = colorRow("Color", "Color of the object, where no primitive variable gives one", () => colorOf(tools.state(), object),
    (rgb) => tools.change(`color ${object.name}`, (s) => setColor(s, object, rgb)), object.color);
  const lights = scene.lights.map((light) => {
    const box = element("input", { type: "checkbox" });
    box.onchange = () => tools.change("", (s) => setLitBy(s, object, light.owner, box.checked));
    return { row: element("label", { className: "link" }, box, light.owner), refresh: () => (box.checked = isLitBy(tools.state(), object, light.owner)) };
  });
  const folded = (title, ...children) => element("details", {}, element("summary", { textContent: title }), ...children);
  const parts = [surface, color, air, ...lights];
  return {
    rows: [element("label", { className: "row" }, element("span", { textContent: "Surface" }), surface.input), color.row, surface.first,
      folded("Air", element("label", { className: "row" }, element("span", { textContent: "Atmosphere" }), air.input), air.first),
      folded("Lit by", ...lights.map((l) => l.row))],
    refresh: () => { for (const p of parts) p.refresh(); },
  };
};

export const buildObjects = (into, scene, tools) => {
  const cards = scene.objects.map((object) => {
    const surface = scene.surfaces.find((s) => s.owner === object.name), shown = element("small");
    const details = element("details", {}, element("summary", {}, element("strong", { textContent: object.name }), " ", shown));
    const box = element("div", { className: "surface" }, details), card = { box, details, object, content: null };
    card.name = () => shaderOf(tools.state(), "surfaces", surface).shader;
    card.refresh = () => { shown.textContent = card.name(); card.content?.refresh(); };
    details.ontoggle = () => {
      if (!details.open || card.content) return;
      card.content = contentOf(object, scene, tools);
      details.append(...card.content.rows);
      card.content.refresh();
    };
    into.append(box);
    return card;
  });
  const refresh = () => { for (const c of cards) c.refresh(); };
  /** Shows the object that was chosen in the picture. */
  const choose = (name) => {
    for (const { object, box, details } of cards) {
      const is = object.name === name;
      box.classList.toggle("chosen", is);
      if (!is) continue;
      into.closest("details").open = details.open = true;
      box.scrollIntoView({ block: "nearest" });
    }
  };
  refresh();
  return { refresh, choose, search: (asked) => { for (const c of cards) c.box.hidden = !found(asked, c.object.name, c.name()); } };
};

export const buildImager = (into, scene, tools) => {
  const params = new Params("imagers", scene.imagers[0], tools, () => true);
  into.append(element("label", { className: "row", title: "It runs in the exact picture" }, element("span", { textContent: "Imager" }), params.input), params.first);
  params.refresh();
  return { refresh: () => params.refresh() };
};
