// Whether a graphics card draws, and not the processor, which takes too long for antialiasing.
window.rvizHasCard = (() => {
  const gl = document.createElement('canvas').getContext('webgl');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
})();
if (!window.rvizHasCard) {
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function getPlainContext(kind, wanted) {
    return getContext.call(this, kind, /^webgl/.test(kind) ? { ...wanted, antialias: false } : wanted);
  };
}
