// The C interface (include/unsnarl/unsnarl.h) of one instance: memory is never given back, since the instance goes after
// the call.
import { instantiate } from './module.js';
import { fill, optionsStruct, surfaceStruct } from './structs.js';

/** What the library refuses, or fails of. `code`: one of codes, below. */
export class UnsnarlError extends Error {
  constructor(code, message) {
    super(message);
    this.name = 'UnsnarlError';
    this.code = code;
  }
}

const codes = {
  1: 'invalid_argument',
  2: 'cannot_read',
  3: 'cannot_write',
  4: 'out_of_memory',
  5: 'system_error',
  6: 'limit_reached',
};
const arrayTypes = [Float64Array, Int32Array, Uint8Array];
const pairKindCount = 5;

export class Library {
  #module;

  /** settings: as of instantiate(). */
  static async open(compiled, settings) {
    const library = new Library();
    library.#module = await instantiate(compiled, settings);
    return library;
  }

  get #memory() {
    return this.#module.HEAPU8.buffer;
  }

  #allocated(size) {
    const at = this.#module._malloc(Math.max(size, 1)) >>> 0;
    if (at === 0) throw new UnsnarlError('out_of_memory', 'the mesh does not fit into the 4 GB that WebAssembly has');
    return at;
  }

  /** Returns the address of a copy of a typed array; 0 for undefined. */
  copied(array) {
    if (array === undefined) return 0;
    const at = this.#allocated(array.byteLength);
    new Uint8Array(this.#memory, at, array.byteLength).set(
      new Uint8Array(array.buffer, array.byteOffset, array.byteLength),
    );
    return at;
  }

  /** Returns the address of a text; 0 for undefined. */
  text(text) {
    return text === undefined ? 0 : this.copied(new TextEncoder().encode(`${text}\0`));
  }

  #textAt(address) {
    const bytes = new Uint8Array(this.#memory);
    const at = address >>> 0;
    return at === 0 ? undefined : new TextDecoder().decode(bytes.slice(at, bytes.indexOf(0, at)));
  }

  #struct(layout, values) {
    const at = this.#allocated(layout.size);
    new Uint8Array(this.#memory, at, layout.size).fill(0);
    fill(this.#memory, layout, at, { size: layout.size, ...values });
    return at;
  }

  /** fields: those of unsnarl_surface, arrays as typed arrays. */
  surface(fields) {
    const values = Object.entries(fields).map(([name, value]) => [
      name,
      ArrayBuffer.isView(value) ? this.copied(value) : value,
    ]);
    return this.#struct(surfaceStruct, Object.fromEntries(values));
  }

  /** given: options by the names of the struct, as texts, numbers and booleans. */
  options(given) {
    const at = this.#allocated(optionsStruct.size);
    this.#check(this.#module._unsnarl_options_init(at, optionsStruct.size));
    const values = Object.entries(given).map(([name, value]) => [
      name,
      optionsStruct.fields[name].kind === 'address' ? this.text(value) : Number(value),
    ]);
    fill(this.#memory, optionsStruct, at, Object.fromEntries(values));
    return at;
  }

  /** A context that tells settings.onProgress. */
  context() {
    return this.#module._unsnarl_context_of_javascript();
  }

  #check(code) {
    if (code === 0) return;
    throw new UnsnarlError(codes[code] ?? 'internal_error', this.#textAt(this.#module._unsnarl_error_message()));
  }

  /** Calls unsnarl_NAME(...given, &result) and returns {status, report, array(name)}. */
  call(name, ...given) {
    const place = this.#allocated(4);
    this.#check(this.#module[`_unsnarl_${name}`](...given, place));
    const result = new DataView(this.#memory).getUint32(place, true);
    return {
      status: this.#textAt(this.#module._unsnarl_result_status(result)),
      report: JSON.parse(this.#textAt(this.#module._unsnarl_result_report(result)) || 'null'),
      array: (array) => this.#array(result, array),
    };
  }

  #array(result, name) {
    const at = this.#allocated(16);
    this.#check(this.#module._unsnarl_result_array(result, this.text(name), at));
    const view = new DataView(this.#memory, at, 16);
    const [data, rows, columns, type] = [0, 4, 8, 12].map((offset) => view.getUint32(offset, true));
    return new arrayTypes[type](this.#memory, data, rows * columns).slice();
  }

  version() {
    return this.#textAt(this.#module._unsnarl_version());
  }

  pairKinds() {
    return Array.from({ length: pairKindCount }, (_, kind) => this.#textAt(this.#module._unsnarl_pair_kind(kind)));
  }
}
