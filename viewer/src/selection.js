import { element } from './element.js';
import { count, percentAndLength } from './numbers.js';
import { classInWords } from './pair_classes.js';
import { partsOfFace } from './parts.js';

/** How many partner faces are listed; the rest is counted. */
const listed = 24;

function partnersOf(face, conflicts, title, onPick) {
  const partners = conflicts.partners(face);
  if (partners.length === 0) return [element('dt', {}, title), element('dd', { class: 'none' }, 'meets no face')];
  const byClass = new Map();
  for (const { face: other, kind } of partners) byClass.set(kind, [...byClass.get(kind) ?? [], other]);
  const lines = [...byClass].map(([kind, faces]) => element('div', {},
    element('span', { class: 'class' }, classInWords(conflicts.classNames[kind])), ' ',
    ...faces.slice(0, listed).map((other) => element('button', { class: 'id', onclick: () => onPick(other) }, String(other))),
    faces.length > listed ? ` and ${count(faces.length - listed)} more` : null));
  return [element('dt', {}, title), element('dd', { class: 'partners' }, lines)];
}

/**
 * What is known of the picked face: ids are 0-based, as the file counts. onPick(face); onNext(1 or -1) goes to the next or
 * the previous face that intersects another.
 */
export function selectionSection(page, faces, before, after, face, { onPick, onNext }) {
  const step = (by, words, key) => element('button', { class: 'plain', onclick: () => onNext(by), title: `${key}` }, words);
  const steps = before.count + (after?.count ?? 0) > 0
    ? element('div', { class: 'steps' }, step(-1, '‹ previous', 'P'), step(1, 'next ›', 'N')) : null;
  const title = element('div', { class: 'title' }, element('h2', {}, 'Picked face'), steps);
  if (face < 0)
    return element('section', { id: 'selection' }, title,
      element('p', { class: 'hint' }, `Click a face to see its ids and what it meets${
        steps ? '; the buttons go through those that intersect another' : ''}.`));
  const vertices = [...faces.of(face)];
  const moved = page.displacement ? Math.max(...vertices.map((v) => page.displacement[v])) : null;
  return element('section', { id: 'selection' }, title,
    element('dl', {},
      element('dt', {}, 'face'), element('dd', { id: 'picked-face' }, String(face)),
      element('dt', {}, 'vertices'), element('dd', { id: 'picked-vertices' }, vertices.join(', ')),
      partsOfFace(page, face).map(({ kind, name }) => [element('dt', {}, kind), element('dd', {}, name)]).flat(),
      moved === null ? null : [element('dt', {}, 'moved'),
        element('dd', {}, moved === 0 ? 'not at all' : `up to ${percentAndLength(moved, page.scene.diagonal)}`)],
      partnersOf(face, before, after ? 'before, meets' : 'meets', onPick),
      after ? partnersOf(face, after, 'after, meets', onPick) : null));
}
