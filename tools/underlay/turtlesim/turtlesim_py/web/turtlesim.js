// SPDX-License-Identifier: Apache-2.0
'use strict';

const show = (id) => document.getElementById(id);
const canvas = show('field');
const pen = canvas.getContext('2d');
let trails = document.createElement('canvas');
let ink = trails.getContext('2d');
const state = { name: 'turtlesim', field: 1, side: 1, background: [44, 46, 51], turtles: [] };

// ---- What the program tells

async function take(news) {
  if (news.refusal) return refuse(news.refusal);
  if (news.turtles) walk(news.turtles);
  const { image, lines, ...rest } = news;
  Object.assign(state, rest);
  if (image !== undefined) await restore(image);
  for (const line of lines ?? []) stroke(line);
  if (news.turtles || news.name) describe();
  paintSoon();
}

// Replaces the trails by an image, or by nothing.
async function restore(image) {
  trails = document.createElement('canvas');
  trails.width = trails.height = state.side;
  ink = trails.getContext('2d');
  if (!image) return;
  const bytes = Uint8Array.from(atob(image), (each) => each.charCodeAt(0));
  ink.drawImage(await createImageBitmap(new Blob([bytes], { type: 'image/png' })), 0, 0);
}

function stroke([colour, width, points]) {
  ink.strokeStyle = `rgb(${colour})`;
  ink.lineWidth = width;
  ink.lineCap = ink.lineJoin = 'round';
  ink.beginPath();
  for (let i = 0; i < points.length; i += 2) ink.lineTo(points[i], points[i + 1]);
  ink.stroke();
}

function describe() {
  document.title = show('name').textContent = state.name.slice(1) || state.name;
  const rows = state.turtles.map(([name, number, x, y, theta]) => {
    const row = document.createElement('tr');
    const mark = document.createElement('i');
    mark.style.background = coloursOf(number).shell;
    row.append(...[name, x.toFixed(2), y.toFixed(2), theta.toFixed(2)].map((text) => {
      const cell = document.createElement('td');
      cell.textContent = text;
      return cell;
    }));
    row.firstChild.prepend(mark);
    row.firstChild.title = name;
    return row;
  });
  show('turtles').replaceChildren(...rows);
}

// ---- How turtles look

const COLOURS = [
  { shell: '#37b24d', rim: '#1f6e2e', skin: '#a9e34b' }, { shell: '#f76707', rim: '#a63e00', skin: '#ffe066' },
  { shell: '#be4bdb', rim: '#702a85', skin: '#fcc2d7' }, { shell: '#15aabf', rim: '#0b5f6e', skin: '#96f2d7' },
  { shell: '#f03e3e', rim: '#931f1f', skin: '#ffd8a8' }, { shell: '#fab005', rim: '#a36200', skin: '#d8f5a2' },
  { shell: '#868e96', rim: '#495057', skin: '#e9ecef' }, { shell: '#e64980', rim: '#8a1f4a', skin: '#c3fae8' },
];
const coloursOf = (number) => COLOURS[(number - 1) % COLOURS.length];
const LEGS = [[0.2, 1, 0.55], [-0.2, 1, 2.35], [0.2, -1, -0.55], [-0.2, -1, -2.35]];
const walked = new Map();

// Legs move with the way of a turtle; one that is elsewhere at once has not walked there.
function walk(turtles) {
  for (const [name, , x, y, theta] of turtles) {
    const before = state.turtles.find((each) => each[0] === name);
    const way = before ? Math.hypot(x - before[2], y - before[3]) + 0.5 * Math.abs(Math.sin((theta - before[4]) / 2)) : 0;
    walked.set(name, (walked.get(name) ?? 0) + (way < 0.5 ? way : 0));
  }
}

function ellipse(x, y, width, height, angle, fill) {
  pen.beginPath();
  pen.ellipse(x, y, width, height, angle, 0, 2 * Math.PI);
  pen.fillStyle = fill;
  pen.fill();
}

function outline(points, fill) {
  pen.beginPath();
  for (const [x, y] of points) pen.lineTo(x, y);
  pen.closePath();
  if (fill) { pen.fillStyle = fill; pen.fill(); }
  pen.stroke();
}

// The turtle is one unit long; it looks to the right, and left of it is up.
function paintTurtle([name, number, x, y, theta], scale) {
  const { shell, rim, skin } = coloursOf(number);
  const swing = 0.35 * Math.sin(12 * (walked.get(name) ?? 0));
  pen.save();
  pen.translate(x * scale, (state.field - y) * scale);
  pen.rotate(-theta);
  pen.scale(scale, scale);
  pen.shadowColor = 'rgb(0 0 0 / .35)';
  pen.shadowBlur = 0.08 * scale;
  pen.shadowOffsetY = 0.03 * scale;
  for (const [along, side, angle] of LEGS) {
    const turn = angle + swing * side * Math.sign(along);
    ellipse(along + 0.1 * Math.cos(turn), 0.2 * side + 0.13 * Math.sin(turn), 0.17, 0.085, turn, skin);
  }
  pen.strokeStyle = pen.fillStyle = skin;
  pen.lineWidth = 0.04;
  pen.lineJoin = 'round';
  outline([[-0.3, -0.07], [-0.3, 0.07], [-0.5, 0.02 + swing / 12]], skin);
  ellipse(0.4, 0, 0.145, 0.12, 0, skin);
  ellipse(0, 0, 0.36, 0.295, 0, rim);
  pen.shadowColor = 'transparent';
  ellipse(0, 0, 0.31, 0.245, 0, shell);
  for (const side of [-1, 1]) ellipse(0.46, 0.065 * side, 0.024, 0.024, 0, '#212529');
  pen.strokeStyle = rim;
  pen.lineWidth = 0.028;
  const corners = [0, 1, 2, 3, 4, 5].map((each) => [0.15 * Math.cos(each * Math.PI / 3), 0.12 * Math.sin(each * Math.PI / 3)]);
  outline(corners);
  for (const [a, b] of corners) outline([[a, b], [2.05 * a, 2.05 * b]]);
  pen.restore();
}

