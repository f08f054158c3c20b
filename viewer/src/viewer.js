import { Vector3 } from 'three';
import { Conflicts } from './conflicts.js';
import { Faces } from './faces.js';
import { FramePlayer } from './frames.js';
import { historySection } from './history.js';
import { strengthsOf, viewsOf } from './layouts.js';
import { fillColourLegend, fillLegend, heatRanges } from './legend.js';
import { plural } from './numbers.js';
import { selectionSection } from './selection.js';
import { Stage } from './stage.js';
import { statusOf, summary } from './summary.js';
import { Surface } from './surface.js';

const byId = (id) => document.getElementById(id);

/** Meshes with more faces start without edges, which would be a fog. */
const facesWithEdges = 40000;
/** Seconds from before to after when played. */
const playSeconds = 3;
const framesPerSecond = 12;

/**
 * What is shown of a page (state), and everything that shows it. Methods are what keys and buttons do. It fills the
 * elements of shell.html until it is disposed of.
 */
export class Viewer {
  #wires = new AbortController();
  #isAnyHeld = false;

  /** page: see readPage. onPick(face): a face was picked; -1: none is any more. */
  constructor(page, theme, { onPick = () => {} } = {}) {
    this.page = page;
    this.onPick = onPick;
    const { scene } = page;
    this.faces = new Faces(page.corners, page.sizes);
    this.before = new Conflicts(page.before.pairs, scene.faces, scene.pair_classes);
    this.after = page.after && new Conflicts(page.after.pairs, scene.faces, scene.pair_classes);
    this.frames = page.frames.length > 1 ? new FramePlayer(page.frames, page.before.positions) : null;
    this.ranges = page.displacement && heatRanges(page.displacement);
    this.state = {
      layout: page.after ? 'pair' : 'single', colouring: this.#hasImages() ? 'texture' : 'conflicts', range: 'all', edges: scene.faces <= facesWithEdges,
      curves: true, blend: 0, divider: 0.5, frame: 0, face: -1,
    };
    this.surface = new Surface(page, this.faces);
    this.surface.setRed('before', (f) => this.before.isRed[f]);
    if (this.after) this.surface.setRed('after', (f) => this.after.isRed[f]);
    this.meanEdge = this.#meanEdgeLength();
    this.stage = new Stage(byId('canvas'), this.surface, page, () => this.#views());
    this.theme = theme;
    theme.onChange = (colours) => {
      this.surface.applyColours(colours);
      this.stage.changed();
    };
    this.surface.applyColours(theme.colours());
    this.#fillPanel();
    this.#wire();
    this.update();
  }

  /** Leaves the elements to another viewer. */
  dispose() {
    this.stop();
    this.#wires.abort();
    this.theme.onChange = null;
    this.stage.dispose();
    byId('facts').replaceChildren();
  }

  /** Looks from where another viewer of the same mesh does, if its reader has turned it. */
  lookLike(other) {
    this.stage.lookLike(other.stage);
  }

  /** flags: one a face, 1: it is to be held still. */
  setHeld(flags) {
    this.#isAnyHeld = flags.includes(1);
    this.surface.setHeld(flags);
    this.update();
  }

  /** Shows the state. */
  update() {
    const { state } = this;
    for (const id of ['layout', 'colouring'])
      for (const button of byId(id).children) button.setAttribute('aria-pressed', String(button.dataset.value === state[id]));
    for (const id of ['edges', 'curves']) byId(id).setAttribute('aria-pressed', String(state[id]));
    this.surface.setEdgesShown(state.edges);
    this.surface.setPainted(state.colouring === 'texture');
    const { shared } = this.surface;
    shared.heated.value = state.colouring === 'displacement';
    const full = this.ranges?.[state.range] ?? 1;
    shared.heatFull.value = full;
    this.#showLegend(full);
    byId('divider').hidden = state.layout !== 'wipe';
    byId('divider').style.left = `${100 * state.divider}%`;
    this.#showCaptions();
    this.#showPlayer();
    this.stage.changed();
  }

  setLayout(layout) {
    if (!this.#layouts().includes(layout)) return;
    this.stop();
    this.state.layout = layout;
    if (layout === 'replay') this.setFrame(this.state.frame);
    else this.surface.showEnds();
    this.stage.fit();
    this.update();
  }

  setColouring(colouring) {
    if (!this.#colourings().includes(colouring)) return;
    this.state.colouring = colouring;
    this.update();
  }

  changeRange() {
    if (this.state.colouring !== 'displacement') return;
    this.state.range = this.state.range === 'all' ? 'most' : 'all';
    this.update();
  }

  toggle(name) {
    this.state[name] = !this.state[name];
    this.update();
  }

  /** Moves whatever the layout slides: by steps of 2 % or by frames. */
  slide(steps) {
    const { state } = this;
    const moved = (x) => Math.min(1, Math.max(0, x + 0.02 * steps));
    if (state.layout === 'wipe') state.divider = moved(state.divider);
    else if (state.layout === 'blend') state.blend = moved(state.blend);
    else if (state.layout === 'replay') this.setFrame(state.frame + steps);
    this.update();
  }

  setFrame(frame) {
    if (!this.frames) return;
    this.state.frame = Math.min(this.page.frames.length - 1, Math.max(0, Math.round(frame)));
    const { faces } = this.frames.seek(this.state.frame);
    this.surface.showState(this.frames.positions, this.frames.displacement);
    const red = new Set(faces);
    this.surface.setRed('frame', (f) => red.has(f));
    this.history?.show(this.state.frame);
  }

  play() {
    if (this.playing) return this.stop();
    if (!['blend', 'replay'].includes(this.state.layout)) this.setLayout(this.frames ? 'replay' : 'blend');
    if (!['blend', 'replay'].includes(this.state.layout)) return undefined;
    const { state } = this;
    const last = this.page.frames.length - 1;
    if (state.blend >= 1) state.blend = 0;
    if (state.frame >= last) state.frame = 0;
    let before = performance.now();
    let frame = state.frame;
    const step = (now) => {
      const seconds = (now - before) / 1000;
      before = now;
      if (state.layout === 'blend') state.blend = Math.min(1, state.blend + seconds / playSeconds);
      else {
        frame = Math.min(last, frame + seconds * framesPerSecond);
        if (Math.floor(frame) !== state.frame) this.setFrame(Math.floor(frame));
      }
      this.update();
      const ended = state.layout === 'blend' ? state.blend >= 1 : state.frame >= last;
      if (ended) this.stop();
      else this.playing = requestAnimationFrame(step);
    };
    this.playing = requestAnimationFrame(step);
    return undefined;
  }

  stop() {
    if (this.playing) cancelAnimationFrame(this.playing);
    this.playing = 0;
  }

  pick(face) {
    this.state.face = face;
    const partners = face < 0 ? [] : [...this.before.partners(face), ...this.after?.partners(face) ?? []];
    this.surface.select(face, partners.map((p) => p.face));
    this.panelSelection.replaceWith(this.panelSelection = this.#selection(face));
    this.update();
    this.onPick(face);
  }

  /** The next face (by) after the picked one that intersects another, before or after. */
  pickNext(by) {
    const n = this.page.scene.faces;
    const start = this.state.face < 0 ? (by > 0 ? -1 : n) : this.state.face;
    for (let k = 1; k <= n; ++k) {
      const f = ((start + by * k) % n + n) % n;
      if (!this.before.isRed[f] && !this.after?.isRed[f]) continue;
      this.pick(f);
      this.lookAtPicked();
      return;
    }
  }

  /** A sphere, in the units of the page. */
  lookAt(middle, radius) {
    this.stage.lookAt(new Vector3(...middle), radius);
  }

  lookAtPicked() {
    if (this.state.face < 0) return;
    const { positions } = this.#positionsAt(this.#views()[0]);
    const points = [...this.faces.of(this.state.face)].map((v) => new Vector3().fromArray(positions, 3 * v));
    const centre = points.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(points.length);
    const radius = Math.max(...points.map((p) => p.distanceTo(centre)));
    this.stage.lookAt(centre, 5 * radius);
  }

  save() {
    const background = getComputedStyle(byId('stage')).backgroundColor;
    const link = document.createElement('a');
    link.download = `${this.page.scene.input.replace(/\.[^.]*$/, '')}.png`;
    link.href = this.stage.snapshot(background).toDataURL('image/png');
    link.click();
  }

  #selection(face) {
    return selectionSection(this.page, this.faces, this.before, this.after, face,
      { onPick: (other) => this.pick(other), onNext: (by) => this.pickNext(by) });
  }

  #views() {
    const tall = this.stage?.isTall ?? false;
    byId('stage').classList.toggle('tall', tall);
    return viewsOf(this.state, tall).map((view) => ({
      ...view,
      prepare: () => {
        this.surface.shared.t.value = view.t;
        this.surface.setStrengths(strengthsOf(view, this.state));
        if (this.surface.edges)
          this.surface.edges.material.uniforms.opacity.value = 0.24 * this.stage.edgeStrength(this.meanEdge);
      },
    }));
  }

  #layouts() {
    if (!this.page.after) return ['single'];
    return this.frames ? ['pair', 'wipe', 'blend', 'replay'] : ['pair', 'wipe', 'blend'];
  }

  #colourings() {
    const { appearance, displacement } = this.page;
    return ['conflicts', appearance?.materials.length ? 'texture' : null, displacement ? 'displacement' : null].filter(Boolean);
  }

