// The connection with the robot's side: signs of life, answers, and whether there are any.
const settings = /* settings */ {};
const show = (id) => document.getElementById(id);
const LOST_MS = 800;
const BUSY_MS = 100;
const outer = window.parent;
/* person.js */

class Link {
  // `beat` returns the sign of life: a page that moves the robot goes on with that.
  constructor(path, onState, onConnection, beat = () => ({ do: 'beat' })) {
    this.path = path;
    this.onState = onState;
    this.onConnection = onConnection;
    this.beat = beat;
    this.periodMs = 250;
    this.isAlive = false;
    this.heardAt = -Infinity;
    this.silentMs = 0;
    this.watchedAt = performance.now();
    this.sentAt = 0;
    this.triedAt = -Infinity;
    setInterval(() => this.watch(), 50);
  }

  connect(now) {
    this.triedAt = now;
    this.socket?.close();
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    const socket = new WebSocket(`${scheme}://${location.host}${this.path}?me=${me}`);
    socket.onopen = () => this.send(this.beat());
    socket.onmessage = (event) => { if (socket === this.socket) this.hear(JSON.parse(event.data)); };
    this.socket = socket;
  }

  // Returns whether it is on its way.
  send(message) {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.sentAt = performance.now();
    this.socket.send(JSON.stringify(message));
    return true;
  }

  hear(state) {
    this.heardAt = performance.now();
    this.silentMs = 0;
    this.onState(state);
    this.tell(true);
  }

  watch() {
    const frame = window.frameElement;
    if (!this.socket && frame && !frame.getClientRects().length) return; // it has not been shown yet
    const now = performance.now();
    // What came while this page was busy has not been heard yet: that is no silence.
    this.silentMs += Math.min(now - this.watchedAt, BUSY_MS);
    this.watchedAt = now;
    if (this.silentMs > LOST_MS) this.tell(false);
    const isClosed = (this.socket?.readyState ?? WebSocket.CLOSED) >= WebSocket.CLOSING;
    const tryMs = isClosed ? 500 : 3000;
    if ((isClosed || now - this.heardAt > 3000) && now - this.triedAt > tryMs) this.connect(now);
    const isFree = this.socket.bufferedAmount === 0;
    if (isFree && now - this.sentAt >= this.periodMs - 10) this.send(this.beat());
  }

  tell(isAlive) {
    if (isAlive === this.isAlive && this.told) return;
    this.isAlive = isAlive;
    this.told = true;
    this.onConnection(isAlive);
  }
}

// Writes a text where it has changed.
function put(id, text, kind = '') {
  const element = show(id);
  if (element.textContent !== text) element.textContent = text;
  element.className = element.className.replace(/\b(dim|warn|bad)\b/g, '').trim() + (kind ? ` ${kind}` : '');
}

// The frame around is as high as what is in it.
new ResizeObserver(() => {
  if (window.frameElement) window.frameElement.style.height = `${document.body.offsetHeight}px`;
}).observe(document.body);
