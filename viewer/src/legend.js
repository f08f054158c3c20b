import { element } from './element.js';
import { percent, short } from './numbers.js';

/** Displacement up to which the scale reaches: of every vertex, or of all but the furthest hundredth of those that moved. */
export function heatRanges(displacement) {
  const moved = displacement.filter((d) => d > 0).sort();
  if (moved.length === 0) return { all: 1, most: 1 };
  return { all: moved[moved.length - 1], most: moved[Math.floor(0.99 * (moved.length - 1))] };
}

/**
 * What the colours of intersections mean. shown: { red: are there any, curves: are they drawn, picked: is a face, held: are any }.
 * False: nothing to explain.
 */
export function fillColourLegend(node, { red, curves, picked, held }) {
  const entries = [
    red ? ['--red', '', 'intersects another face'] : null,
    red && curves ? ['--curve', 'line', 'where faces cross'] : null,
    held ? ['--held', '', 'held still'] : null,
    picked ? ['--selected', '', 'picked face'] : null,
    picked && red ? ['--partner', '', 'faces that it meets'] : null,
  ].filter(Boolean);
  node.replaceChildren(element('ul', {}, entries.map(([colour, kind, words]) => element('li', {},
    element('i', { class: kind, style: `--own: var(${colour})` }), words))));
  return entries.length > 0;
}

/** The colour scale of displacement; a click changes its range. */
export function fillLegend(node, full, range, diagonal, onChange) {
  const ticks = [0, 0.25, 0.5, 0.75, 1];
  node.replaceChildren(
    element('h3', {}, 'Displacement', element('small', {}, ' of the diagonal')),
    element('div', { class: 'scale' }),
    element('div', { class: 'ticks' }, ticks.map((share) => element('span', {},
      share === 0 ? '0' : percent(share * share * full)))),
    element('div', { class: 'foot' },
      element('span', {}, `${percent(full)} is ${short(full * diagonal)} in the file's units`),
      element('button', { onclick: onChange, title: 'Change the range of the scale (R)' },
        range === 'all' ? 'full range' : 'up to the 99th percentile')));
}