  #hasImages() {
    return this.page.appearance?.materials.some(({ image }) => image) ?? false;
  }

  /** Between which positions the vertices are, in a view. */
  #positionsAt({ frame, t }) {
    if (frame) return { positions: this.frames.positions, other: this.frames.positions };
    const { before, after } = this.page;
    return { positions: t > 0.5 ? after.positions : before.positions, other: null };
  }

  #meanEdgeLength() {
    const { positions } = this.page.before;
    const { triangles } = this.page;
    const a = new Vector3(), b = new Vector3();
    let sum = 0, count = 0;
    for (let t = 0; t < triangles.length; t += 3 * Math.max(1, Math.floor(triangles.length / 3000))) {
      sum += a.fromArray(positions, 3 * triangles[t]).distanceTo(b.fromArray(positions, 3 * triangles[t + 1]));
      count += 1;
    }
    return count ? sum / count : 1;
  }

  #showLegend(full) {
    const node = byId('legend');
    const { state, surface } = this;
    const isScale = surface.shared.heated.value;
    node.classList.toggle('of-colours', !isScale);
    node.hidden = false;
    if (isScale) fillLegend(node, full, state.range, this.page.scene.diagonal, () => this.changeRange());
    else {
      const red = this.before.count > 0 || this.after?.count > 0;
      node.hidden = !fillColourLegend(node, { red, curves: state.curves && state.layout !== 'replay', picked: state.face >= 0, held: this.#isAnyHeld });
    }
  }

  #showCaptions() {
    const { layout } = this.state;
    const { allowed } = this.page.scene;
    const words = (pairs, passing) => (pairs ? plural(pairs, 'intersecting pair', 'intersecting pairs') : 'no self-intersections')
      + (passing ? ` ${pairs ? 'and' : 'but'} ${passing} allowed` : '');
    const captions = { first: null, second: null };
    if (layout === 'pair' || layout === 'wipe') {
      captions.first = ['before', words(this.before.count, allowed?.before)];
      captions.second = ['after', words(this.after.count, allowed?.after)];
    } else if (layout === 'single') {
      captions.first = [this.page.scene.input, words(this.before.count, allowed?.before)];
    } else if (layout === 'replay') {
      const { phase, strategy, iteration, pairs, allowed: passing } = this.page.frames[this.state.frame];
      const moment = phase === 'input' ? 'before' : phase === 'result' ? 'after' : `${phase}${strategy ? `, ${strategy}` : ''}, iteration ${iteration}`;
      captions.first = [moment, words(pairs, passing)];
    }
    for (const [name, text] of Object.entries(captions)) {
      const node = byId(`caption-${name}`);
      node.hidden = !text;
      if (text) [node.children[0].textContent, node.children[1].textContent] = text;
      node.dataset.layout = layout;
    }
  }

  #showPlayer() {
    const { layout, blend, frame } = this.state;
    const slider = byId('slider');
    byId('player').hidden = !['blend', 'replay'].includes(layout);
    document.querySelector('main').classList.toggle('with-player', !byId('player').hidden);
    if (layout === 'blend') {
      slider.max = 1;
      slider.step = 'any';
      slider.value = blend;
      byId('slider-first').textContent = 'before';
      byId('slider-second').textContent = 'after';
    } else if (layout === 'replay') {
      slider.max = this.page.frames.length - 1;
      slider.step = 1;
      slider.value = frame;
      byId('slider-first').textContent = 'before';
      byId('slider-second').textContent = `${frame} of ${this.page.frames.length - 1}`;
    }
  }

  #fillPanel() {
    const { scene } = this.page;
    document.title = `${scene.input} – unsnarl`;
    byId('file-name').textContent = scene.output ? `${scene.input} → ${scene.output}` : scene.input;
    byId('file-name').title = byId('file-name').textContent;
    const [words, mood] = statusOf(scene, this.before, this.after);
    Object.assign(byId('status'), { textContent: words, hidden: false }).dataset.mood = mood;
    this.panelSelection = this.#selection(-1);
    this.history = historySection(scene.report?.history, this.page.frames, (k) => {
      this.setLayout('replay');
      this.setFrame(k);
      this.update();
    });
    const sections = summary(this.page, this.before, this.after);
    byId('facts').replaceChildren(sections[0], this.panelSelection, ...this.history ? [this.history.node] : [], ...sections.slice(1));
    for (const button of byId('layout').children) button.hidden = !this.#layouts().includes(button.dataset.value);
    byId('layout').hidden = !this.page.after;
    for (const button of byId('colouring').children) {
      button.hidden = !this.#colourings().includes(button.dataset.value);
      if (button.dataset.value === 'texture' && !this.#hasImages()) button.textContent = 'Materials';
    }
    byId('colouring').hidden = this.#colourings().length < 2;
  }

  #wire() {
    const { signal } = this.#wires;
    const on = (id, type, action) => byId(id).addEventListener(type, action, { signal });
    for (const id of ['layout', 'colouring'])
      on(id, 'click', ({ target }) => {
        if (!target.dataset.value) return;
        if (id === 'layout') this.setLayout(target.dataset.value);
        else this.setColouring(target.dataset.value);
      });
    for (const id of ['edges', 'curves']) on(id, 'click', () => this.toggle(id));
    on('save', 'click', () => this.save());
    on('play', 'click', () => this.play());
    on('slider', 'input', ({ target }) => {
      this.stop();
      if (this.state.layout === 'replay') this.setFrame(Number(target.value));
      else this.state.blend = Number(target.value);
      this.update();
    });
    this.#wireDivider();
    this.#wirePicking();
  }

  #wireDivider() {
    const { signal } = this.#wires;
    const divider = byId('divider');
    divider.addEventListener('pointerdown', (event) => divider.setPointerCapture(event.pointerId), { signal });
    divider.addEventListener('pointermove', (event) => {
      if (!divider.hasPointerCapture(event.pointerId)) return;
      const box = byId('stage').getBoundingClientRect();
      this.state.divider = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
      this.update();
    }, { signal });
  }

  /** A click that did not drag picks; a double click looks there. */
  #wirePicking() {
    const { canvas } = this.stage;
    let down = null;
    canvas.addEventListener('pointerdown', (event) => { down = [event.clientX, event.clientY, event.button]; });
    canvas.addEventListener('pointerup', (event) => {
      if (!down || down[2] !== 0 || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
      const box = canvas.getBoundingClientRect();
      this.pick(this.#faceAt(event.clientX - box.left, event.clientY - box.top));
    });
    canvas.addEventListener('dblclick', () => this.lookAtPicked());
  }

  #faceAt(x, y) {
    const { before, after } = this.page;
    if (this.state.layout === 'replay') return this.stage.faceAt(x, y, this.frames.positions, this.frames.positions);
    return this.stage.faceAt(x, y, before.positions, after?.positions ?? before.positions);
  }
}
