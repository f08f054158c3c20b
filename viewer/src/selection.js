import { element } from './element.js';
import { count, percentAndLength } from './numbers.js';

/** How many partner faces are listed; the rest is counted. */
const listed = 24;

function partnersOf(face, conflicts, title, onPick) {
  const partners = conflicts.partners(face);
  if (partners.length === 0) return [element('dt', {}, title), element('dd', { class: 'none' }, 'meets no face')];
  const byClass = new Map();
  for (const { face: other, kind } of partners) byClass.set(kind, [...byClass.get(kind) ?? [], other]);
  const lines = [...byClass].map(([kind, faces]) => element('div', {},
    element('span', { class: 'class' }, conflicts.classNames[kind].replace('_', '-')), ' ',
    ...faces.slice(0, listed).map((other) => element('button', { class: 'id', onclick: () => onPick(other) }, String(other))),
    faces.length > listed ? ` and ${count(faces.length - listed)} more` : null));
  return [element('dt', {}, title), element('dd', { class: 'partners' }, lines)];
}

/** What is known of the picked face: ids are 0-based, as the file counts. */
export function selectionSection(page, faces, before, after, face, onPick) {
  const title = element('h2', {}, 'Picked face');
  if (face < 0)
    return element('section', { id: 'selection' }, title,
      element('p', { class: 'hint' }, 'Click a face to see its ids and what it meets; N goes to the next intersecting one.'));
  const vertices = [...faces.of(face)];
  const moved = page.displacement ? Math.max(...vertices.map((v) => page.displacement[v])) : null;
  return element('section', { id: 'selection' }, title,
    element('dl', {},
      element('dt', {}, 'face'), element('dd', { id: 'picked-face' }, String(face)),
      element('dt', {}, 'vertices'), element('dd', { id: 'picked-vertices' }, vertices.join(', ')),
      moved === null ? null : [element('dt', {}, 'moved'),
        element('dd', {}, moved === 0 ? 'not at all' : `up to ${percentAndLength(moved, page.scene.diagonal)}`)],
      partnersOf(face, before, after ? 'before, meets' : 'meets', onPick),
      after ? partnersOf(face, after, 'after, meets', onPick) : null));
}
