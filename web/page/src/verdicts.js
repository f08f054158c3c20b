import { plural } from '../../../viewer/src/numbers.js';

/** What to do after each status of the report; docs/troubleshooting.md says more. */
const advice = {
  reduced: 'Hold fewer parts, relax the limits, or repair the rest by hand: the red faces are where.',
  no_progress: 'Hold fewer parts, relax the limits, or repair the place by hand: the red faces are where.',
  obstructed: 'Everything else is repaired. Hold fewer parts if that is what is in the way.',
  time_limit: 'Give it more time, or download the result so far, open it here and go on from there.',
  cancelled: 'Download what was reached, open it here and go on from there.',
  memory_limit: 'The program for the command line has more memory than a page.',
  displacement_exceeded: 'Allow larger moves if the rest is to be repaired too.',
  gap_not_met: 'Nothing intersects, but somewhere there is no room for the gap. Ask for less, or hold fewer parts.',
};

/** How a repair ended: { mood, title, lines }. report: of the program; pairs: intersecting before and after. */
export function verdictOf(report, before, after) {
  const lines = (report.obstructions ?? []).map(({ message }) => `Not repaired: ${message}.`);
  if (advice[report.status]) lines.push(advice[report.status]);
  if (report.status === 'embedded') {
    return before === 0
      ? { mood: 'good', title: 'There was nothing to repair', lines: ['The result is the file that you gave, byte for byte.'] }
      : { mood: 'good', title: 'Repaired: nothing intersects any more',
        lines: ['The file to download was read back, and every pair of its faces tested with exact arithmetic.'] };
  }
  if (report.status === 'gap_not_met') return { mood: 'fair', title: 'Repaired, but a gap is smaller than asked for', lines };
  const left = after === 0 ? 'nothing intersects, but it is not finished' : `${plural(after, 'pair', 'pairs')} of ${before} left`;
  const why = { time_limit: 'Stopped at the time limit: ', memory_limit: 'Out of memory: ', cancelled: 'Cancelled: ', displacement_exceeded: 'Stopped at the largest move: ' };
  return { mood: after < before ? 'fair' : 'bad', title: capital(`${why[report.status] ?? ''}${left}`), lines };
}

const capital = (words) => words[0].toUpperCase() + words.slice(1);

/** Why a run of the program gave nothing: the last message on standard error, without the name of the program. */
export function complaintOf({ stderr, exitCode }) {
  const lines = stderr.split('\n').filter((line) => line && !line.startsWith('{'));
  const said = lines.findLast((line) => line.startsWith('unsnarl: ')) ?? lines.at(-1);
  return said ? said.replace(/^unsnarl: /, '') : `the program ended with exit code ${exitCode} and said nothing`;
}

/** What to do about a file that could not be read, where the message does not say; null: nothing more to say. */
export function adviceOnReading(complaint) {
  if (/cannot open: No such file/.test(complaint)) return 'Drop the missing file together with the mesh.';
  if (/tells the format/.test(complaint)) return 'Formats: OBJ, OFF, PLY, STL, glTF, GLB, 3MF, VTK, VTP, FreeSurfer, GIFTI, Gmsh, Abaqus.';
  return null;
}

/** What to say where the browser or the program broke down. */
export function breakdown(words) {
  if (/webgl/i.test(words)) return 'This browser cannot draw: WebGL is switched off or missing.';
  if (/webassembly|wasm/i.test(words)) return 'This browser is too old to run the program. Chromium 111, Firefox 121, Safari 16.4, or newer can.';
  if (/memory|allocat|RangeError/i.test(words))
    return 'The mesh needs more memory than a page of a browser may have. The program for the command line can take it.';
  return `The program broke down: ${words}`;
}
