import * as THREE from 'three';

/** Both states of a vertex, and where it is now. Shared by all materials, so that equal vertices have equal depths. */
const vertexHead = /* glsl */ `
  attribute vec3 positionB;
  uniform float t;
  vec3 positionNow() { return mix(position, positionB, t); }
`;

const surfaceVertex = /* glsl */ `
  ${vertexHead}
  attribute vec3 normalB;
  attribute float heat;
  #ifdef PAINTED
  varying vec2 uvHere;
  #endif
  invariant gl_Position;
  varying vec3 viewPosition;
  varying vec3 smoothNormal;
  varying float heatHere;
  void main() {
    vec4 p = modelViewMatrix * vec4(positionNow(), 1.0);
    viewPosition = p.xyz;
    smoothNormal = normalMatrix * mix(normal, normalB, t);
    heatHere = heat;
    #ifdef PAINTED
    uvHere = uv;
    #endif
    gl_Position = projectionMatrix * p;
  }
`;

const surfaceFragment = /* glsl */ `
  uniform vec3 colour;
  uniform float opacity;
  uniform bool lit;
  uniform bool heated;
  uniform float heatFull;
  uniform vec3 heatStops[5];
  varying vec3 viewPosition;
  varying vec3 smoothNormal;
  varying float heatHere;
  #ifdef PAINTED
  uniform sampler2D image;
  uniform float alphaCutoff;
  varying vec2 uvHere;
  #endif

  vec3 toLinear(vec3 c) { return pow(c, vec3(2.2)); }

  // Most motions are small beside the largest: the scale goes with the square root, as do the ticks of the legend.
  vec3 heatColour(float share) {
    float at = clamp(share, 0.0, 1.0) * 4.0;
    vec3 result = heatStops[0];
    for (int i = 0; i < 4; ++i) result = mix(result, heatStops[i + 1], clamp(at - float(i), 0.0, 1.0));
    return result;
  }

  // Smooth over gentle bends, flat over sharp ones; always towards the eye, as surfaces need not be orientable.
  vec3 shadingNormal() {
    vec3 flatNormal = normalize(cross(dFdx(viewPosition), dFdy(viewPosition)));
    if (dot(flatNormal, viewPosition) > 0.0) flatNormal = -flatNormal;
    float length2 = dot(smoothNormal, smoothNormal);
    if (!(length2 > 1e-8)) return flatNormal;
    vec3 bent = smoothNormal * inversesqrt(length2);
    float turn = dot(bent, flatNormal);
    if (turn < 0.0) { bent = -bent; turn = -turn; }
    return normalize(mix(flatNormal, bent, smoothstep(0.72, 0.86, turn)));
  }

  void main() {
    vec3 base = toLinear(heated ? heatColour(sqrt(heatHere / heatFull)) : colour);
    #ifdef PAINTED
    vec4 texel = texture2D(image, uvHere);
    if (texel.a < alphaCutoff) discard;
    base *= toLinear(texel.rgb);
    #endif
    vec3 result = base;
    if (lit) {
      vec3 n = shadingNormal();
      vec3 eye = normalize(-viewPosition);
      vec3 key = normalize(vec3(-0.45, 0.75, 0.65));
      vec3 fill = normalize(vec3(0.8, 0.1, 0.45));
      float light = 0.34 + 0.16 * n.y + 0.62 * max(dot(n, key), 0.0) + 0.16 * max(dot(n, fill), 0.0);
      float gloss = pow(max(dot(n, normalize(key + eye)), 0.0), 40.0);
      float rim = pow(1.0 - max(dot(n, eye), 0.0), 4.0);
      result = base * light * (1.0 - 0.35 * rim) + 0.05 * gloss;
    }
    gl_FragColor = vec4(pow(result, vec3(1.0 / 2.2)), opacity);
  }
`;

const edgeVertex = /* glsl */ `
  ${vertexHead}
  void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(positionNow(), 1.0); }
`;

const edgeFragment = /* glsl */ `
  uniform vec3 colour;
  uniform float opacity;
  void main() { gl_FragColor = vec4(colour, opacity); }
`;

/** Uniforms that all materials of a scene share. */
export function sharedUniforms() {
  return {
    t: { value: 0 },
    heated: { value: false },
    heatFull: { value: 1 },
    heatStops: { value: Array.from({ length: 5 }, () => new THREE.Vector3()) },
  };
}

function surfaceMaterial(shared, { lit = true, heats = false, opacity = 1, ...settings }) {
  return new THREE.ShaderMaterial({
    vertexShader: surfaceVertex,
    fragmentShader: surfaceFragment,
    side: THREE.DoubleSide,
    polygonOffset: true,  // so that edges and curves lie in front
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    ...settings,
    uniforms: {
      ...shared,
      heated: heats ? shared.heated : { value: false },
      colour: { value: new THREE.Vector3() },
      opacity: { value: opacity },
      lit: { value: lit },
    },
  });
}

/** The surface itself. */
export function clayMaterial(shared) {
  return surfaceMaterial(shared, { heats: true });
}

const wraps = { repeat: THREE.RepeatWrapping, mirror: THREE.MirroredRepeatWrapping, clamp: THREE.ClampToEdgeWrapping };

/** The surface as a material of its file paints it, see appearance.js. */
export function paintedMaterial(shared, { image, alpha_cutoff: alphaCutoff, wrap }) {
  if (!image) return surfaceMaterial(shared, {});
  const texture = new THREE.Texture(image);
  texture.flipY = false;  // v goes down from the first row
  texture.wrapS = wraps[wrap[0]];
  texture.wrapT = wraps[wrap[1]];
  texture.anisotropy = 4;
  texture.needsUpdate = true;
  const material = surfaceMaterial(shared, { defines: { PAINTED: '' } });
  Object.assign(material.uniforms, { image: { value: texture }, alphaCutoff: { value: alphaCutoff } });
  return material;
}

/** Chosen faces, over the surface. */
export function overlayMaterial(shared) {
  return surfaceMaterial(shared, { transparent: true, depthWrite: false, depthFunc: THREE.LessEqualDepth });
}

/** Chosen faces, where they are hidden: one layer of tint, however many there are. */
export function hiddenMaterial(shared) {
  return surfaceMaterial(shared, {
    lit: false,
    transparent: true,
    depthWrite: false,
    depthFunc: THREE.GreaterDepth,
    stencilWrite: true,
    stencilRef: 1,
    stencilFunc: THREE.NotEqualStencilFunc,
    stencilZPass: THREE.ReplaceStencilOp,
  });
}

export function edgeMaterial(shared) {
  return new THREE.ShaderMaterial({
    vertexShader: edgeVertex,
    fragmentShader: edgeFragment,
    transparent: true,
    depthWrite: false,
    uniforms: { t: shared.t, colour: { value: new THREE.Vector3() }, opacity: { value: 0.3 } },
  });
}
