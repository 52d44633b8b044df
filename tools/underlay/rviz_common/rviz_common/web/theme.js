// Follows the theme of the page around; on its own, the theme chosen in this browser, or that of the system.
(() => {
  const ATTRIBUTE = 'data-mantine-color-scheme';
  const root = document.documentElement;
  const around = window.parent === window ? null : window.parent.document.documentElement;
  const isLight = matchMedia('(prefers-color-scheme: light)');
  const follow = () => {
    root.dataset.theme = around?.getAttribute(ATTRIBUTE) || localStorage.getItem('rviz.theme')
      || (isLight.matches ? 'light' : 'dark');
  };
  if (around) new MutationObserver(follow).observe(around, { attributeFilter: [ATTRIBUTE] });
  isLight.addEventListener('change', follow);
  follow();
})();
