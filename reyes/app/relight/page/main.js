import { get, post, listen } from "./server.js";
import { History, copyOf, nameOf, prepare, strengthOf, whole as wholeOf } from "./edit.js";
import { kTransforms } from "./color.js";
import { Mixer } from "./mixer.js";
import { Stage } from "./stage.js";
import { Handles } from "./handles.js";
import { Snapshots } from "./snapshots.js";
import { Work } from "./work.js";
import { buildImager, buildLights, buildObjects } from "./panel.js";

const $ = (id) => document.getElementById(id);
const kKeys = `Z, Shift+Z   undo, redo
E            exact picture, or the mix
S            keep a snapshot
W            wipe against the snapshot
F, 1         fit, one to one
L            false colours
H            points of lights, to be dragged; with Shift in depth
R            shade a region alone; again: all
G            gather bounced light of the region or the view
A            how old is what is seen
drag, wheel  pan, zoom
click        choose the object there
,  .         darker, brighter
/            search`;
const kPause_ms = 250;
/** Least time between two paintings of what the program sends. Each takes time of the processors that shade the rest. */
const kNews_ms = 250;

$("end").onclick = async () => { await post("end"); $("what").textContent = "ended"; };
for (let p; !(p = await get("preparation")).ready; await new Promise((then) => setTimeout(then, kPause_ms))) {
  $("preparing").firstChild.textContent = p.doing || "reading";
  $("preparing").lastChild.value = p.done;
}
const scene = await get("scene").catch((e) => { $("preparing").textContent = e.message; throw e; });
$("preparing").remove();

const mixer = new Mixer($("picture"), scene.width, scene.height, scene.layers.length, location.search.slice(1));
await prepare(scene.present);
let state = wholeOf(scene.present);
const history = new History(state);
let status = { layers: scene.layers.map(() => ({ version: 0, unit: [1, 1, 1], old: true, left: 1 })), variable: {}, gathered: [], present: scene.present };
let exact = false, falseColor = false, region = null;
/** Several pages may watch; one edits, until another takes over. */
const page = 1 + Math.floor(Math.random() * 999999998);
const watches = () => Boolean(status.editor) && status.editor !== page;
addEventListener("pagehide", () => navigator.sendBeacon(`leave?page=${page}`));
const postEdit = (more = "") => post(`edit?page=${page}${more}`, state);
/** Lights that are shown alone, and lights that are hidden. They change the view and are no part of the edit. */
const solo = new Set(), mute = new Set();

const notes = new Set();
const note = (text, warns = true) => {
  if (!text || notes.has(text)) return;
  notes.add(text);
  const p = document.createElement("p");
  p.textContent = text;
  p.className = warns ? "warn" : "";
  $("notes").append(p);
};
const guarded = (action) => async (...given) => { try { await action(...given); } catch (e) { note(e.message); } };

/** Returns the factor on each layer in the picture: the colour that its light sends now over the one it was shaded with. */
const weights = () => scene.layers.map((layer, i) => {
  if (i === 0) return [1, 1, 1];
  if ((solo.size > 0 && !solo.has(layer.name)) || mute.has(layer.name)) return [0, 0, 0];
  if (layer.lights.length !== 1) return [1, 1, 1];
  const { unit } = status.layers[i];
  return strengthOf(state, scene.lights.find((l) => l.owner === layer.lights[0])).map((c, k) => c / unit[k]);
});

let range = null;
const view = () => {
  const [gain, gamma] = state.exposure ?? scene.exposure;
  const chosen = Number($("viewGamma").value), stops = 2 ** Number($("stops").value);
  return { exposure: gain * stops, wholeExposure: status.imager ? stops : gain * stops, gamma: gamma !== 1 ? gamma : chosen === 2.2 ? 0 : chosen,
    transform: $("transform").selectedIndex, falseColor, range: $("shown").value ? range ?? [0, 1] : null };
};

let asked = false, hasNews = false, isFirst = true, shownNews_ms = -kNews_ms, later = null;
const paint = () => {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    mixer.paint(weights(), view());
    performance.mark("painted");
    if (hasNews) {
      performance.mark("shown");
      shownNews_ms = performance.now();
      work.show(status);
    }
    hasNews = false;
    stage.showProbe();
  });
};

