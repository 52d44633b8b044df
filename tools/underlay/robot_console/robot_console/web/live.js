// A page that connects while it is visible, is told what is new, and comes back by itself.
const settings = /* settings */ {};
const show = (id) => document.getElementById(id);
const HIDDEN_MS = 3000;
/* person.js */

class Feed {
  // `onNews` takes what comes; `onOpen` asks anew for what was chosen before.
  constructor(onNews, onOpen = () => {}) {
    this.onNews = onNews;
    this.onOpen = onOpen;
    this.seenAt = -Infinity;
    this.triedAt = -Infinity;
    this.isOpen = false;
    this.banner = element('div', { id: 'lost', hidden: true });
    this.banner.textContent = 'No connection to the program behind this page. Reconnecting ...';
    document.body.prepend(this.banner);
    setInterval(() => this.watch(), 150);
  }

  watch() {
    const now = performance.now();
    const isVisible = this.isVisible();
    if (isVisible) this.seenAt = now;
    if (isVisible && !this.wasVisible) fit();
    this.wasVisible = isVisible;
    if (now - this.seenAt > HIDDEN_MS) this.rest();
    else if (isVisible && !this.socket && now - this.triedAt > 1000) this.connect(now);
  }

  isVisible() {
    const frame = window.frameElement;
    return document.visibilityState === 'visible' && (!frame || frame.getClientRects().length > 0);
  }

  connect(now) {
    this.triedAt = now;
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    const socket = new WebSocket(`${scheme}://${location.host}${location.pathname}?me=${me}`);
    socket.onopen = () => { this.tell(true); this.onOpen(); };
    socket.onmessage = (event) => { if (socket === this.socket) this.onNews(JSON.parse(event.data)); };
    socket.onclose = () => {
      if (socket !== this.socket) return;
      this.socket = null;
      this.tell(false);
    };
    this.socket = socket;
  }

  rest() {
    const socket = this.socket;
    this.socket = null;
    socket?.close();
  }

  tell(isOpen) {
    this.banner.hidden = isOpen;
    document.body.classList.toggle('lost', !isOpen);
  }

  // Asks for something; returns whether that is on its way.
  ask(what, values = {}) {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify({ do: what, ...values }));
    return true;
  }
}

// Makes an element; texts get into it as texts, whatever is in them.
function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children.filter((each) => each !== null && each !== ''));
  return made;
}

function put(id, text, kind = null) {
  const target = show(id);
  if (target.textContent !== text) target.textContent = text;
  if (kind !== null) target.className = kind;
}

// Shows the parts of a text that has been searched for in all of its words.
function matches(text, words) {
  const lower = text.toLowerCase();
  return words.every((word) => lower.includes(word));
}
const wordsOf = (text) => text.toLowerCase().split(/\s+/).filter(Boolean);

const keyOf = (item) => item.title || item.querySelector('.name')?.textContent;

// Gives a list other items; what has the focus keeps it, or the item of the same name gets it.
function fill(list, items, empty) {
  const children = items.length ? items : [element('div', { className: 'empty', textContent: empty })];
  const focused = list.contains(document.activeElement) ? document.activeElement : null;
  list.replaceChildren(...children);
  if (!focused || focused === document.activeElement) return;
  const key = keyOf(focused);
  const next = focused.isConnected ? focused : children.find((each) => key && keyOf(each) === key);
  next?.focus({ preventScroll: true });
}

// The frame around takes the room that is left below what is above it; that of a slim page is as high as what is in it.
function fit() {
  const frame = window.frameElement;
  if (!frame) return;
  if (document.body.classList.contains('slim')) {
    frame.style.height = `${Math.ceil(document.body.getBoundingClientRect().height)}px`;
    return;
  }
  const room = window.parent.innerHeight;
  const free = room - Math.max(frame.getBoundingClientRect().top, 60) - 16;
  frame.style.height = `${Math.round(Math.max(440, Math.min(free, room - 60)))}px`;
}
window.parent.addEventListener('resize', fit);

const age = (s) => (s < 10 ? `${s.toFixed(1)} s` : s < 100 ? `${Math.round(s)} s` : `${Math.round(s / 60)} min`);
