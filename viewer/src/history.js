import { chart } from './chart.js';
import { element } from './element.js';
import { plural } from './numbers.js';

/** How many regions can be chosen from; those with the most iterations. */
const offered = 60;

const numbers = (list) => (list ?? []).map((v) => (v === null ? NaN : v));
const hasAny = (values) => values.some((v) => Number.isFinite(v));

function regionCharts(region) {
  const charts = [];
  const pairs = numbers(region.pairs);
  if (pairs.some((n) => n > 0)) charts.push(chart('Intersecting pairs', [{ name: 'pairs', values: pairs, colour: 0 }]));
  const energies = Object.entries(region.energy ?? {}).map(([name, values]) => ({ name, values: numbers(values) }))
    .filter(({ values }) => hasAny(values)).map((s, i) => ({ ...s, colour: i + 1 }));
  if (energies.length) charts.push(chart('Energy', energies));
  const gaps = numbers(region.min_gap);
  if (hasAny(gaps)) charts.push(chart('Smallest gap (length)', [{ name: 'gap', values: gaps, colour: 0 }]));
  const steps = numbers(region.step);
  if (hasAny(steps)) charts.push(chart('Largest step (length)', [{ name: 'step', values: steps, colour: 0 }]));
  return charts.map(({ node }) => node);
}

function regionName({ phase, strategy, region, pairs }) {
  return `${phase}${strategy ? `, ${strategy}` : ''}, region ${region}: ${plural(pairs.length, 'iteration', 'iterations')}`;
}

/**
 * Charts of the whole (pairs over the recorded frames; a click goes there) and of one region at a time. Returns null where
 * neither is known; show(k) marks a frame.
 */
export function historySection(history, frames, onFrame) {
  const regions = (history ?? []).filter((r) => r.pairs?.length > 1)
    .sort((a, b) => b.pairs.length - a.pairs.length).slice(0, offered);
  if (regions.length === 0 && frames.length < 2) return null;
  const section = element('section', { id: 'history' }, element('h2', {}, 'History'));
  let whole = null;
  if (frames.length > 1) {
    const stage = (k) => `${frames[k].phase} ${frames[k].strategy}`;
    const marks = frames.map((_, k) => k).filter((k) => k > 0 && stage(k) !== stage(k - 1));
    whole = chart('Intersecting pairs, all', [{ name: 'pairs', values: frames.map((f) => f.pairs), colour: 0 }],
      { marks, onPick: onFrame });
    section.append(whole.node);
  }
  if (regions.length > 0) {
    const charts = element('div', {}, regionCharts(regions[0]));
    const choose = element('select', { 'aria-label': 'Region', onchange: (event) =>
      charts.replaceChildren(...regionCharts(regions[event.target.selectedIndex])) },
      regions.map((region) => element('option', {}, regionName(region))));
    section.append(choose, charts);
  }
  return { node: section, show: (k) => whole?.showAt(k) };
}
