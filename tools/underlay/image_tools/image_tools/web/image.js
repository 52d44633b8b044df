// SPDX-License-Identifier: Apache-2.0
'use strict';

const show = (id) => document.getElementById(id);
const canvas = show('picture');
const pen = canvas.getContext('2d');

async function take(news) {
  if (news.title) document.title = show('title').textContent = news.title;
  if (news.image === undefined) return;
  show('about').textContent = news.about;
  tell(news.fault);
  if (news.image) await draw(news.image);
  // The next image comes when this one is drawn, so that none has to wait.
  socket?.send(JSON.stringify({ do: 'next' }));
}

async function draw(image) {
  const bytes = Uint8Array.from(atob(image), (each) => each.charCodeAt(0));
  const picture = await createImageBitmap(new Blob([bytes], { type: 'image/jpeg' }));
  if (canvas.width !== picture.width) canvas.width = picture.width;
  if (canvas.height !== picture.height) canvas.height = picture.height;
  pen.drawImage(picture, 0, 0);
  picture.close();
}

function tell(trouble) {
  show('trouble').textContent = trouble;
  show('trouble').hidden = !trouble;
}

// ---- The connection

let socket = null;
let isAsking = false;
let taken = Promise.resolve();

function connect() {
  const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
  const mine = new WebSocket(`${scheme}://${location.host}${location.pathname}`);
  socket = mine;
  mine.onopen = () => tell('No image has come yet.');
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
  else if (answer) tell('The program was started again, and has another address: open the one that it has printed.');
}

// Nobody sees a page that is hidden.
document.addEventListener('visibilitychange', () => {
  if (!document.hidden) return connectAgain();
  socket?.close();
  socket = null;
});
setInterval(connectAgain, 1000);
connectAgain();
