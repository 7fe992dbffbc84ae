// What is edited: values by light or object and by parameter. It is a plain object, so that states can be kept.
export const copyOf = (state) => structuredClone(state);
export const kNothing = { lights: {}, surfaces: {} };

const same = (a, b) => a.length === b.length && a.every((x, i) => x === b[i]);

/** Sets a value, or takes it out if it is that of the scene, so that an edit stays small. */
export const set = (state, kind, shader, param, numbers) => {
  const value = numbers.map(Math.fround);  // as the program keeps them
  const edits = (state[kind][shader.owner] ??= {});
  if (same(value, param.value)) delete edits[param.name];
  else edits[param.name] = value;
  if (Object.keys(edits).length === 0) delete state[kind][shader.owner];
};

export const valueOf = (state, kind, shader, param) => state[kind][shader.owner]?.[param.name] ?? param.value;

/** All that a light sends is in proportion to the parameters with these roles (TM_ROLE_SCALE, TM_ROLE_TINT). */
export const isFactor = (param) => param.role === "scale" || param.role === "tint";

export const strengthOf = (state, light) =>
  light.params.filter(isFactor).map((p) => valueOf(state, "lights", light, p))
    .reduce((strength, value) => strength.map((c, i) => c * value[i % value.length]), [1, 1, 1]);

/** Undo and redo. */
export class History {
  constructor(state) { this.states = [copyOf(state)]; this.at = 0; }
  /** Keeps a state; one of the same `what` as the last takes its place, as while a slider moves. */
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
