// All tests use these: the package as it was built, the native program of the same sources, and comparisons of both.
//
// UNSNARL_PACKAGE: the folder of the package, out/npm/unsnarl otherwise. UNSNARL_PROGRAM: the native program,
// build/release/unsnarl otherwise.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, relative, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

export const here = dirname(fileURLToPath(import.meta.url));
export const project = resolve(here, '../..');
export const packageFolder = resolve(process.env.UNSNARL_PACKAGE ?? join(project, 'out/npm/unsnarl'));
export const program = resolve(process.env.UNSNARL_PROGRAM ?? join(project, 'build/release/unsnarl'));
if (!existsSync(program))
  throw new Error(`${program}: the native program is not there; build it (./demo), or name it in UNSNARL_PROGRAM`);

export const { load, loadInWorker, UnsnarlError } = await import(pathToFileURL(join(packageFolder, 'index.js')));
export const unsnarl = await load();

/** A new folder that is gone after the test. */
export function temporaryFolder(t) {
  const folder = mkdtempSync(join(tmpdir(), 'unsnarl-web-'));
  t.after(() => rmSync(folder, { recursive: true, force: true }));
  return folder;
}

/** All files in a folder and below, by name: {name: Buffer}. */
export function filesIn(folder) {
  const names = readdirSync(folder, { recursive: true }).map((name) => join(folder, name));
  return Object.fromEntries(
    names
      .filter((name) => statSync(name).isFile())
      .sort()
      .map((name) => [relative(folder, name), readFileSync(name)]),
  );
}

/** What the native program does in a folder with these files; the result is as of unsnarl.run. */
export function runNative(args, { files = {}, input } = {}) {
  const folder = mkdtempSync(join(tmpdir(), 'unsnarl-native-'));
  try {
    for (const [name, bytes] of Object.entries(files)) {
      mkdirSync(dirname(join(folder, name)), { recursive: true });
      writeFileSync(join(folder, name), bytes);
    }
    const { status, stdout, stderr } = spawnSync(program, args, {
      cwd: folder,
      input: input ?? '',
      maxBuffer: 2 ** 30,
    });
    const all = Object.entries(filesIn(folder));
    const changed = all.filter(([name, bytes]) => !(name in files && Buffer.from(files[name]).equals(bytes)));
    return {
      exitCode: status,
      stdout: stdout.toString(),
      stdoutBytes: stdout,
      stderr: stderr.toString(),
      files: Object.fromEntries(changed),
    };
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Without what differs from run to run. */
export function withoutTimes(text) {
  return text
    .replace(/\d+(\.\d+)?(e-?\d+)? (s|min|h|MB)\b/g, 'N $3')
    .replace(/"(seconds|cpu_seconds|peak_memory_mb|threads)": ?-?[\d.e+-]+/g, '"$1": N');
}

/** Runs both: the same exit code, words and files. Files in `but` differ in times, those in `other` may differ. Returns what
 * the package did. */
export async function runBoth(args, options = {}, { but = [], other = [] } = {}) {
  const there = runNative(args, options);
  const here = await unsnarl.run(args, options);
  const what = `unsnarl ${args.join(' ')}`;
  assert.equal(here.exitCode, there.exitCode, `${what}: ${here.stderr}\n${there.stderr}`);
  assert.equal(withoutTimes(here.stderr), withoutTimes(there.stderr), what);
  assert.equal(withoutTimes(here.stdout), withoutTimes(there.stdout), what);
  assert.deepEqual(Object.keys(here.files).sort(), Object.keys(there.files).sort(), what);
  for (const [name, bytes] of Object.entries(here.files)) {
    if (other.includes(name)) continue;
    const same = but.includes(name)
      ? withoutTimes(Buffer.from(bytes).toString()) === withoutTimes(there.files[name].toString())
      : there.files[name].equals(bytes);
    assert.ok(same, `${what}: ${name} is not as of the native program`);
  }
  return here;
}

/** The file of a sample, as the native program writes it. */
export const sampleFile = (name, file, ...args) => runNative(['sample', name, '-o', file, ...args]).files[file];
