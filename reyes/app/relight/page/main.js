import { get, post, listen } from "./server.js";
import { History, copyOf, kNothing, set, strengthOf, valueOf } from "./edit.js";
import { Mixer } from "./mixer.js";
import { Stage } from "./stage.js";
import { Handles } from "./handles.js";
import { buildLights, buildSurfaces } from "./panel.js";

const $ = (id) => document.getElementById(id);
const kKeys = `Z, Shift+Z   undo, redo
E            exact picture, or the mix
S            keep a snapshot
W            wipe against the snapshot
F, 1         fit, one to one
L            false colours
H            points of lights, to be dragged; with Shift in depth
drag, wheel  pan, zoom
click        choose the object there
,  .         darker, brighter`;

const scene = await get("scene");
const mixer = new Mixer($("picture"), scene.width, scene.height, scene.layers.length,
  new URLSearchParams(location.search).has("plain"));
let state = { ...copyOf(kNothing), ...scene.present };
const history = new History(state);
let status = { layers: scene.layers.map(() => ({ version: 0, edit: null, old: true })) };
let exact = false, falseColor = false;
/** Several pages may watch; one edits, until another takes over. */
const page = 1 + Math.floor(Math.random() * 999999998);
const watches = () => Boolean(status.editor) && status.editor !== page;
addEventListener("pagehide", () => navigator.sendBeacon(`leave?page=${page}`));
const postEdit = (more = "") => post(`edit?page=${page}${more}`, state);
/** Lights that are heard alone, or not: a way of looking, and no part of the edit. */
const solo = new Set(), mute = new Set();

const lightOf = (handle) => scene.lights.find((l) => l.owner === handle);
const ratio = (now, then) => now.map((x, c) => (x === then[c] ? 1 : then[c] === 0 ? 0 : x / then[c]));

/** How much of each layer is in the picture: what its lights send now over what they sent when it was shaded. */
const weights = () => scene.layers.map((layer, i) => {
  if (i === 0) return [1, 1, 1];
  if ((solo.size > 0 && !solo.has(layer.name)) || mute.has(layer.name)) return [0, 0, 0];
  const light = lightOf(layer.lights[0]), then = status.layers[i].edit;
  if (!light || !then) return [1, 1, 1];
  return ratio(strengthOf(state, light), strengthOf(then, light));
});

const view = () => {
  const [gain, gamma] = state.exposure ?? scene.exposure;
  const chosen = Number($("viewGamma").value);
  return { exposure: gain * 2 ** Number($("stops").value), gamma: gamma !== 1 ? gamma : chosen === 2.2 ? 0 : chosen, falseColor };
};

let asked = false;
const paint = () => {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    mixer.paint(weights(), view());
    performance.mark("painted");
    stage.showProbe();
  });
};

const stage = new Stage($("stage"), $("picture"), $("wipe"), {
  moved: (x, y) => post(`pointer?x=${x}&y=${y}`),
  at: (x, y) => mixer.at(x, y, weights()),
  layers: scene.layers,
  clicked: async (x, y) => {
    const found = await get(`object?x=${x}&y=${y}`);
    stage.say(found.object ? `${found.object}: ${found.shader}` : found.shader ?? "nothing");
    surfaces.choose(found.object);
  },
});

const whole = () => mixer.fresh(0, 0, scene.width, scene.height, false);
let sending = null, unsent = false;
const send = async () => {
  if (sending) return void (unsent = true);
  sending = postEdit();
  try {
    $("rib").textContent = (await sending).rib;
    if (exact) await post("ask");
  } catch (e) {
    note(e.message);
  }
  sending = null;
  if (unsent) unsent = false, send();
};

const refresh = () => { lights.refresh(state); surfaces.refresh(state); handles.place(); };
const show = () => {
  whole();
  paint();
  refresh();
  send();
};
const follow = (present) => {
  const followed = { ...copyOf(kNothing), ...present };
  if (JSON.stringify(followed) === JSON.stringify(state)) return;
  state = followed;
  whole();
  paint();
  refresh();
};
const change = (what, edit) => {
  if (watches()) return;
  performance.mark("changed");
  edit(state);
  history.keep(state, what);
  show();
};
const step = (by) => {
  if (watches()) return;
  state = history.step(by);
  show();
};

const panelTools = {
  value: (kind, shader, param) => valueOf(state, kind, shader, param),
  change: (kind, shader, param, value) =>
    change(`${kind} ${shader.owner} ${param.name}`, (s) => set(s, kind, shader, param, value)),
  toggle: (which, name) => {
    const marked = which === "solo" ? solo : mute;
    if (!marked.delete(name)) marked.add(name);
    whole();
    paint();
    lights.refresh(state);
  },
  isMarked: (which, name) => (which === "solo" ? solo : mute).has(name),
};
const lights = buildLights($("lights"), scene, panelTools);
const surfaces = buildSurfaces($("surfaces"), $("search"), scene, panelTools);
const handles = new Handles(stage, scene, panelTools);
$("handles").hidden = handles.all.length === 0;

