import { element } from '../../../viewer/src/element.js';
import { partsOfFace, samePart } from '../../../viewer/src/parts.js';

export const wordsOf = ({ kind, name }) => `${kind} ${name}`;

/** Over the drawing, for the picked face: the parts that it is of, to be held or let go by a click. */
export function fillPartCard(node, page, face, held, onToggle) {
  node.hidden = face < 0;
  if (face < 0) return;
  node.replaceChildren(element('b', {}, 'Hold still'), ...partsOfFace(page, face).map((part) => {
    const isHeld = held.some((other) => samePart(part, other));
    return element('button', { 'aria-pressed': String(isHeld), onclick: () => onToggle(part),
      title: isHeld ? 'Let it move again' : 'It keeps its place in the repair' }, wordsOf(part));
  }));
}
