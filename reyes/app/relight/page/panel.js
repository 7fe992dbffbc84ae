// Lights and surfaces as sliders, colours and numbers.
import { isFactor } from "./edit.js";

const element = (tag, props = {}, ...children) => {
  const out = Object.assign(document.createElement(tag), props);
  out.append(...children);
  return out;
};

const kStops = 6;
const hex = (color) =>
  "#" + color.map((c) => Math.round(255 * Math.min(Math.max(c, 0), 1) ** (1 / 2.2)).toString(16).padStart(2, "0")).join("");
const fromHex = (text) => [1, 3, 5].map((i) => (parseInt(text.slice(i, i + 2), 16) / 255) ** 2.2);

const text = (x) => String(Number(x.toPrecision(4)));

/** Makes the control of a parameter, and returns it with a function that shows the present value. */
const control = (kind, shader, param, tools) => {
  const value = () => tools.value(kind, shader, param);
  const set = (numbers) => tools.change(kind, shader, param, numbers);
  const row = element("label", { className: "row", title: param.doc }, element("span", { textContent: param.name }));
  if (param.type === "color") {
    const input = element("input", { type: "color" });
    // A colour may be brighter than white: its scale is kept.
    input.oninput = () => { const most = Math.max(...value(), 1); set(fromHex(input.value).map((c) => c * most)); };
    const reset = element("button", { textContent: "Reset", onclick: () => set(param.value) });
    row.append(input, reset);
    return { row, refresh: () => { const v = value(), most = Math.max(...v, 1); input.value = hex(v.map((c) => c / most)); } };
  }
  if (param.type !== "float") {
    row.classList.add("vector");
    const inputs = [0, 1, 2].map(() => element("input", { type: "number", step: "any" }));
    for (const input of inputs) input.onchange = () => set(inputs.map((i) => Number(i.value) || 0));
    row.append(...inputs);
    return { row, refresh: () => value().forEach((v, i) => (inputs[i].value = text(v))) };
  }
  const scene = param.value[0];
  const number = element("input", { type: "number", step: "any", className: "number" });
  const most = Math.max(1, 2 * Math.abs(scene));
  const slider = element("input", { type: "range", min: scene < 0 ? -most : 0, max: most, step: most / 500 });
  slider.setAttribute("aria-label", `${shader.owner} ${param.name}`);
  slider.oninput = () => set([Number(slider.value)]);
  slider.ondblclick = () => set([scene]);
  number.onchange = () => set([Number(number.value) || 0]);
  row.append(slider, number);
  return { row, refresh: () => { slider.value = value()[0]; number.value = text(value()[0]); } };
};

/** The scale of a light in stops from that of the scene, which is what a lighter turns; the number beside it is the value. */
const brightness = (light, param, tools) => {
  const scene = param.value[0];
  if (!(scene > 0)) return control("lights", light, param, tools);
  const value = () => tools.value("lights", light, param)[0];
  const slider = element("input", { type: "range", min: -kStops, max: kStops, step: 0.02 });
  slider.setAttribute("aria-label", `${light.owner} brightness in stops`);
  const number = element("input", { type: "number", step: "any", className: "number" });
  slider.oninput = () =>
    tools.change("lights", light, param, [Number(slider.value) <= -kStops ? 0 : scene * 2 ** Number(slider.value)]);
  slider.ondblclick = () => tools.change("lights", light, param, [scene]);
  number.onchange = () => tools.change("lights", light, param, [Math.max(Number(number.value) || 0, 0)]);
  const row = element("label", { className: "row", title: param.doc }, element("span", { textContent: param.name }), slider, number);
  const refresh = () => { slider.value = value() > 0 ? Math.log2(value() / scene) : -kStops; number.value = text(value()); };
  return { row, refresh };
};

const card = (className, title, shader, controls, ...buttons) => {
  const head = element("header", {}, element("strong", { textContent: title }), element("small", { textContent: shader }),
    element("span", { className: "space" }), ...buttons);
  return element("div", { className }, head, ...controls);
};

const more = (controls) =>
  element("details", {}, element("summary", { textContent: "More" }), ...controls.map((c) => c.row));

export const buildLights = (into, scene, tools) => {
  const all = [], marks = [];
  for (const light of scene.lights) {
    const layer = scene.layers.find((l) => l.lights.includes(light.owner));
    const main = light.params.filter(isFactor).map((p) =>
      p.role === "scale" ? brightness(light, p, tools) : control("lights", light, p, tools));
    const others = light.params.filter((p) => !isFactor(p)).map((p) => control("lights", light, p, tools));
    all.push(...main, ...others);
    const buttons = layer ? ["solo", "mute"].map((which) => {
      const button = element("button", { textContent: which === "solo" ? "S" : "M", title: which });
      button.onclick = () => tools.toggle(which, layer.name);
      marks.push(() => button.classList.toggle("on", tools.isMarked(which, layer.name)));
      return button;
    }) : [];
    into.append(card("light", light.owner, light.shader, [...main.map((c) => c.row), ...(others.length ? [more(others)] : [])], ...buttons));
  }
  const refresh = () => { for (const c of all) c.refresh(); for (const mark of marks) mark(); };
  refresh();
  return { refresh };
};

export const buildSurfaces = (into, search, scene, tools) => {
  const all = [], cards = [];
  for (const surface of scene.surfaces) {
    const controls = surface.params.map((p) => control("surfaces", surface, p, tools));
    const details = more(controls), box = card("surface", surface.owner, surface.shader, [details]);
    all.push(...controls), cards.push({ surface, box, details });
    into.append(box);
  }
  search.oninput = () => {
    const asked = search.value.toLowerCase();
    for (const { surface, box } of cards) box.hidden = !`${surface.owner} ${surface.shader}`.toLowerCase().includes(asked);
  };
  const refresh = () => { for (const c of all) c.refresh(); };
  /** Shows the surface of an object that was chosen in the picture. */
  const choose = (object) => {
    for (const { surface, box, details } of cards) {
      const is = surface.owner === object;
      box.classList.toggle("chosen", is);
      if (!is) continue;
      into.closest("details").open = details.open = true;
      box.scrollIntoView({ block: "nearest" });
    }
  };
  refresh();
  return { refresh, choose };
};
