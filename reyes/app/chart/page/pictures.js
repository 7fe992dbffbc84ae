// Gives all pictures the exposure that the slider asks for, and shows two that take turns in one place.
addEventListener('DOMContentLoaded', () => {
  const id = name => document.getElementById(name), white = Number(id('viewer').dataset.white);
  const pictures = [...document.querySelectorAll('.picture[data-name]')];
  let side = 'a';
  function show() {
    const picture = pictures[id(side).value];
    id('shown').src = picture.src;
    id('which').textContent = `${side.toUpperCase()}: ${picture.dataset.name}`;
  }
  function flip() {
    side = side == 'a' ? 'b' : 'a';
    show();
  }
  function expose() {
    const stops = Number(id('stops').value);
    id('stopped').textContent = stops;
    for (const channel of document.querySelectorAll('#exposure feComponentTransfer *')) channel.setAttribute('slope', white * 2 ** stops);
  }
  for (const s of ['a', 'b']) {
    pictures.forEach((picture, i) => id(s).add(new Option(picture.dataset.name, i)));
    id(s).onchange = () => {
      side = s;
      show();
    };
  }
  id('b').selectedIndex = Math.min(1, pictures.length - 1);
  id('flip').onclick = id('shown').onclick = flip;
  id('stops').oninput = expose;
  document.addEventListener('keydown', event => {
    if (event.key == 'f' && !event.ctrlKey) flip();
  });
  expose();
  show();
});
