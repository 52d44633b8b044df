// Follows the theme of the page around; on its own, that of its root, the one chosen in this browser, or that of the system.
(() => {
  const ATTRIBUTE = 'data-mantine-color-scheme';
  const root = document.documentElement;
  const around = window.parent.document.documentElement;
  const isLight = matchMedia('(prefers-color-scheme: light)');
  const follow = () => {
    root.dataset.theme = around.getAttribute(ATTRIBUTE) || localStorage.getItem('rviz.theme')
      || (isLight.matches ? 'light' : 'dark');
  };
  new MutationObserver(follow).observe(around, { attributeFilter: [ATTRIBUTE] });
  isLight.addEventListener('change', follow);
  follow();
})();
