import { listenToKeys } from '../../../viewer/src/keyboard.js';
import { readPage } from '../../../viewer/src/page_data.js';
import { flagPart, partsOfFace, samePart } from '../../../viewer/src/parts.js';
import { Viewer } from '../../../viewer/src/viewer.js';
import { checkCommand, fixCommand, spokenCommand, viewCommand } from './commands.js';
import { readInput } from './input_files.js';
import { fillPartCard } from './part_card.js';
import { fillPlaces, sphereOf } from './places.js';
import { Stopped } from './program.js';
import { Task } from './task.js';
import { Trouble } from './trouble.js';
import { adviceOnReading, breakdown, complaintOf, verdictOf } from './verdicts.js';

const byId = (id) => document.getElementById(id);

async function pageOf(bytes) {
  return readPage(new DOMParser().parseFromString(new TextDecoder().decode(bytes), 'text/html'));
}

/** The whole page: one input at a time, its viewer, and the repair of it. */
export class App {
  input = null;  // see readInput
  viewer = null;
  held = [];  // parts, see viewer/src/parts.js
  #keys = null;

  constructor(program, theme) {
    this.program = program;
    this.theme = theme;
    this.task = new Task({ onRepair: () => this.repair(), onCancel: () => this.cancel(), onLetGo: (part) => this.toggleHeld(part) });
    byId('busy').querySelector('button').addEventListener('click', () => this.cancel());
    byId('trouble').querySelector('button').addEventListener('click', () => this.#showTrouble(null));
  }

  /** Opens files: [{ name, file }]; what is open stays so if they cannot be read. */
  open(list) {
    return this.#openWith(list.length === 1 ? list[0].name : `${list.length} files`, () => readInput(list));
  }

  openSample(name) {
    return this.#openWith(name, async () => {
      const file = `${name}.obj`;
      const { files } = await this.program.run(['sample', name, '-o', file]);
      return { meshes: [file], files: { [file]: files[file] } };
    });
  }

  /** Repairs the input as the form and the held parts say. */
  async repair() {
    const wanted = this.task.wanted();
    if (!this.viewer || this.isRepairing || !wanted) return;
    this.#showTrouble(null);
    this.isRepairing = true;
    this.task.showRunning(true);
    const { input } = this;
    const command = fixCommand(input, { ...wanted, held: this.held });
    try {
      const run = await this.program.run(command.args, command.files, (line) => this.task.take(line));
      if (!run.files[command.page]) throw new Trouble('The repair could not be done', complaintOf(run));
      const page = await pageOf(run.files[command.page]);
      this.task.showRunning(false);
      this.#show(page);
      this.#showResult(command, run);
    } catch (error) {
      this.task.showRunning(false);
      if (error instanceof Stopped) this.task.showVerdict({ mood: 'fair', title: 'Cancelled', lines: ['Nothing was changed.'] });
      else this.#showTrouble(error, 'The repair could not be done');
    } finally {
      this.isRepairing = false;
      this.program.goOn();
      // The button that had the focus is gone; keys go to the drawing.
      if ([document.body, byId('cancel')].includes(document.activeElement)) byId('canvas').focus({ preventScroll: true });
    }
  }

  /** A repair that can be asked to end keeps what it has reached; a second call does not wait for that. */
  cancel() {
    if (!this.isRepairing || !this.program.askToEnd()) this.program.stop();
  }

  /** Holds a part, or lets it go. */
  toggleHeld(part) {
    const others = this.held.filter((other) => !samePart(part, other));
    this.held = others.length < this.held.length ? others : [...this.held, part];
    this.#showHeld();
  }

  /** The same of the smallest part that the picked face is of. */
  toggleHeldOfPicked() {
    const face = this.viewer?.state.face ?? -1;
    const [part] = face < 0 ? [] : partsOfFace(this.viewer.page, face);
    if (part) this.toggleHeld(part);
  }

  async #openWith(name, read) {
    this.#showTrouble(null);
    this.program.stop();
    const began = performance.now();
    const done = this.#busy(`Reading ${name} …`);
    try {
      const input = await read();
      const command = viewCommand(input);
      const run = await this.program.run(command.args, input.files);
      if (run.exitCode !== 0) {
        const complaint = complaintOf(run);
        throw new Trouble(`${input.meshes.join(', ')} cannot be read`, complaint, adviceOnReading(complaint));
      }
      const page = await pageOf(run.files[command.page]);
      this.input = input;
      this.held = [];
      document.body.classList.remove('empty');
      scrollTo(0, 0);  // on a phone the drawing is above all else
      this.viewer?.dispose();
      this.viewer = null;
      this.task.reset();
      this.#show(page);
      this.#showPicked(-1);
      done();
      await this.viewer.stage.drawn();
      this.firstPictureSeconds = (performance.now() - began) / 1000;
      await this.#listPlaces(input);
    } catch (error) {
      if (!(error instanceof Stopped)) this.#showTrouble(error, `${name} cannot be shown`);
    } finally {
      done();
    }
  }

  /** A viewer of this page instead of the one that is there; the view stays if it is of the same input. */
  #show(page) {
    const { viewer: old } = this;
    this.#keys?.abort();
    this.#keys = new AbortController();
    old?.dispose();
    this.viewer = new Viewer(page, this.theme, { onPick: (face) => this.#showPicked(face) });
    if (old) this.viewer.lookLike(old);
    listenToKeys(this.viewer, { signal: this.#keys.signal,
      more: { g: () => this.repair(), h: () => this.toggleHeldOfPicked(), o: () => byId('file-input').click() } });
    this.#showHeld();
    byId('task').dataset.pairs = this.viewer.before.count ? 'some' : 'none';
  }

  #showHeld() {
    const flags = new Uint8Array(this.viewer.page.scene.faces);
    for (const part of this.held) flagPart(this.viewer.page, part, flags);
    this.viewer.setHeld(flags);
    this.task.showHeld(this.held);
    this.#showPicked(this.viewer.state.face);
  }

  #showPicked(face) {
    fillPartCard(byId('part-card'), this.viewer?.page, face, this.held, (part) => this.toggleHeld(part));
  }

  #showResult(command, { files, stderr }) {
    const { report } = this.viewer.page.scene;
    this.task.showVerdict(verdictOf(report, this.viewer.before.count, this.viewer.after.count));
    const isWhole = report.output.written;
    const results = Object.keys(files).filter((name) => name !== command.page && name !== command.report);
    const words = isWhole ? 'Download the mesh' : 'Download what was reached';
    this.task.showDownloads([
      ...results.map((name, k) => ({ words: results.length > 1 ? `Download ${name.split('/').at(-1)}` : words, name,
        bytes: files[name], type: 'application/octet-stream', isMain: k === 0 })),
      { words: 'Report', name: command.report, bytes: files[command.report], type: 'application/json' },
      { words: 'Page to look at', name: command.page, bytes: files[command.page], type: 'text/html' },
    ], stderr.split('\n').filter((line) => !line.startsWith('{')).join('\n'), spokenCommand(command.args));
  }

  async #listPlaces(input) {
    fillPlaces(byId('places'), null);
    if (this.viewer.before.count === 0) return;
    const { stdout } = await this.program.run(checkCommand(input), input.files);
    if (this.input !== input || !stdout.startsWith('{')) return;
    fillPlaces(byId('places'), JSON.parse(stdout).places, (place) => this.#goTo(place));
  }

  #goTo(place) {
    const { middle, radius } = sphereOf(place, this.viewer.page.scene);
    this.viewer.pick(place.first_face);
    this.viewer.lookAt(middle, Math.max(1.2 * radius, 0.01));
  }

  /** Says so until the function that it returns is called; not of what takes a moment only. */
  #busy(words) {
    const node = byId('busy');
    node.querySelector('span').textContent = words;
    const soon = setTimeout(() => { node.hidden = false; }, 150);
    return () => {
      clearTimeout(soon);
      node.hidden = true;
    };
  }

  /** title: of what is no Trouble; null: there is none. */
  #showTrouble(error, title) {
    const node = byId('trouble');
    node.hidden = !error;
    if (!error) return;
    const isKnown = error instanceof Trouble;
    if (!isKnown) console.warn(error);
    node.querySelector('b').textContent = isKnown ? error.title : title;
    node.querySelector('p').textContent = isKnown ? error.message : breakdown(String(error.message));
    node.querySelector('.advice').textContent = error.advice ?? '';
  }
}
