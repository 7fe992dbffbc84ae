// Controls of single values: sliders, colours, numbers and texts.
export const element = (tag, props = {}, ...children) => {
  const out = Object.assign(document.createElement(tag), props);
  out.append(...children);
  return out;
};

const kStops = 6;
const hex = (color) =>
  "#" + color.map((c) => Math.round(255 * Math.min(Math.max(c, 0), 1) ** (1 / 2.2)).toString(16).padStart(2, "0")).join("");
const fromHex = (text) => [1, 3, 5].map((i) => (parseInt(text.slice(i, i + 2), 16) / 255) ** 2.2);
const text = (x) => String(Number(x.toPrecision(4)));
const numberOf = (input) => Number(input.value) || 0;

const rowOf = (name, title, ...children) =>
  element("label", { className: "row", title }, element("span", { textContent: name }), ...children);

/** Ranges of parameters by their names; others go to twice the scene's value. */
const kRanges = [[/angle/, 0, Math.PI / 2], [/^K[a-z]?$/, 0, 1], [/roughness/i, 0.001, 1], [/blur|width/, 0, 0.2], [/samples/, 1, 64],
  [/^__|metallic|specular|clearcoat|sheen|subsurface/, 0, 1]];
export const rangeOf = (name, value) => {
  const [, least, most] = kRanges.find(([pattern]) => pattern.test(name)) ?? [null, 0, Math.max(1, 2 * Math.abs(value))];
  return [value < 0 ? -Math.max(most, 2 * Math.abs(value)) : Math.min(least, value), Math.max(most, value)];
};

/** A colour; one brighter than white keeps its scale. */
export const colorRow = (name, title, value, set, first) => {
  const input = element("input", { type: "color" });
  const numbers = [0, 1, 2].map((i) => element("input", { type: "number", step: "any", className: "part", ariaLabel: `${name} ${"RGB"[i]}` }));
  input.oninput = () => { const most = Math.max(...value(), 1); set(fromHex(input.value).map((c) => c * most)); };
  for (const n of numbers) n.onchange = () => set(numbers.map(numberOf));
  const reset = element("button", { textContent: "Reset", onclick: () => set(first) });
  const refresh = () => {
    const v = value(), most = Math.max(...v, 1);
    input.value = hex(v.map((c) => c / most));
    numbers.forEach((n, i) => (n.value = text(v[i])));
  };
  return { row: rowOf(name, title, input, ...numbers, reset), refresh };
};

const sliderRow = (label, param, value, set) => {
  const [least, most] = rangeOf(param.name, param.value[0]);
  const number = element("input", { type: "number", step: "any", className: "number" });
  const slider = element("input", { type: "range", min: least, max: most, step: (most - least) / 500, ariaLabel: label });
  slider.oninput = () => set([Number(slider.value)]);
  slider.ondblclick = () => set(param.value);
  number.onchange = () => set([numberOf(number)]);
  return { row: rowOf(param.name, param.doc, slider, number), refresh: () => { slider.value = value()[0]; number.value = text(value()[0]); } };
};

/** The scale of a light in stops above the scene's, which is how lighting artists count; the number beside it is the value. */
const stopsRow = (label, param, value, set) => {
  const scene = param.value[0] > 0 ? param.value[0] : 1;
  const slider = element("input", { type: "range", min: -kStops, max: kStops, step: 0.02, ariaLabel: `${label} in stops` });
  const number = element("input", { type: "number", step: "any", className: "number" });
  slider.oninput = () => set([Number(slider.value) <= -kStops ? 0 : scene * 2 ** Number(slider.value)]);
  slider.ondblclick = () => set(param.value);
  number.onchange = () => set([Math.max(numberOf(number), 0)]);
  const refresh = () => { slider.value = value()[0] > 0 ? Math.log2(value()[0] / scene) : -kStops; number.value = text(value()[0]); };
  return { row: rowOf(param.name, param.doc, slider, number), refresh };
};

/** Texts, or numbers that have no slider: points, matrices, arrays. */
const fieldsRow = (param, value, set) => {
  const isText = typeof param.value[0] === "string";
  const inputs = param.value.map((_, i) =>
    element("input", isText ? { type: "text", maxLength: 256, spellcheck: false } : { type: "number", step: "any" , ariaLabel: `${param.name} ${i + 1}` }));
  for (const input of inputs) input.onchange = () => set(inputs.map((i) => (isText ? i.value : numberOf(i))));
  const row = rowOf(param.name, param.doc, element("span", { className: "fields" }, ...inputs));
  row.classList.add(isText ? "texts" : "vector");
  return { row, refresh: () => value().forEach((v, i) => (inputs[i].value = isText ? v : text(v))) };
};

/** The control of a parameter: its row, and a function that shows the present value. */
export const control = (label, param, value, set) => {
  if (param.type === "color") return colorRow(param.name, param.doc, value, set, param.value);
  if (param.type !== "float") return fieldsRow(param, value, set);
  return param.role === "scale" && param.value[0] >= 0 ? stopsRow(label, param, value, set) : sliderRow(label, param, value, set);
};
