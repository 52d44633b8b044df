// How this browser draws the scene of viser, which shows it to its own tests as `__viserMutable`.
const drawScene = (() => {
  const THIN_M = 0.01;
  // Light at vertices only, as a diffuse surface reflects it: without a graphics card, pixels are what takes time.
  const LIGHTS = `
    uniform vec3 ambientLightColor;
    #if NUM_DIR_LIGHTS > 0
      struct DirectionalLight { vec3 direction; vec3 color; };
      uniform DirectionalLight directionalLights[NUM_DIR_LIGHTS];
    #endif
    #if NUM_HEMI_LIGHTS > 0
      struct HemisphereLight { vec3 direction; vec3 skyColor; vec3 groundColor; };
      uniform HemisphereLight hemisphereLights[NUM_HEMI_LIGHTS];
    #endif
    vec3 lightFrom(vec3 position, vec3 normal) {
      #ifdef DOUBLE_SIDED
        normal = faceforward(normal, position, normal);
      #endif
      vec3 light = ambientLightColor;
      #if NUM_DIR_LIGHTS > 0
        for (int i = 0; i < NUM_DIR_LIGHTS; i++)
          light += max(0.0, dot(normal, directionalLights[i].direction)) * directionalLights[i].color;
      #endif
      #if NUM_HEMI_LIGHTS > 0
        for (int i = 0; i < NUM_HEMI_LIGHTS; i++) {
          float share = 0.5 + 0.5 * dot(normal, hemisphereLights[i].direction);
          light += mix(hemisphereLights[i].groundColor, hemisphereLights[i].skyColor, share);
        }
      #endif
      return RECIPROCAL_PI * light;
    }`;
  const vertexShader = (isLit) => `
    #include <common>
    #include <color_pars_vertex>
    #include <tonemapping_pars_fragment>
    #include <colorspace_pars_fragment>
    ${isLit ? LIGHTS : ''}
    uniform vec3 diffuse;
    varying vec3 seen;
    void main() {
      #include <color_vertex>
      #include <begin_vertex>
      #include <project_vertex>
      vec3 color = diffuse${isLit ? ' * lightFrom(mvPosition.xyz, normalize(normalMatrix * normal))' : ''};
      #if defined(USE_COLOR) || defined(USE_COLOR_ALPHA)
        color *= vColor.rgb;
      #endif
      seen = sRGBTransferOETF(vec4(ACESFilmicToneMapping(color), 1.0)).rgb;
    }`;
  const FRAGMENT_SHADER = `
    #include <color_pars_fragment>
    uniform float opacity;
    varying vec3 seen;
    void main() {
      gl_FragColor = vec4(seen, opacity);
      #ifdef USE_COLOR_ALPHA
        gl_FragColor.a *= vColor.a;
      #endif
    }`;

  // Whether the material of an object has a shader that the simple one can replace.
  function canBeSimple({ type, geometry, material }) {
    if (type !== 'Mesh' || material.map) return false;
    // Of the unlit ones the ground and the sky, not the axes of frames, which can share theirs with copies.
    if (material.type === 'MeshBasicMaterial') return Boolean(material.flatShading);
    // Corners that triangles share have no normals for flat ones.
    const hasNormals = geometry.attributes.normal && !(material.flatShading && geometry.index);
    return material.type === 'MeshStandardMaterial' && hasNormals;
  }

  function simplify(object, isCoarse) {
    const { material } = object;
    if (Boolean(material.userData.isSimple) === isCoarse || (isCoarse && !canBeSimple(object))) return;
    material.userData.isSimple = isCoarse;
    material.needsUpdate = true;
    // The sky and the ground last, where nothing hides them.
    if (material.type === 'MeshBasicMaterial') object.renderOrder = isCoarse ? 1 : 0;
    delete material.onBeforeCompile;
    delete material.customProgramCacheKey;
    if (!isCoarse) return;
    const isLit = material.type === 'MeshStandardMaterial';
    material.onBeforeCompile = (shader) => {
      shader.vertexShader = vertexShader(isLit);
      shader.fragmentShader = FRAGMENT_SHADER;
    };
    material.customProgramCacheKey = () => `simple ${isLit}`;
  }

  // Without antialiasing, lines that are thinner than a pixel of the picture are broken.
  function thicken({ material }, canvas) {
    if (material.type !== 'LineMaterial' || material.worldUnits) return;
    material.userData.linewidth ??= material.linewidth;
    material.linewidth = Math.max(material.userData.linewidth, canvas.clientWidth / canvas.width);
  }

  // Of lines on a floor, only parts would be seen: it is drawn as if it were farther away, by about a pixel.
  function setBack({ geometry, material }) {
    if (material.type !== 'MeshStandardMaterial' || material.transparent || material.polygonOffset) return;
    if (!geometry.boundingBox) geometry.computeBoundingBox();
    const { min, max } = geometry.boundingBox;
    if (Math.min(max.x - min.x, max.y - min.y, max.z - min.z) > THIN_M) return;
    Object.assign(material, { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  }

  // Has each frame drawn as this browser can; to be called again now and then, since viser can begin anew.
  return (viser, hasCard, isCoarse) => {
    if (!viser?.scene) return;
    viser.scene.onBeforeRender = ({ domElement }, scene) => {
      scene.traverse((object) => {
        if (!object.material?.isMaterial) return;
        simplify(object, isCoarse());
        if (hasCard) return;
        thicken(object, domElement);
        setBack(object);
      });
    };
  };
})();
