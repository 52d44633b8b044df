// The stick and the keys that drive a robot, with a connection of their own.
const KEYS = {
  KeyW: [0, 1], ArrowUp: [0, 1], KeyS: [0, -1], ArrowDown: [0, -1],
  KeyA: [2, 1], ArrowLeft: [2, 1], KeyD: [2, -1], ArrowRight: [2, -1], KeyQ: [1, 1], KeyE: [1, -1],
};
const PERIOD_MS = 50;
const DEAD = 0.08;
const KNOB = 27;

function startDrive(settings, path) {
  const down = new Set();
  const sides = { left: false, right: false };
  const stick = { pointer: null, forward: 0, turn: 0 };
  let presses = 0;
  let timer = null;
  let state = null;

  const link = new Link(path, (next) => { state = next; draw(); }, (isAlive) => { if (!isAlive) letGo(); draw(); },
    () => (timer === null ? { do: 'beat' } : command()));
  const isHeld = () => stick.pointer !== null || down.size > 0 || sides.left || sides.right;

  // Forward, left and turn to the left, each from -1 to 1.
  function wanted() {
    const axes = [stick.forward, Number(sides.left) - Number(sides.right), stick.turn];
    for (const code of down) axes[KEYS[code][0]] += KEYS[code][1];
    return axes.map((each) => Math.max(-1, Math.min(1, each)));
  }

  function command() {
    const share = [show('move').value / 100, show('turn').value / 100];
    return { do: 'drive', press: `${me}${performance.timeOrigin}/${presses}`, stick: wanted(), share };
  }

  function say() {
    link.send(command());
  }

  // Begins to drive with the first thing that is held, and ends with the last one.
  function change() {
    if (isHeld() && timer === null) {
      presses += 1;
      timer = setInterval(say, PERIOD_MS);
    } else if (!isHeld() && timer !== null) {
      clearInterval(timer);
      timer = null;
      link.send({ do: 'halt' });
    }
    if (timer !== null) say();
    draw();
  }

  function letGo() {
    down.clear();
    sides.left = sides.right = false;
    Object.assign(stick, { pointer: null, forward: 0, turn: 0 });
    change();
  }

  function move(event) {
    if (event.pointerId !== stick.pointer) return;
    const box = show('stick').getBoundingClientRect();
    let x = (event.clientX - box.left - box.width / 2) / (box.width / 2 - KNOB);
    let y = (event.clientY - box.top - box.height / 2) / (box.height / 2 - KNOB);
    const length = Math.hypot(x, y);
    if (length > 1) [x, y] = [x / length, y / length];
    stick.forward = Math.abs(y) < DEAD ? 0 : -y;
    stick.turn = Math.abs(x) < DEAD ? 0 : -x;
    draw();
  }

  show('stick').addEventListener('pointerdown', (event) => {
    if (stick.pointer !== null || event.button !== 0) return;
    stick.pointer = event.pointerId;
    show('stick').setPointerCapture(event.pointerId);
    move(event);
    change();
  });
  show('stick').addEventListener('pointermove', move);
  for (const type of ['pointerup', 'pointercancel', 'lostpointercapture']) {
    show('stick').addEventListener(type, (event) => {
      if (event.pointerId !== stick.pointer) return;
      Object.assign(stick, { pointer: null, forward: 0, turn: 0 });
      change();
    });
  }
  for (const side of ['left', 'right']) {
    const button = show(side);
    button.hidden = !settings.sideways;
    const hold = (isDown) => () => { if (sides[side] !== isDown) { sides[side] = isDown; change(); } };
    button.addEventListener('pointerdown', (event) => { button.setPointerCapture(event.pointerId); hold(true)(); });
    for (const type of ['pointerup', 'pointercancel', 'lostpointercapture', 'blur']) button.addEventListener(type, hold(false));
    button.addEventListener('keydown', (event) => { if (event.code === 'Enter') hold(true)(); });
    button.addEventListener('keyup', (event) => { if (event.code === 'Enter') hold(false)(); });
  }
  for (const id of ['move', 'turn']) {
    show(id).addEventListener('input', draw);
    show(id).addEventListener('pointerup', () => show('stick').focus());
  }
  addEventListener('keydown', (event) => {
    if (!(event.code in KEYS) || event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.target.type === 'range' || (!settings.sideways && KEYS[event.code][0] === 1)) return;
    event.preventDefault();
    if (event.repeat) return;
    down.add(event.code);
    change();
  });
  addEventListener('keyup', (event) => { if (down.delete(event.code)) change(); });
  addEventListener('contextmenu', (event) => event.preventDefault());
  for (const type of ['blur', 'pagehide']) addEventListener(type, letGo);
  document.addEventListener('visibilitychange', () => { if (document.hidden) letGo(); });
  for (const type of ['focus', 'blur']) addEventListener(type, () => draw());

  function draw() {
    const [forward, side, turn] = wanted();
    const reach = show('stick').offsetWidth / 2 - KNOB;
    show('knob').style.transform = `translate(${-turn * reach}px, ${-forward * reach}px)`;
    show('stick').classList.toggle('held', isHeld() && Boolean(state?.velocity));
    show('left').classList.toggle('held', side > 0);
    show('right').classList.toggle('held', side < 0);
    show('moveMost').textContent = `${(settings.forward * show('move').value / 100).toFixed(2)} m/s`;
    show('turnMost').textContent = `${(settings.turn * show('turn').value / 100).toFixed(2)} rad/s`;
    show('driveDot').classList.toggle('good', link.isAlive);
    put('what', ...report());
    put('keys', document.hasFocus() ? 'Keys drive: WASD or arrows' + (settings.sideways ? ', Q and E' : '')
      : 'Hold the stick to drive, or click it to use the keys.', 'dim');
  }

  function report() {
    if (!link.isAlive) return ['lost: no drive commands are sent', 'bad'];
    if (state.refusal) return [state.refusal, 'warn'];
    const { who, mine } = state.control;
    if (state.holdsBecause) return [`The robot holds still: ${state.holdsBecause}.`, 'warn'];
    if (state.velocity) {
      const [x, y, turn] = state.velocity;
      return [`${x.toFixed(2)} m/s${settings.sideways ? `, left ${y.toFixed(2)}` : ''}, turn ${turn.toFixed(2)} rad/s`];
    }
    if (who && !mine) return [`${who} is in control.`, 'warn'];
    if (!state.listeners) return [`No subscriber on ${settings.topic}: start the controller that moves the robot.`, 'warn'];
    return [`Stands still; drives on ${settings.topic}.`];
  }
  draw();
}
