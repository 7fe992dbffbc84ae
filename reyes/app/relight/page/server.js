// Questions to the program, relative to the address of the page, which holds the token.
const reply = async (answer) => {
  if (!answer.ok) throw new Error((await answer.text()) || answer.statusText);
  return answer;
};

export const get = async (path) => (await reply(await fetch(path))).json();
export const post = async (path, body = {}) =>
  (await reply(await fetch(path, { method: "POST", body: JSON.stringify(body) }))).json();

const kHeader = 8;  // numbers of a block's header (layers.h)

const blocksOf = (buffer, from) => {
  const out = [];
  for (let at = from; at < buffer.byteLength;) {
    const [layer, x, y, width, height, version, , step] = new Uint32Array(buffer, at, kHeader);
    at += 4 * kHeader;
    const numbers = 3 * Math.ceil(width / step) * Math.ceil(height / step);
    out.push({ layer, x, y, width, height, version, step, half: new Uint16Array(buffer, at, numbers) });
    at += Math.ceil((2 * numbers) / 4) * 4;
  }
  return out;
};

const kCoarse = 16;  // kCoarseStep (layers.h): the step of a coarse picture. Its finer blocks come later, as news.
const kWait_s = 0.4;  // news may take this long to arrive; what does not fit arrives coarser first
const kLeast_bytes = 50e3, kMost_bytes = 3e6, kTelling_bytes = 32e3;

/** The connection to the program: its rate in bytes per second, and the bytes received so far. */
export const link = { rate: 2e7, received: 0 };

/** Calls `tell(status, blocks)` with all that is new, until the program ends: coarse where the link is slow, and at full size
    when nothing newer waits. */
export const listen = async (tell) => {
  for (let seen = 0, fine = 0, newest = 0, told = 0; ;) {
    const bytes = Math.round(Math.min(Math.max(link.rate * kWait_s, kLeast_bytes), kMost_bytes));
    const refines = newest <= seen && fine < seen;
    const question = refines ? `news?after=${fine}&last=${seen}&bytes=${bytes}` : `news?after=${seen}&told=${told}&bytes=${bytes}`;
    const answer = await reply(await fetch(question)), begun = performance.now();
    const buffer = await answer.arrayBuffer(), seconds = Math.max(performance.now() - begun, 0.1) / 1000;
    link.received += buffer.byteLength;
    const rate = buffer.byteLength / seconds;  // a slow link is believed at once, a fast one by and by
    if (buffer.byteLength > kTelling_bytes) link.rate = rate < link.rate ? rate : 0.5 * (link.rate + rate);
    const length = new Uint32Array(buffer, 0, 1)[0];
    const status = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    const blocks = blocksOf(buffer, 4 + length);
    newest = status.newest;
    told = status.told;
    if (refines) fine = status.after;
    else if (fine === seen && blocks.every((b) => b.step === 1 || b.step === kCoarse)) fine = seen = status.after;
    else seen = status.after;
    tell(status, blocks);
  }
};