/** Asks paintNews() to paint the first news of the next edit at once. */
const expectFirst = () => { isFirst = true; };
/** Paints received news: at once if they are the first of the present edit or the last, and otherwise every kNews_ms. */
const paintNews = (isPresent, isLast) => {
  const wait_ms = isLast || (isFirst && isPresent) ? 0 : shownNews_ms + kNews_ms - performance.now();
  if (isPresent) isFirst = false;
  if (wait_ms <= 0) return paint();
  later ??= setTimeout(() => { later = null; paint(); }, wait_ms);
};

const stage = new Stage($("stage"), $("picture"), $("wipe"), {
  moved: (x, y) => post(`pointer?x=${x}&y=${y}`),
  at: (x, y) => {
    const variable = $("shown").value;
    const shown = variable ? `${variable}: ${mixer.colorAt(mixer.variable, x, y).map((v) => v.toPrecision(4)).join("  ")}` : "";
    return { ...mixer.at(x, y, weights()), more: [shown, work.at(x, y)].filter(Boolean).join("\n") };
  },
  layers: scene.layers,
  clicked: async (x, y) => {
    const found = await get(`object?x=${x}&y=${y}`);
    stage.say(found.object ? `${found.object}: ${found.shader}` : found.shader ?? "nothing");
    objects.choose(found.object);
  },
});
const work = new Work($("work"), $("ages"), stage, mixer, scene);

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
  if (unsent) {
    unsent = false;
    send();
  }
};

const refresh = () => { for (const shown of [lights, objects, imager]) shown.refresh(); handles.place(); };
const show = () => { expectFirst(); hasNews = false; whole(); paint(); refresh(); send(); };
const follow = async (present) => {
  if (nameOf(present) === nameOf(state)) return;
  await prepare(present);
  state = wholeOf(present);
  whole();
  paint();
  refresh();
};
const changed = (what) => { performance.mark("changed"); history.keep(state, what); show(); };
const become = (next) => { state = wholeOf(next); changed(); };
const step = (by) => {
  if (watches()) return;
  state = history.step(by);
  show();
};

const tools = {
  note, state: () => state,
  change: (what, edit) => { if (!watches()) edit(state), changed(what); },
  changeLater: async (what, edit) => {
    if (watches()) return;
    const next = copyOf(state);
    await edit(next);
    become(next);
  },
  toggle: (which, name) => {
    const marked = which === "solo" ? solo : mute;
    if (!marked.delete(name)) marked.add(name);
    whole();
    paint();
    lights.refresh();
  },
  isMarked: (which, name) => (which === "solo" ? solo : mute).has(name),
};
const lights = buildLights($("lights"), scene, tools), objects = buildObjects($("surfaces"), scene, tools), imager = buildImager($("imager"), scene, tools);
const handles = new Handles(stage, scene, tools);
const snapshots = new Snapshots($("snapshots"), stage, { picture: () => $("picture"), back: (kept) => { if (!watches()) become(copyOf(kept)); } });
$("handles").hidden = handles.all.length === 0;
if (!scene.sharesBounces)
  note("Bounced light is one layer: it does not follow the lights. tomales gather --by-light makes it follow.");
if (mixer.isPlain) note("This browser has no GPU for WebGL2: the picture is mixed by JavaScript.", false);

const setExact = (on) => {
  exact = on;
  $("exact").classList.toggle("on", on);
  expectFirst();
  if (on) post("ask");
  else { whole(); paint(); }
};
const setFalse = (on) => { falseColor = on; $("falseColor").classList.toggle("on", on); paint(); };
const setStops = () => {
  $("stopsText").textContent = Number($("stops").value).toFixed(2);
  const gamma = Number($("viewGamma").value);
  $("gammaText").textContent = gamma === 2.2 ? "sRGB" : gamma.toFixed(2);
  paint();
};
const showVariable = guarded(async () => { expectFirst(); await post(`variable?name=${encodeURIComponent($("shown").value)}`); paint(); });

const asQuestion = ({ x, y, width, height }) => `&x=${x}&y=${y}&width=${width}&height=${height}`;
const setRegion = guarded(async (chosen, isDone) => {
  region = chosen;
  $("chosen").hidden = !chosen;
  if (chosen) stage.cover($("chosen"), chosen);
  if (!isDone) return;
  $("region").classList.toggle("on", Boolean(chosen));
  await post(`only?page=${page}${chosen ? asQuestion(chosen) : ""}`);
});
stage.whenPlaced(() => region && stage.cover($("chosen"), region));
const toggleRegion = () => {
  if (region) return setRegion(null, true);
  $("region").classList.add("on");
  stage.askForRegion(setRegion);
};
const gather = guarded(async () => { expectFirst(); await post(`gather?page=${page}${asQuestion(region ?? stage.inView())}`); });

