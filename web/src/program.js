// The command line program, over files in memory.
import { instantiate } from './module.js';

const folder = '/home/web_user/files'; // the working folder of the program
const newline = 10;

/** Bytes that come one by one. */
class ByteList {
  #bytes = new Uint8Array(1024);
  #size = 0;
  add(byte) {
    if (this.#size === this.#bytes.length) {
      const larger = new Uint8Array(2 * this.#size);
      larger.set(this.#bytes);
      this.#bytes = larger;
    }
    this.#bytes[this.#size++] = byte;
  }
  take() {
    const taken = this.#bytes.slice(0, this.#size);
    this.#size = 0;
    return taken;
  }
}

/** What is written to standard error, line by line. */
class LineReader {
  #line = new ByteList();
  #lines = [];
  #decoder = new TextDecoder();
  constructor(onLine) {
    this.onLine = onLine;
  }
  add(byte) {
    if (byte === newline) return this.#end('\n');
    this.#line.add(byte);
  }
  #end(ending) {
    const line = this.#decoder.decode(this.#line.take());
    this.#lines.push(line + ending);
    if (line + ending) this.onLine?.(line);
  }
  text() {
    this.#end('');
    return this.#lines.join('');
  }
}

function checkedName(name) {
  const parts = name.split('/');
  if (parts.some((part) => part === '' || part === '.' || part === '..'))
    throw new TypeError(
      `files: "${name}" is no name of a file in the working folder; give names such as "in.obj" or "frames/1.obj"`,
    );
  return name;
}

function putFiles(FS, files) {
  FS.mkdirTree(folder);
  FS.chdir(folder);
  for (const [name, bytes] of Object.entries(files)) {
    const at = `${folder}/${checkedName(name)}`;
    FS.mkdirTree(at.slice(0, at.lastIndexOf('/')));
    if (!(bytes instanceof Uint8Array) && typeof bytes !== 'string')
      throw new TypeError(`files: "${name}" is no Uint8Array; give the bytes of the file`);
    FS.writeFile(at, bytes);
  }
}

const isSame = (a, b) => a.length === b.length && a.every((byte, i) => byte === b[i]);

/** Every file of the working folder that is not as it was given, by its name. */
function changedFiles(FS, given) {
  const changed = {};
  const visit = (at) => {
    for (const name of FS.readdir(at).sort()) {
      if (name === '.' || name === '..') continue;
      const path = `${at}/${name}`;
      if (FS.isDir(FS.stat(path).mode)) {
        visit(path);
        continue;
      }
      const bytes = FS.readFile(path);
      const key = path.slice(folder.length + 1);
      const before = Object.hasOwn(given, key) ? given[key] : undefined;
      const old = typeof before === 'string' ? new TextEncoder().encode(before) : before;
      if (!old || !isSame(old, bytes)) changed[key] = bytes;
    }
  };
  visit(folder);
  return changed;
}

/** See `run` in index.d.ts. */
export async function runProgram(
  compiled,
  identity,
  args,
  { files = {}, input = new Uint8Array(), onOutput, signal } = {},
) {
  let exitCode, failure;
  let at = 0;
  const output = new ByteList();
  const isCancelled = () => failure !== undefined || (signal?.aborted ?? false);
  const errors = new LineReader((line) => {
    try {
      onOutput?.(line);
    } catch (error) {
      failure ??= error; // told when the program, which is asked to end, has done so
    }
  });
  const { FS, callMain } = await instantiate(compiled, {
    stdin: () => (at < input.length ? input[at++] : null),
    stdout: (byte) => output.add(byte & 255),
    stderr: (byte) => errors.add(byte & 255),
    isAskedToEnd: isCancelled,
    onExit: (code) => (exitCode = code),
    thisProgram: 'unsnarl',
  });
  FS.writeFile('/proc/self/exe', identity);
  putFiles(FS, files);
  try {
    callMain([...args]);
  } catch (error) {
    if (exitCode === undefined) throw new Error(`unsnarl stopped: ${error.message}`, { cause: error });
  }
  if (failure !== undefined) throw failure;
  const bytes = output.take();
  return {
    exitCode,
    stdout: new TextDecoder().decode(bytes),
    stdoutBytes: bytes,
    stderr: errors.text(),
    files: changedFiles(FS, files),
  };
}
