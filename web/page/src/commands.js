/** Arguments of the program, and the names of what it writes. */

const splitName = (name) => {
  const at = name.lastIndexOf('.');
  return at > name.lastIndexOf('/') + 1 ? [name.slice(0, at), name.slice(at)] : [name, ''];
};

/** A name that nothing has yet: "hand.obj" with "_fixed" -> "hand_fixed.obj", "hand_fixed_2.obj". */
function freeName(stem, ending, taken) {
  let name = stem + ending;
  for (let k = 2; Object.keys(taken).some((other) => other === name || other.startsWith(`${name}/`)); ++k)
    name = `${stem}_${k}${ending}`;
  return name;
}

// A name that begins with "-" is none of an option.
const asPath = (name) => (name.startsWith('-') ? `./${name}` : name);

const sceneFlag = ({ meshes }) => (meshes.length === 2 ? ['--scene'] : []);

/** Writes the data of the viewer to `page`. */
export function viewCommand(input) {
  const page = freeName('view', '.html', input.files);
  return { page, args: ['view', ...input.meshes.map(asPath), ...sceneFlag(input), '-o', page, '--quiet'] };
}

export const checkCommand = ({ meshes }) => ['check', ...meshes.map(asPath), '--json'];

/**
 * Repairs. wanted: { held: parts, gap, mostMotion, isAbsolute, minutes, holdBoundary }; gap and mostMotion in percent of
 * the diagonal, or in the units of the file; 0: none. The result goes to a folder of its own, as a glTF has files beside
 * it that keep their names. Returns { args, files: of the input and what makes that folder, page, report }.
 */
export function fixCommand(input, wanted) {
  const [stem, ending] = splitName(input.meshes[0].split('/').at(-1));
  const isScene = input.meshes.length > 1;
  const folder = freeName('fixed', '', input.files);
  const output = isScene ? folder : `${folder}/${stem}_fixed${ending}`;
  const page = freeName(isScene ? 'scene' : stem, '.html', input.files);
  const report = freeName(isScene ? 'scene_report' : `${stem}_report`, '.json', input.files);
  const length = (value) => String(wanted.isAbsolute ? value : value / 100);
  const args = ['fix', ...input.meshes.map(asPath), '-o', asPath(output), '--view', asPath(page), '--report', asPath(report),
    '--progress', 'json', ...wanted.held.map(({ kind, name }) => `--fix-${kind}=${name}`)];
  if (wanted.gap > 0) args.push('--min-gap', length(wanted.gap));
  if (wanted.mostMotion > 0) args.push('--max-displacement', length(wanted.mostMotion));
  if (wanted.isAbsolute && (wanted.gap > 0 || wanted.mostMotion > 0)) args.push('--absolute');
  if (wanted.minutes > 0) args.push('--time-limit', String(60 * wanted.minutes));
  if (wanted.holdBoundary) args.push('--fix-boundary');
  return { args, page, report, files: { ...input.files, [`${folder}/.folder`]: new Uint8Array(0) } };
}

/** The command for a terminal that does the same, without what only the page needs. */
export function spokenCommand(args) {
  const quoted = (word) => (/^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);
  const dropped = new Set();
  for (const option of ['--view', '--report', '--progress'])
    if (args.includes(option)) dropped.add(args.indexOf(option)).add(args.indexOf(option) + 1);
  return `unsnarl ${args.filter((_, k) => !dropped.has(k)).map(quoted).join(' ')}`;
}
