import { element } from './element.js';

const keys = [
  ['drag · right drag · wheel', 'turn · move · zoom'],
  ['click', 'pick a face; double click looks at it'],
  ['1  2  3  4', 'side by side, divider, blend, iterations'],
  ['← →', 'move the slider, the divider or the iteration'],
  ['space', 'play'],
  ['C  M  D', 'colours: intersections, materials and textures, displacement'],
  ['R', 'range of the displacement scale'],
  ['E  X', 'edges, intersection curves'],
  ['N  P', 'next, previous intersecting face'],
  ['F', 'show all'],
  ['U', 'turn another axis up: y, z, x'],
  ['S', 'save a picture'],
  ['T', 'light or dark'],
  ['Esc', 'let the picked face go'],
];

/** more: further [key, meaning] of a page that has them. */
export function fillHelp(dialog, version, more = []) {
  document.getElementById('help-button').onclick = () => dialog.showModal();
  dialog.replaceChildren(
    element('h2', {}, 'Keys and mouse'),
    element('dl', {}, [...keys, ...more].flatMap(([key, meaning]) => [
      element('dt', {}, key.split(/ {2}| · /).flatMap((k, i) => [i ? ' ' : null, element('kbd', {}, k)])),
      element('dd', {}, meaning)])),
    element('p', {}, 'Red faces intersect another face; where they are hidden they show through as a tint. Curves are where '
      + 'faces cross. Side by side, both views have one camera.'),
    element('p', { class: 'fine' }, `Made by unsnarl ${version}, Apache-2.0. Contains three.js, MIT licence.`),
    element('form', { method: 'dialog' }, element('button', { class: 'plain' }, 'Close')));
}
