import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { firstTriangleHit } from './picking.js';

const halfFieldOfView = 13 * Math.PI / 180;

/** The canvas: one camera, and one or two views of the surface. Draws only when something has changed. */
export class Stage {
  /** views(): [{ rect: { x, y, width, height } in [0, 1] from the top left, clip (the same; what is drawn of it), t, prepare() }] */
  constructor(canvas, surface, page, views) {
    this.canvas = canvas;
    this.surface = surface;
    this.views = views;
    this.page = page;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, stencil: true });
    this.renderer.autoClear = false;
    this.renderer.setClearColor(0, 0);
    this.camera = new THREE.PerspectiveCamera(2 * THREE.MathUtils.radToDeg(halfFieldOfView), 1, 0.01, 100);
    this.camera.up.fromArray(page.scene.camera.up);
    this.toward = page.scene.camera.toward;
    this.controls = this.#newControls();
    this.draws = 0;
    this.drawSeconds = 0;
    this.resizes = new ResizeObserver(() => this.#resize());
    this.resizes.observe(canvas.parentElement);
    this.#resize();
    this.showAll();
  }

  /** Frees what it holds on the graphics card, and puts a canvas that has drawn nothing in place of its own. */
  dispose() {
    this.isDisposed = true;
    this.resizes.disconnect();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.canvas.replaceWith(this.canvas.cloneNode());
  }

  changed() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      if (this.isDisposed) return;
      this.controls.update();
      this.draw();
    });
  }

  draw() {
    const began = performance.now();
    const { width, height } = this;
    this.renderer.setScissorTest(false);
    this.renderer.setViewport(0, 0, width, height);
    this.renderer.clear();
    this.renderer.setScissorTest(true);
    for (const view of this.views()) {
      const { rect, clip } = view;
      this.renderer.setViewport(rect.x * width, (1 - rect.y - rect.height) * height, rect.width * width, rect.height * height);
      this.renderer.setScissor(clip.x * width, (1 - clip.y - clip.height) * height, clip.width * width, clip.height * height);
      this.#aim(rect);
      view.prepare();
      this.renderer.clearStencil();
      this.renderer.render(this.surface.scene, this.camera);
    }
    this.draws += 1;
    this.drawSeconds = (performance.now() - began) / 1000;
  }

  /** Resolves when it has drawn what it was told. */
  drawn() {
    this.changed();
    // A page in the background draws nothing: nobody waits for that.
    return document.hidden ? Promise.resolve() : new Promise((done) => { requestAnimationFrame(() => setTimeout(done)); });
  }

  /** Is it so much taller than wide that two views fit better below each other? */
  get isTall() {
    return this.height > 1.2 * this.width;
  }

  /** As the views have another shape now: shows all of them, unless the reader has turned to something. */
  fit() {
    if (this.isUntouched) this.showAll();
  }

  /** Looks from where another stage does, unless nobody has turned that. */
  lookLike(other) {
    if (other.isUntouched) return;
    this.isUntouched = false;
    this.toward = other.toward;
    if (!this.camera.up.equals(other.camera.up)) {
      this.camera.up.copy(other.camera.up);
      this.controls.dispose();
      this.controls = this.#newControls();
    }
    this.controls.target.copy(other.controls.target);
    this.camera.position.copy(other.camera.position);
    this.changed();
  }

  /** The direction in which pictures are taken, from as near as shows all. */
  showAll() {
    this.isUntouched = true;
    const toward = new THREE.Vector3().fromArray(this.toward);
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(toward);
    this.camera.lookAt(this.controls.target);
    this.camera.updateMatrixWorld();
    this.#retreat(toward, this.page.before.positions);
    this.changed();
  }

  /** The next axis (y after x, z after y, x after z) points up; the view goes round with it. */
  turnUp() {
    const { up } = this.camera;
    // The cyclic rotation of the axes takes the usual direction to the same one above the new ground.
    const turned = ([x, y, z]) => [z, x, y];
    this.toward = turned(this.toward);
    up.fromArray(turned(up.toArray()));
    // OrbitControls reads `up` when it is made.
    this.controls.dispose();
    this.controls = this.#newControls();
    this.showAll();
  }

  #newControls() {
    const controls = new OrbitControls(this.camera, this.canvas);
    controls.enableDamping = true;
    controls.dampingFactor = 0.12;
    controls.zoomToCursor = true;
    controls.minDistance = 1e-5;
    controls.maxDistance = 50;
    controls.addEventListener('change', () => this.changed());
    controls.addEventListener('start', () => { this.isUntouched = false; });
    return controls;
  }

  /** Looks at a sphere from where the camera is. */
  lookAt(centre, radius) {
    this.isUntouched = false;
    const away = this.camera.position.clone().sub(this.controls.target).normalize();
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(away, Math.max(radius, 1e-4) / Math.tan(halfFieldOfView) * 2.2);
    this.changed();
  }

  /** The face under the pointer at a moment t, or -1. x, y: CSS pixels from the top left of the canvas. */
  faceAt(x, y, positionsA, positionsB) {
    const px = x / this.width;
    const py = y / this.height;
    const view = this.views().find(({ clip }) =>
      px >= clip.x && px < clip.x + clip.width && py >= clip.y && py < clip.y + clip.height);
    if (!view) return -1;
    const { rect } = view;
    this.#aim(rect);
    this.camera.updateMatrixWorld();
    const ndc = new THREE.Vector3(2 * (px - rect.x) / rect.width - 1, 1 - 2 * (py - rect.y) / rect.height, 0.5);
    const origin = this.camera.position;
    const direction = ndc.unproject(this.camera).sub(origin).normalize();
    const { triangles, triangleFaces } = this.page;
    const hit = firstTriangleHit(origin.toArray(), direction.toArray(), triangles, positionsA, positionsB, view.t);
    return hit < 0 ? -1 : triangleFaces ? triangleFaces[hit] : hit;
  }

  /** What is on the canvas now, as a canvas that may be read; over this colour. */
  snapshot(background) {
    this.draw();
    const copy = document.createElement('canvas');
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    const context = copy.getContext('2d');
    if (background) {
      context.fillStyle = background;
      context.fillRect(0, 0, copy.width, copy.height);
    }
    context.drawImage(this.canvas, 0, 0);
    return copy;
  }

  /** Edges closer than a few pixels would be a grey fog: how strongly to draw them, in [0, 1]. */
  edgeStrength(meanLength) {
    const distance = Math.max(this.camera.position.distanceTo(this.controls.target), 1e-9);
    const pixels = meanLength / distance / (2 * Math.tan(halfFieldOfView)) * this.height;
    return THREE.MathUtils.smoothstep(pixels, 1.5, 9);
  }

  #aim(rect) {
    const aspect = rect.width * this.width / (rect.height * this.height);
    const distance = this.camera.position.length();
    this.camera.aspect = aspect;
    this.camera.near = Math.max(0.002 * this.camera.position.distanceTo(this.controls.target), distance - 1.5);
    this.camera.far = distance + 1.5;
    this.camera.updateProjectionMatrix();
  }

  /** Moves back until every point lies within the field of view. */
  #retreat(toward, positions) {
    const { rect } = this.views()[0];
    const aspect = rect.width * this.width / Math.max(1, rect.height * this.height);
    const slope = Math.tan(halfFieldOfView) * 0.84;  // the rest is margin
    const right = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    const up = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
    const step = 3 * Math.max(1, Math.floor(positions.length / 3 / 50000));
    const p = new THREE.Vector3();
    // The nearest eye, as in src/render/camera.cpp: bounds of x +- slope z for both directions of the view.
    const bounds = [-Infinity, -Infinity, -Infinity, -Infinity];
    for (let i = 0; i < positions.length; i += step) {
      p.fromArray(positions, i);
      const x = p.dot(right), y = p.dot(up), z = p.dot(toward);
      bounds[0] = Math.max(bounds[0], x + aspect * slope * z);
      bounds[1] = Math.max(bounds[1], -x + aspect * slope * z);
      bounds[2] = Math.max(bounds[2], y + slope * z);
      bounds[3] = Math.max(bounds[3], -y + slope * z);
    }
    if (!Number.isFinite(bounds[0])) bounds.fill(0.5);
    const distance = Math.max((bounds[0] + bounds[1]) / (2 * aspect * slope), (bounds[2] + bounds[3]) / (2 * slope), 1e-3);
    const aside = right.multiplyScalar((bounds[0] - bounds[1]) / 2).addScaledVector(up, (bounds[2] - bounds[3]) / 2);
    this.controls.target.copy(aside);
    this.camera.position.copy(aside).addScaledVector(toward, distance);
  }

  #resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    this.width = Math.max(1, clientWidth);
    this.height = Math.max(1, clientHeight);
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(this.width, this.height, true);
    this.fit();
    this.changed();
  }
}
