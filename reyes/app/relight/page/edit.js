// The edit in the form that the program takes: values by owner and parameter, other shaders, and the lights that shine on
// objects. It is a plain object, so that states can be kept.
import { get } from "./server.js";

export const copyOf = (state) => structuredClone(state);
export const kNothing = { lights: {}, surfaces: {}, atmospheres: {}, imagers: {}, shaders: {}, objects: {} };
const kSlots = ["lights", "surfaces", "atmospheres", "imagers"];

const same = (a, b) => a.length === b.length && a.every((x, i) => x === b[i]);
const sorted = (x) => (x === null || typeof x !== "object" || Array.isArray(x) ? x
  : Object.fromEntries(Object.keys(x).sort().map((k) => [k, sorted(x[k])]).filter(([, v]) => v?.constructor !== Object || Object.keys(v).length > 0)));
/** A text that is the same for states that the program does not tell apart. */
export const nameOf = (state) => JSON.stringify(sorted(state));

/** Shaders that may take the place of the scene's. */
const offered = new Map();
let names = null;
export const offeredNames = async (slot) => (names ??= await get("offered"))[slot];
export const offer = async (slot, name) => {
  const key = `${slot} ${name}`;
  if (!offered.has(key)) offered.set(key, await get(`shader?kind=${slot}&name=${encodeURIComponent(name)}`));
  return offered.get(key);
};
/** Fetches the descriptions of the shaders of a state. */
export const prepare = async (state) => {
  for (const [slot, owners] of Object.entries(state.shaders ?? {}))
    for (const name of Object.values(owners)) await offer(slot, name);
};

/** The shader that an owner has under a state: name, and parameters with the values that they have without the edit. */
export const shaderOf = (state, slot, owner) => {
  const name = state.shaders[slot]?.[owner.owner];
  return name === undefined ? owner : offered.get(`${slot} ${name}`);
};
export const valueOf = (state, slot, owner, param) => state[slot][owner.owner]?.[param.name] ?? param.value;

const put = (edits, key, value) => { if (value === undefined) delete edits[key]; else edits[key] = value; };
const place = (state, slot, key, name, value) => {
  put((state[slot][key] ??= {}), name, value);
  if (Object.keys(state[slot][key]).length === 0) delete state[slot][key];
};

/** Sets a value, or removes it if the shader has it anyway, so that an edit stays small. */
export const set = (state, slot, owner, param, values) => {
  const value = values.map((v) => (typeof v === "number" ? Math.fround(v) : v));  // as the program keeps them
  place(state, slot, owner.owner, param.name, same(value, param.value) ? undefined : value);
};

/** Replaces a shader by another; parameters that both have keep their values. */
export const swap = async (state, slot, owner, name) => {
  const before = shaderOf(state, slot, owner);
  const next = name === owner.shader ? owner : await offer(slot, name);
  const values = new Map(before.params.map((p) => [`${p.type} ${p.name}`, valueOf(state, slot, owner, p)]));
  place(state, "shaders", slot, owner.owner, next === owner ? undefined : name);
  delete state[slot][owner.owner];
  for (const p of next.params)
    if (values.has(`${p.type} ${p.name}`)) set(state, slot, owner, p, values.get(`${p.type} ${p.name}`));
};

export const colorOf = (state, object) => state.objects[object.name]?.color ?? object.color;
export const setColor = (state, object, rgb) => {
  const value = rgb.map(Math.fround);
  place(state, "objects", object.name, "color", same(value, object.color) ? undefined : value);
};
export const isLitBy = (state, object, light) => state.objects[object.name]?.lights?.[light] ?? object.lights.includes(light);
export const setLitBy = (state, object, light, shines) => {
  const lights = { ...state.objects[object.name]?.lights };
  put(lights, light, shines === object.lights.includes(light) ? undefined : shines);
  place(state, "objects", object.name, "lights", Object.keys(lights).length > 0 ? lights : undefined);
};

/** All that a light sends is in proportion to the parameters with these roles (TM_ROLE_SCALE, TM_ROLE_TINT). */
export const isFactor = (param) => param.role === "scale" || param.role === "tint";

export const strengthOf = (state, light) =>
  shaderOf(state, "lights", light).params.filter(isFactor).map((p) => valueOf(state, "lights", light, p))
    .reduce((strength, value) => strength.map((c, i) => c * value[i % value.length]), [1, 1, 1]);

/** A state with nothing missing. */
export const whole = (state) => {
  const out = { ...copyOf(kNothing), ...copyOf(state) };
  for (const slot of kSlots) out[slot] ??= {};
  return out;
};

/** Undo and redo. */
export class History {
  constructor(state) { this.states = [copyOf(state)]; this.at = 0; }
  /** Keeps a state. It replaces the last one if that has the same `what`, as while a slider moves. */
  keep(state, what) {
    this.states.length = this.at + 1;
    if (what && what === this.what && this.at > 0) this.states[this.at] = copyOf(state);
    else this.at = this.states.push(copyOf(state)) - 1;
    this.what = what;
  }
  step(by) {
    this.what = undefined;
    this.at = Math.min(Math.max(this.at + by, 0), this.states.length - 1);
    return copyOf(this.states[this.at]);
  }
}
