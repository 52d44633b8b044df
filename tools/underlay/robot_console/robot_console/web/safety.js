// The button that stops a robot, and who is in control, with a connection of their own.
const KINDS = {
  real: ['REAL', 'The .rviz file says so.'],
  simulated: ['SIMULATED', 'The .rviz file says so, or /clock has a publisher.'],
  unknown: ['REAL OR NOT?', "/clock has no publisher, and the .rviz file does not say 'Robot: real'. Be careful."],
};
const SLOW = 0.9;
const BUTTONS = ['button', 'checkbox', 'color', 'file', 'radio', 'range', 'reset', 'submit'];
const CHOOSERS = ['[aria-haspopup=listbox]', ...BUTTONS.map((kind) => `[type=${kind}]`)].join();
const HOW = matchMedia('(pointer: coarse)').matches ? 'press it' : 'press it, or the space bar';
const CONTROLLED = 'The robot stops by itself when this page is closed, hidden or lost.';

function startSafety(settings, path) {
  let state = null;
  let sureUntil = 0;
  let unsent = false;

  const link = new Link(path, (next) => {
    state = next;
    if (unsent) unsent = !link.send({ do: 'stop' });
    draw();
  }, () => draw());

  // A press that perhaps did not arrive is repeated as soon as there is an answer.
  function press() {
    link.send({ do: 'stop' });
    unsent = !link.isAlive;
    draw();
  }

  function release() {
    if (performance.now() < sureUntil) {
      sureUntil = 0;
      link.send({ do: 'release' });
    } else {
      sureUntil = performance.now() + 4000;
      setTimeout(draw, 4050);
    }
    draw();
  }

  const shortened = (names) => names.slice(0, 3).join(', ') + (names.length > 3 ? ` and ${names.length - 3} more` : '');

  function draw() {
    const isDead = !link.isAlive;
    show('dot').classList.toggle('good', !isDead);
    put('link', isDead ? 'lost: this page cannot stop the robot' : 'connected', isDead ? 'bad' : '');
    const isPressed = !isDead && state.stop.pressed;
    const isHeld = !isDead && Boolean(state.says);
    show('stop').classList.toggle('pressed', isPressed);
    show('stop').classList.toggle('dead', isDead);
    put('word', isPressed ? 'STOPPED' : 'STOP');
    put('hint', isDead ? (unsent ? 'NOT STOPPED YET: use the switch at the robot' : 'Use the switch at the robot')
      : isPressed ? by() : `${settings.namespace ? `${settings.namespace}: ` : ''}${HOW}`);
    const isSure = performance.now() < sureUntil;
    show('release').hidden = !(isPressed || isHeld);
    show('release').classList.toggle('sure', isSure);
    put('release', isSure ? 'Release? It may move at once. Click again' : 'Release');
    if (isDead) {
      put('robot', 'Press the button anyway: it is sent when the connection is back.', 'dim');
      put('control', '');
      show('take').hidden = show('kind').hidden = true;
      return;
    }
    drawRobot(isPressed);
    drawControl();
    const [word, why] = KINDS[state.kind];
    const isSlow = state.pace !== null && state.pace < SLOW;
    put('kind', state.pace === null ? word : `${word} ${state.pace.toFixed(2)}×`);
    show('kind').hidden = false;
    show('kind').className = isSlow ? 'slow' : state.kind;
    show('kind').title = state.pace === null ? why
      : `${why} ${state.pace.toFixed(2)} simulated seconds pass per real second.`
        + (isSlow ? ' Either it was slowed down on purpose, or the computer is overloaded.' : '');
  }

  function by() {
    return state.stop_place || `by ${state.speakers.length ? shortened(state.speakers) : 'someone who has left'}`;
  }

  function drawRobot(isPressed) {
    if (!state.listeners.length) {
      put('robot', `No robot hears the button: ${settings.topic} has no subscriber.`, 'warn');
    } else if (state.says) {
      put('robot', `The robot holds still: ${state.says}.`);
    } else if (state.says === '') {
      put('robot', isPressed ? 'The robot has not stopped yet.' : 'Ready to move.', isPressed ? 'bad' : '');
    } else {
      put('robot', `Heard by ${shortened(state.listeners)}, which does not report whether it holds still.`);
    }
    show('robot').title = `${settings.topic} has the subscribers ${state.listeners.join(', ') || '(none)'}`;
  }

  function drawControl() {
    const { who, mine, here, lost } = state.control;
    link.periodMs = here ? 100 : 250;
    put('control', mine ? `You are in control${here ? `. ${CONTROLLED}` : ' while you drive.'}`
      : who ? `In control: ${who}`
        : lost ? `${lost === state.you ? 'You were' : `${lost} was`} in control and lost the connection.`
          : 'No one is in control.', who || !lost ? '' : 'warn');
    show('control').classList.toggle('idle', !who && !lost);
    show('take').hidden = Boolean(who) && !mine;
    put('take', here ? 'Give back' : 'Take control');
    show('take').title = here ? '' : CONTROLLED;
  }

  // It stops at the touch: browsers make no click of a second finger while the first one drives. Keys only click.
  let touchedAt = -Infinity;
  show('stop').addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    touchedAt = performance.now();
    press();
  });
  show('stop').addEventListener('click', () => { if (performance.now() - touchedAt > 1000) press(); });
  show('release').addEventListener('click', release);
  show('take').addEventListener('click', () => link.send({ do: state.control.here ? 'give' : 'take' }));
  show('domain').textContent = `${settings.namespace ? `/${settings.namespace} · ` : ''}domain ${settings.domain}`;
  show('domain').title = 'ROS_DOMAIN_ID';

  // The space bar stops from anywhere in the page, but not from where somebody writes. The drop-downs of viser are
  // fields in which one could search.
  function onKey(event) {
    if (event.code !== 'Space' || event.ctrlKey || event.altKey || event.metaKey) return;
    const target = event.composedPath()[0];
    const isText = target.isContentEditable || /^textarea$/i.test(target.tagName)
      || (/^input$/i.test(target.tagName) && !target.readOnly && !target.matches(CHOOSERS));
    if (isText) return;
    event.preventDefault();
    event.stopPropagation(); // but the buttons of other robots hear it
    if (event.type === 'keydown' && !event.repeat) press();
  }

  const heard = new WeakSet();
  function listen() {
    for (const frame of [outer, ...Array.from({ length: outer.length }, (_, index) => outer[index])]) {
      try {
        if (heard.has(frame.document)) continue;
        heard.add(frame.document);
        for (const type of ['keydown', 'keyup']) frame.document.addEventListener(type, onKey, true);
      } catch (error) {
        if (error.name !== 'SecurityError') throw error;
      }
    }
  }

  listen();
  setInterval(listen, 1000);
}
