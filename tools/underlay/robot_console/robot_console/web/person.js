// All small pages inside of one page are one person.
const me = (window.parent.robotConsoleKey ??= Array.from(
  crypto.getRandomValues(new Uint8Array(8)), (each) => each.toString(16).padStart(2, '0')).join(''));
