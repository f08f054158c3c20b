import { element } from './element.js';
import { short } from './numbers.js';

const size = { width: 288, height: 104, left: 52, right: 6, top: 10, bottom: 18 };

/** Decades that a logarithmic axis has at most, below its largest value: a term that is all but nothing lies on the ground. */
const mostDecades = 8;

/** Share of a logarithmic axis below its decades, where zeros lie. */
const room = 0.14;

/** Positions along an axis: logarithmic where values span more than two decades and none is negative. */
function axis(values, from, to) {
  const finite = values.filter((v) => Number.isFinite(v));
  const positive = finite.filter((v) => v > 0);
  const high = Math.max(...finite, 0);
  const low = Math.min(...finite, high);
  const least = Math.min(...positive, high);
  const logarithmic = low >= 0 && positive.length > 0 && high / least > 100;
  if (!logarithmic) {
    const bottom = Math.min(0, low);
    const span = high - bottom || 1;
    return { at: (v) => from + (to - from) * (v - bottom) / span, ticks: high > bottom ? [bottom, (high + bottom) / 2, high] : [high] };
  }
  const highest = Math.ceil(Math.log10(high));
  const decades = [Math.max(Math.floor(Math.log10(least)), highest - mostDecades), highest];
  const span = decades[1] - decades[0] || 1;
  const step = Math.ceil(span / 3);
  const bottom = low === 0 ? room : 0;
  const ticks = low === 0 ? [0] : [];
  for (let d = decades[1]; d >= decades[0]; d -= step) ticks.push(10 ** d);
  const share = (v) => (v > 0 ? bottom + (1 - bottom) * Math.max(0, Math.log10(v) - decades[0]) / span : 0);
  return { at: (v) => from + (to - from) * share(v), ticks };
}

/**
 * A small line chart. series: [{ name, values, colour }], one value an iteration, all of one length; NaN where there is
 * none. marks: iterations at which something new begins. onPick(i): an iteration was clicked.
 */
export function chart(title, series, { marks = [], onPick = null } = {}) {
  const { width, height, left, right, top, bottom } = size;
  const length = series[0].values.length;
  const x = (i) => left + (width - left - right) * (length > 1 ? i / (length - 1) : 0.5);
  const y = axis(series.flatMap((s) => s.values), height - bottom, top);
  const line = (values) => {
    let path = '';
    let open = false;
    values.forEach((v, i) => {
      if (!Number.isFinite(v)) { open = false; return; }
      path += `${open ? 'L' : 'M'}${x(i).toFixed(1)} ${y.at(v).toFixed(1)}`;
      open = true;
    });
    return path;
  };
  const cursor = element('svg:line', { class: 'cursor', y1: top, y2: height - bottom, visibility: 'hidden' });
  const reading = element('span', { class: 'reading' });
  const svg = element('svg:svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': title },
    y.ticks.map((tick) => [
      element('svg:line', { class: 'grid', x1: left, x2: width - right, y1: y.at(tick), y2: y.at(tick) }),
      element('svg:text', { x: left - 6, y: y.at(tick) + 3, 'text-anchor': 'end' }, short(tick))]).flat(),
    marks.filter((i) => i > 0).map((i) => element('svg:line', { class: 'mark', x1: x(i), x2: x(i), y1: top, y2: height - bottom })),
    element('svg:text', { x: left, y: height - 4 }, '0'),
    element('svg:text', { x: width - right, y: height - 4, 'text-anchor': 'end' }, String(length - 1)),
    series.map((s) => element('svg:path', { d: line(s.values), class: 'line', style: `stroke: var(--series-${s.colour})` })),
    cursor);
  const key = element('div', { class: 'key' }, element('b', {}, title),
    series.length > 1 ? series.map((s) => element('span', { style: `--own: var(--series-${s.colour})` }, s.name)) : null, reading);
  const showAt = (i) => {
    cursor.setAttribute('visibility', i === null ? 'hidden' : 'visible');
    reading.textContent = '';
    if (i === null) return;
    cursor.setAttribute('x1', x(i));
    cursor.setAttribute('x2', x(i));
    reading.textContent = `${i}: ${series.map((s) => short(s.values[i])).join(' · ')}`;
  };
  const iterationAt = (event) => {
    const box = svg.getBoundingClientRect();
    const share = ((event.clientX - box.left) / box.width * width - left) / (width - left - right);
    return Math.min(length - 1, Math.max(0, Math.round(share * (length - 1))));
  };
  svg.addEventListener('pointermove', (event) => showAt(iterationAt(event)));
  svg.addEventListener('pointerleave', () => showAt(null));
  if (onPick) svg.addEventListener('click', (event) => onPick(iterationAt(event)));
  return { node: element('figure', { class: onPick ? 'chart picks' : 'chart' }, key, svg), showAt };
}
