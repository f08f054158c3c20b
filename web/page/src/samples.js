import { element } from '../../../viewer/src/element.js';

const pictures = import.meta.glob('./samples/*.webp', { eager: true, import: 'default' });

/** Built-in samples: [name, words]; each shows another use. */
const samples = [
  ['crossing_tubes', 'Two tubes through each other'],
  ['posed_limb', 'A forearm pressed into the belly'],
  ['dressed_figure', 'A tunic with folds in the body'],
  ['trefoil_tube', 'A knot that is too thick'],
  ['jellyfish', 'A scene of many parts'],
  ['anchored_balls', 'Balls around a post: hold it still'],
];

/** Fills the list of samples. onChoose(name) */
export function fillSamples(list, onChoose) {
  list.replaceChildren(...samples.map(([name, words]) => element('li', {},
    element('button', { 'data-sample': name, onclick: () => onChoose(name) },
      pictures[`./samples/${name}.webp`] ? element('img', { src: pictures[`./samples/${name}.webp`], alt: '', width: 200, height: 132 }) : null,
      element('span', {}, words)))));
}