function paintName([name, , x, y], scale) {
  const size = Math.max(11 * devicePixelRatio, 0.2 * scale);
  pen.font = `600 ${size}px system-ui, "DejaVu Sans", sans-serif`;
  const half = pen.measureText(name).width / 2 + 0.5 * size;
  const atX = Math.min(Math.max(x * scale, half), canvas.width - half);
  const above = (state.field - y) * scale - 0.75 * scale;
  const atY = above > size ? above : above + 1.5 * scale;
  pen.fillStyle = 'rgb(0 0 0 / .45)';
  pen.beginPath();
  pen.roundRect(atX - half, atY - 0.75 * size, 2 * half, 1.5 * size, 0.75 * size);
  pen.fill();
  pen.fillStyle = '#fff';
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  pen.fillText(name, atX, atY);
}

let isPainting = false;
function paintSoon() {
  if (isPainting) return;
  isPainting = true;
  requestAnimationFrame(() => { isPainting = false; paint(); });
}

function paint() {
  const scale = canvas.width / state.field;
  pen.fillStyle = `rgb(${state.background})`;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.imageSmoothingQuality = 'high';
  pen.drawImage(trails, 0, 0, canvas.width, canvas.height);
  for (const turtle of state.turtles) paintTurtle(turtle, scale);
  if (state.turtles.length > 1) for (const turtle of state.turtles) paintName(turtle, scale);
}

new ResizeObserver(() => {
  canvas.width = canvas.height = Math.max(1, Math.round(canvas.clientWidth * devicePixelRatio));
  paint();
}).observe(show('stage'));

// ---- The connection

let socket = null;
let isAsking = false;
let taken = Promise.resolve();

function connect() {
  const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
  const mine = new WebSocket(`${scheme}://${location.host}${location.pathname}`);
  socket = mine;
  mine.onopen = () => tell('');
  // One after the other: an image takes a moment.
  mine.onmessage = (event) => { taken = taken.then(() => mine === socket && take(JSON.parse(event.data))); };
  mine.onclose = () => {
    if (mine !== socket) return;
    socket = null;
    tell('The program behind this page has ended, or cannot be reached. Connecting again ...');
  };
}

// A browser is not told why a connection was refused, only why a page was.
async function connectAgain() {
  if (document.hidden || socket || isAsking) return;
  isAsking = true;
  const answer = await fetch(location.pathname, { cache: 'no-store' }).catch(() => null);
  isAsking = false;
  if (answer?.ok) connect();
  else if (answer) tell('turtlesim was started again, and has another address: open the one that it has printed.');
}

function tell(trouble) {
  show('lost').textContent = trouble;
  show('lost').hidden = !trouble;
  show('dot').classList.toggle('good', !trouble);
  if (trouble) letGo();
}

// Nobody sees a page that is hidden, and browsers may forget what is drawn there.
document.addEventListener('visibilitychange', () => {
  if (!document.hidden) return connectAgain();
  letGo();
  socket?.close();
  socket = null;
});
setInterval(connectAgain, 1000);

// ---- Keys

const PERIOD_MS = 100;
const held = new Set();
let timer = null;
let refusal = '';

function drive() {
  const share = (more, less) => Number(held.has(more)) - Number(held.has(less));
  const message = { do: 'drive', forward: share('ArrowUp', 'ArrowDown'), turn: share('ArrowLeft', 'ArrowRight') };
  if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
}

// Sends what is held, again and again, and once that nothing is.
function change() {
  if (held.size > 0) timer ??= setInterval(drive, PERIOD_MS);
  else if (timer === null) return;
  else timer = clearInterval(timer) ?? null;
  refusal = '';
  drive();
  for (const button of document.querySelectorAll('[data-key]')) button.classList.toggle('held', held.has(button.dataset.key));
  hint();
}

function letGo() {
  held.clear();
  change();
}

function refuse(sentence) {
  refusal = `${sentence}.`;
  hint();
}

function hint() {
  const keys = document.hasFocus() ? 'The arrow keys drive turtle1.' : 'Click here to drive turtle1 with the arrow keys.';
  show('hint').textContent = refusal || keys;
  show('hint').classList.toggle('warn', Boolean(refusal));
}

// Enter and the space bar hold the button that has the focus.
const keyOf = (event) => (['Enter', ' '].includes(event.key) && event.target.dataset?.key) || event.key;

addEventListener('keydown', (event) => {
  const key = keyOf(event);
  if (!key.startsWith('Arrow') || event.ctrlKey || event.altKey || event.metaKey) return;
  event.preventDefault();
  if (event.repeat) return;
  held.add(key);
  change();
});
addEventListener('keyup', (event) => { if (held.delete(keyOf(event))) change(); });
for (const button of document.querySelectorAll('[data-key]')) {
  button.addEventListener('pointerdown', (event) => {
    button.setPointerCapture(event.pointerId);
    held.add(button.dataset.key);
    change();
  });
  for (const type of ['pointerup', 'pointercancel', 'lostpointercapture']) {
    button.addEventListener(type, () => { if (held.delete(button.dataset.key)) change(); });
  }
}
for (const type of ['blur', 'pagehide']) addEventListener(type, letGo);
for (const type of ['focus', 'blur']) addEventListener(type, hint);
hint();
connectAgain();
