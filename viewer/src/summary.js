import { element } from './element.js';
import { fileList } from './files.js';
import { count, duration, percent, percentAndLength, plural, short } from './numbers.js';
import { classInWords } from './pair_classes.js';

/** What each status of a report means: [words, mood]. */
const statuses = {
  embedded: ['Embedded', 'good'],
  reduced: ['Self-intersections left', 'bad'],
  no_progress: ['No progress', 'bad'],
  obstructed: ['Obstructed', 'fair'],
  allowed: ['No self-intersections but allowed ones', 'good'],
  not_nested: ['Not nested as asked', 'fair'],
  time_limit: ['Time limit reached', 'fair'],
  memory_limit: ['Memory limit reached', 'fair'],
  displacement_exceeded: ['Displacement exceeded', 'fair'],
  gap_not_met: ['Gap not met', 'fair'],
  cancelled: ['Interrupted', 'fair'],
};

/** The mesh in one phrase, and its mood: by the report, or by the pairs that are left. */
export function statusOf({ report, allowed }, before, after) {
  if (report && statuses[report.status]) return statuses[report.status];
  const shown = after ?? before;
  if (shown.count === 0 && (after ? allowed?.after : allowed?.before)) return statuses.allowed;
  return shown.count === 0 ? ['No self-intersections', 'good']
    : [plural(shown.count, 'intersecting pair', 'intersecting pairs'), 'bad'];
}

function pairsTable(before, after) {
  const rows = before.classNames.map((name, k) => [name, before.countByClass[k], after?.countByClass[k] ?? 0]);
  const row = (head, a, b, kind) => element('tr', { class: kind },
    element('th', { scope: 'row' }, head), element('td', { class: a ? 'some' : 'none' }, count(a)),
    after ? element('td', { class: b ? 'some' : 'none' }, count(b)) : null);
  return element('table', {},
    element('thead', {}, element('tr', {}, element('th', {}), element('th', { scope: 'col' }, after ? 'before' : 'pairs'),
      after ? element('th', { scope: 'col' }, 'after') : null)),
    element('tbody', {}, rows.map(([name, a, b]) => row(classInWords(name), a, b, a + b ? '' : 'empty')),
      row('all', before.count, after?.count ?? 0, 'total')));
}

function facts(list) {
  return element('dl', {}, list.filter(Boolean).flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)]));
}

function motion(page) {
  const { displacement, scene } = page;
  let moved = 0, sum = 0, most = 0;
  for (const d of displacement) {
    if (d > 0) moved += 1;
    sum += d;
    most = Math.max(most, d);
  }
  const length = (share) => percentAndLength(share, scene.diagonal);
  return facts([
    ['vertices moved', `${count(moved)} of ${count(scene.vertices)} (${percent(moved / Math.max(1, scene.vertices))})`],
    ['furthest', length(most)],
    ['on average', length(sum / Math.max(1, scene.vertices))],
  ]);
}

/** The smallest gap of the result and where it is, if one was asked for; else the smallest of the recovery. */
function gapInWords({ gap, min_gap_rel: met, diagonal }) {
  if (!gap) return met > 0 ? percentAndLength(met, diagonal) : null;
  const asked = `asked for ${percentAndLength(gap.asked_rel, diagonal)}`;
  if (!gap.faces) return `more than ${percentAndLength(2 * gap.asked_rel, diagonal)}, ${asked}`;
  return `${percentAndLength(gap.smallest_rel, diagonal)}, ${asked}; faces ${gap.faces.map(count).join(' and ')}, at ${gap.position.map(short).join(', ')}`;
}

function reportFacts(report) {
  const gap = gapInWords(report);
  const regions = report.regions?.length ?? 0;
  const allowed = (report.allowed?.before.total ?? 0) + (report.allowed?.after.total ?? 0);
  return facts([
    regions ? ['conflict regions', count(regions)] : null,
    allowed ? ['pairs that may intersect', `${count(report.allowed.before.total)} before, ${count(report.allowed.after.total)} after`] : null,
    gap ? [report.gap ? 'smallest gap' : 'smallest gap met', gap] : null,
    ['area', `${percent(report.area_change_rel)} change`],
    report.volume_change_rel ? ['volume', `${percent(report.volume_change_rel)} change`] : null,
    report.flipped_triangles ? ['flipped', plural(report.flipped_triangles, 'triangle', 'triangles')] : null,
    ['holds in 32 bits', report.float32_embedded ? 'yes' : 'no'],
    ['time', duration(report.seconds)],
  ]);
}

/** How each rigid part moved as a body. */
function rigidParts(parts, diagonal) {
  return facts(parts.map((part) => [part.name, part.translation_rel === 0 && part.rotation_deg === 0 ? 'at rest'
    : `shifted ${percentAndLength(part.translation_rel, diagonal)}, turned ${short(part.rotation_deg)}°`]));
}

const mostChanges = 10;

/** The components that are no longer what they were, most changed first, and advice. */
function changes({ changed_components: changed = [], advice = [] }) {
  const shown = changed.slice(0, mostChanges).map(({ message }) => message);
  if (changed.length > shown.length) shown.push(`and ${count(changed.length - shown.length)} more`);
  return [...shown, ...advice].map((words) => element('p', { class: 'note' }, words));
}

/** The sections of the panel that stay as they are. */
export function summary(page, before, after) {
  const { scene } = page;
  const { report } = scene;
  const section = (title, ...content) => element('section', {}, element('h2', {}, title), ...content);
  const files = fileList(scene);
  return [
    section('Intersecting pairs of faces', pairsTable(before, after),
      ...(report?.obstructions ?? []).map(({ message }) => element('p', { class: 'note' }, `Cannot be resolved: ${message}`))),
    page.displacement ? section('Motion: share of the diagonal (length)', motion(page)) : null,
    report ? section('Report', reportFacts(report)) : null,
    report && changes(report).length ? section('Parts', ...changes(report)) : null,
    report?.rigid_parts?.length ? section('Rigid parts', rigidParts(report.rigid_parts, report.diagonal)) : null,
    files ? section('Files', files) : null,
    page.appearance?.notes.length ? section('Texture', ...page.appearance.notes.map((note) => element('p', { class: 'note' }, note))) : null,
    section('Mesh', facts([
      files ? null : ['file', scene.input],
      scene.output ? ['repaired', scene.output] : null,
      ['vertices', count(scene.vertices)],
      ['faces', count(scene.faces)],
      ['diagonal', short(scene.diagonal)],
      report?.topology ? ['components', count(report.topology.components)] : null,
    ])),
  ].filter(Boolean);
}