const notes = new Set();
const note = (text, warns = true) => {
  if (!text || notes.has(text)) return;
  notes.add(text);
  const p = document.createElement("p");
  p.textContent = text, p.className = warns ? "warn" : "";
  $("notes").append(p);
};
if (!scene.sharesBounces)
  note("Bounced light is one layer: it does not follow the lights. tomales gather --by-light makes it follow.");
if (scene.imager) note("The scene's imager is left out here; shade runs it.", false);
if (mixer.isPlain) note("This browser has no WebGL2: the picture is mixed by JavaScript.", false);

const setExact = (on) => {
  exact = on;
  $("exact").classList.toggle("on", on);
  if (on) post("ask");
  else whole(), paint();
};
const setFalse = (on) => { falseColor = on; $("falseColor").classList.toggle("on", on); paint(); };
const setHandles = () => $("handles").classList.toggle("on", handles.toggle());
const setStops = () => {
  $("stopsText").textContent = Number($("stops").value).toFixed(2);
  const gamma = Number($("viewGamma").value);
  $("gammaText").textContent = gamma === 2.2 ? "sRGB" : gamma.toFixed(2);
  paint();
};

const keep = () => {
  const canvas = document.createElement("canvas");
  canvas.width = scene.width, canvas.height = scene.height;
  canvas.getContext("2d").drawImage($("picture"), 0, 0);
  const row = document.createElement("div"), name = document.createElement("input"), back = document.createElement("button");
  const kept = copyOf(state);
  row.className = "row", name.value = `snapshot ${$("snapshots").childElementCount + 1}`, back.textContent = "Back to it";
  name.setAttribute("aria-label", "Name of the snapshot");
  back.onclick = () => { state = copyOf(kept); history.keep(state); show(); };
  row.onclick = () => stage.compareWith(canvas);
  row.append(name, back);
  $("snapshots").append(row);
  stage.compareWith(canvas);
};

const listEdits = async () => $("edits").replaceChildren(...(await get("edits")).map((name) => new Option(name)));
$("save").onclick = async () => {
  try {
    if (!watches()) await postEdit();
    note(`Saved as ${(await post("save", { name: $("name").value })).file}`, false);
    await listEdits();
    $("edits").value = $("name").value;
  } catch (e) {
    note(e.message);
  }
};
$("load").onclick = async () => {
  try {
    const loaded = await post("load", { name: $("edits").value });
    state = { ...copyOf(kNothing), ...loaded };
    history.keep(state);
    show();
  } catch (e) {
    note(e.message);
  }
};

const actions = {
  undo: () => step(-1), redo: () => step(1), exact: () => setExact(!exact), falseColor: () => setFalse(!falseColor), handles: setHandles,
  fit: () => stage.fit(), snap: keep, help: () => { $("keys").hidden = !$("keys").hidden; },
  takeOver: () => postEdit("&take=1"),
  end: async () => { await post("end"); $("what").textContent = "ended"; },
};
for (const [id, action] of Object.entries(actions)) $(id).onclick = action;
$("stops").oninput = $("viewGamma").oninput = setStops;
$("keys").textContent = kKeys;

const brighten = (by) => { $("stops").value = Number($("stops").value) + by; setStops(); };
const keys = { z: actions.undo, Z: actions.redo, e: actions.exact, s: keep, w: () => stage.toggleWipe(), f: actions.fit,
  1: () => stage.oneToOne(), l: actions.falseColor, h: setHandles, ",": () => brighten(-0.5), ".": () => brighten(0.5), "?": actions.help };
document.addEventListener("keydown", (e) => {
  if (["INPUT", "SELECT"].includes(e.target.tagName) && e.target.type !== "range") return;
  if (e.altKey || ((e.ctrlKey || e.metaKey) && e.key.toLowerCase() !== "z")) return;
  if (keys[e.key]) keys[e.key](), e.preventDefault();
});

$("file").textContent = scene.file.split("/").pop();
await listEdits();
setStops();
stage.fit();

/** Is the whole picture that of what is shown now? */
const sorted = (edits) => Object.entries(edits).sort().map(([owner, params]) => [owner, Object.entries(params).sort()]);
const nameOf = (edit) => JSON.stringify([sorted(edit.lights), sorted(edit.surfaces)]);
const isPresent = (edit) => edit && nameOf(edit) === nameOf(state);

try {
  await listen((news, blocks) => {
    status = news;
    $("takeOver").hidden = !watches();
    if (watches()) follow(news.present);
    for (const block of blocks) {
      mixer.put(block);
      const first = status.layers.slice(1).some((l) => l.version === 0 || l.edit === null);
      if (block.layer === 0 && block.version === status.layers[0].version && solo.size === 0 && mute.size === 0 &&
        (exact || first) && isPresent(status.layers[0].edit))
        mixer.fresh(block.x, block.y, block.width, block.height, true);
    }
    const ready = status.layers.slice(1).every((l) => !l.old);
    if (ready && !exact && !document.body.dataset.ready) whole();
    if (ready) document.body.dataset.ready = "1";
    $("what").textContent = news.doing ? `${news.doing} ${Math.round(100 * news.done)} %` : "up to date";
    for (const name of news.notLinear) note(`${name}: light does not add up there; Exact shows it right.`);
    for (const message of news.messages) note(message);
    if (blocks.length > 0) paint();
  });
} catch {
  $("what").textContent = "the program has ended";
}
