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
    const [layer, x, y, width, height, version] = new Uint32Array(buffer, at, kHeader);
    at += 4 * kHeader;
    const numbers = 3 * width * height;
    out.push({ layer, x, y, width, height, version, half: new Uint16Array(buffer, at, numbers) });
    at += Math.ceil((2 * numbers) / 4) * 4;
  }
  return out;
};

/** Calls `tell(status, blocks)` with all that is new, until the program ends. */
export const listen = async (tell) => {
  for (let after = 0; ;) {
    const buffer = await (await reply(await fetch(`news?after=${after}`))).arrayBuffer();
    const length = new Uint32Array(buffer, 0, 1)[0];
    const status = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    after = status.after;
    tell(status, blocksOf(buffer, 4 + length));
  }
};