const listEdits = async () => $("edits").replaceChildren(...(await get("edits")).map((name) => new Option(name)));
$("save").onclick = guarded(async () => {
  if (!watches()) await postEdit();
  const saved = await post("save", { name: $("name").value });
  note(`Saved as ${saved.file}${saved.irradiance ? `, for --irradiance ${saved.irradiance}` : ""}`, false);
  await listEdits();
  $("edits").value = $("name").value;
});
$("load").onclick = guarded(async () => {
  const loaded = await post("load", { name: $("edits").value });
  await prepare(loaded);
  become(loaded);
});

const actions = {
  undo: () => step(-1), redo: () => step(1), exact: () => setExact(!exact), falseColor: () => setFalse(!falseColor),
  handles: () => $("handles").classList.toggle("on", handles.toggle()), region: toggleRegion, gather,
  age: () => $("age").classList.toggle("on", work.toggle()), fit: () => stage.fit(), snap: () => snapshots.keep(copyOf(state)),
  help: () => { $("keys").hidden = !$("keys").hidden; }, takeOver: () => postEdit("&take=1"),
};
for (const [id, action] of Object.entries(actions)) $(id).onclick = action;
$("stops").oninput = $("viewGamma").oninput = setStops;
$("transform").append(...kTransforms.map((name) => new Option(name)));
$("transform").onchange = paint;
$("shown").append(...scene.variables.map((name) => new Option(name, name)));
$("shown").onchange = showVariable;
$("search").oninput = () => { for (const cards of [lights, objects]) cards.search($("search").value.toLowerCase()); };
$("keys").textContent = kKeys;

const brighten = (by) => { $("stops").value = Number($("stops").value) + by; setStops(); };
const keys = { z: actions.undo, Z: actions.redo, e: actions.exact, s: actions.snap, w: () => stage.toggleWipe(), f: actions.fit,
  1: () => stage.oneToOne(), l: actions.falseColor, h: actions.handles, r: toggleRegion, g: gather, a: actions.age,
  ",": () => brighten(-0.5), ".": () => brighten(0.5), "?": actions.help, "/": () => $("search").focus() };
document.addEventListener("keydown", (e) => {
  if (["INPUT", "SELECT"].includes(e.target.tagName) && !["range", "checkbox"].includes(e.target.type)) return;
  if (e.altKey || ((e.ctrlKey || e.metaKey) && e.key.toLowerCase() !== "z")) return;
  if (keys[e.key]) {
    keys[e.key]();
    e.preventDefault();
  }
});

$("file").textContent = scene.file.split("/").pop();
await listEdits();
setStops();
stage.fit();

const showNews = async (news, blocks) => {
  if (!news.doing && status.doing) mixer.settle();
  status = news;
  $("takeOver").hidden = !watches();
  if (watches()) await follow(news.present);
  const isPresent = nameOf(news.present) === nameOf(state), first = !document.body.dataset.ready;
  for (const block of blocks) {
    mixer.put(block);
    if (block.layer === 0 && block.version === news.layers[0].version && isPresent && solo.size === 0 && mute.size === 0 && (exact || first))
      mixer.fresh(block.x, block.y, block.width, block.height, true);
  }
  const ready = news.layers.slice(1).every((l) => !l.old);
  if (ready && !exact && first) whole();
  if (ready) document.body.dataset.ready = "1";
  if (blocks.some((b) => b.layer === mixer.variable)) range = mixer.rangeOfVariable();
  $("what").textContent = news.doing ? `${news.doing} ${Math.round(100 * news.done)} %` : "up to date";
  $("stale").hidden = news.stale.length === 0;
  $("stale").textContent = `Bounced light of ${news.stale.join(", ")} is as it was gathered. Gather (G) makes it anew where you look.`;
  $("gather").disabled = news.gathering;
  for (const name of news.notLinear) note(`${name}: light does not add up there; Exact shows it right.`);
  for (const message of news.messages) note(message);
  hasNews ||= blocks.length > 0;
  if (hasNews) paintNews(isPresent, !news.doing);
  else work.show(news);
};
try {
  await listen(showNews);
} catch (e) {
  $("what").textContent = "the program has ended";
  if (!(e instanceof TypeError)) note(e.message);
}
