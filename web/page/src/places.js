import { element } from '../../../viewer/src/element.js';
import { count, plural } from '../../../viewer/src/numbers.js';

/** So many places are listed; the rest is counted. */
const listed = 40;

/** Where the mesh intersects itself, worst first: found by `unsnarl check --json`. onGo(place) */
export function fillPlaces(node, places, onGo) {
  node.hidden = !places?.length;
  if (node.hidden) return node.replaceChildren();
  return node.replaceChildren(element('h2', {}, plural(places.length, 'place', 'places')),
    element('ol', {}, places.slice(0, listed).map((place, k) => element('li', {},
      element('button', { onclick: () => onGo(place) },
        element('span', {}, `Place ${k + 1}`),
        element('small', {}, `${plural(place.pairs, 'pair', 'pairs')}, ${plural(place.faces, 'face', 'faces')}`))))),
    ...places.length > listed ? [element('p', { class: 'hint' }, `and ${count(places.length - listed)} more`)] : []);
}

/** The middle and the radius of a place in the units of the viewer. */
export function sphereOf({ min, max }, { centre, diagonal }) {
  const unit = diagonal > 0 ? diagonal : 1;
  const middle = min.map((low, k) => ((low + max[k]) / 2 - centre[k]) / unit);
  return { middle, radius: Math.hypot(...min.map((low, k) => max[k] - low)) / 2 / unit };
}
