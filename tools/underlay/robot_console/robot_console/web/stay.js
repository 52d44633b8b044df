// What is around scrolls below the pages that stay in sight, as far as there is room for both.
const STAYING = 'iframe[title=robot], iframe[title=safety]';

function stay() {
  const box = window.frameElement?.parentElement;
  let around = box;
  while (around && !/auto|scroll/.test(getComputedStyle(around).overflowY)) around = around.parentElement;
  if (!around) return;
  const all = [...window.parent.document.querySelectorAll(STAYING)];
  const height = all.reduce((sum, each) => sum + each.offsetHeight, 0);
  const missing = Math.max(0, height - 0.6 * around.clientHeight);
  const top = Math.max(0, around.scrollTop - missing);
  const boxShadow = all[0] === window.frameElement ? '0 -12px var(--mantine-color-body)' : '';
  Object.assign(box.style, { position: 'relative', top: `${top}px`, zIndex: 10, boxShadow });
}

if (window.frameElement) window.parent.document.addEventListener('scroll', stay, true);
stay();
setInterval(stay, 1000);
