import { element } from '../../../viewer/src/element.js';
import { count, duration, percent } from '../../../viewer/src/numbers.js';
import { wordsOf } from './part_card.js';

const byId = (id) => document.getElementById(id);

/** Phases of the program in words. */
const phases = {
  read: 'Reading', diagnose: 'Looking for intersections', untangle: 'Untangling', recover: 'Moving back towards the input',
  certify: 'Checking the result', write: 'Writing the result',
};

/** The section of the panel in which a repair is asked for, watched and taken home. */
export class Task {
  #began = 0;
  #clock = 0;
  #progress = null;

  constructor({ onRepair, onCancel, onLetGo }) {
    this.onLetGo = onLetGo;
    byId('repair').addEventListener('click', onRepair);
    byId('cancel').addEventListener('click', onCancel);
    byId('options').addEventListener('submit', (event) => {
      event.preventDefault();
      onRepair();
    });
  }

  /** Another mesh: nothing is asked for or done yet. */
  reset() {
    byId('verdict').hidden = true;
    byId('downloads').hidden = true;
    byId('options').reset();
    byId('repair').textContent = 'Repair';
    byId('repair').className = 'primary';
    this.showRunning(false);
  }

  /** What the form asks for, see fixCommand; null where a field is wrong, which the browser then shows. */
  wanted() {
    if (!byId('options').checkValidity()) {
      byId('more').open = true;
      byId('options').reportValidity();
      return null;
    }
    return {
      gap: Number(byId('gap').value), mostMotion: Number(byId('most-motion').value), minutes: Number(byId('minutes').value),
      isAbsolute: byId('unit').value === 'absolute', holdBoundary: byId('hold-boundary').checked,
    };
  }

  showHeld(held) {
    byId('held').replaceChildren(held.length
      ? element('ul', { 'aria-label': 'Held still' }, held.map((part) => element('li', {},
        element('span', {}, wordsOf(part)),
        element('button', { 'aria-label': `Let ${wordsOf(part)} move`, onclick: () => this.onLetGo(part) }, '✕'))))
      : element('p', { class: 'hint' }, 'Click a part of the mesh to hold it still. Everything may move now.'));
  }

  showRunning(isRunning) {
    for (const id of ['running', 'cancel']) byId(id).hidden = !isRunning;
    for (const id of ['repair', 'held', 'more']) byId(id).hidden = isRunning;
    clearInterval(this.#clock);
    if (!isRunning) return;
    byId('verdict').hidden = true;
    byId('downloads').hidden = true;
    this.#began = performance.now();
    this.#progress = { fraction: 0, phase: 'read', pairs_left: null };
    this.#clock = setInterval(() => this.#draw(), 500);
    this.#draw();
    byId('cancel').focus({ preventScroll: true });
  }

  /** A line of the program's standard error. */
  take(line) {
    if (!line.startsWith('{')) return;
    try {
      this.#progress = JSON.parse(line);
    } catch {
      return;  // a message of another kind
    }
    this.#draw();
  }

  showVerdict({ mood, title, lines }) {
    const node = byId('verdict');
    node.hidden = false;
    node.dataset.mood = mood;
    node.replaceChildren(element('b', {}, title), ...lines.map((line) => element('p', {}, line)));
  }

  /** files: [{ words, name, bytes, type, isMain }]; said: what the program wrote for people; command: how to say it there. */
  showDownloads(files, said, command) {
    for (const old of byId('downloads').querySelectorAll('a')) URL.revokeObjectURL(old.href);
    byId('downloads').hidden = false;
    byId('downloads').replaceChildren(
      element('div', { class: 'links' }, files.map(({ words, name, bytes, type, isMain }) =>
        element('a', { class: isMain ? 'button primary' : 'button', download: name.split('/').at(-1),
          href: URL.createObjectURL(new Blob([bytes], { type })) },
        words, element('small', {}, `${name.split('/').at(-1)}, ${size(bytes.length)}`)))),
      element('details', {}, element('summary', {}, 'What the program said'),
        element('pre', {}, said.trim()), element('p', { class: 'hint' }, 'The same at a terminal:'), element('pre', {}, command)));
    byId('repair').textContent = 'Repair again';
    byId('repair').classList.remove('primary');
    byId('repair').classList.add('plain');
  }

  #draw() {
    const { fraction, phase, pairs_left: left, displacement_rel: moved } = this.#progress;
    byId('bar').value = fraction ?? 0;
    byId('phase').textContent = `${phases[phase] ?? phase}, ${duration(Math.round((performance.now() - this.#began) / 1000))}`;
    byId('counts').textContent = left === null || left === undefined ? '\u00a0'
      : `${count(left)} intersecting ${left === 1 ? 'pair' : 'pairs'} left, moved up to ${percent(moved ?? 0)} of the diagonal`;
  }
}

function size(bytes) {
  return bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1e3))} KB` : `${(bytes / 1e6).toFixed(1)} MB`;
}
