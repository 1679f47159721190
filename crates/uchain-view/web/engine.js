// @ts-check
// The engine: the simulator as wasm, spoken to in JSON. One instance holds one flight.

const ENCODER = new TextEncoder();
const DECODER = new TextDecoder();

/** What the engine says is wrong: place, what was expected, remedy. */
export class EngineError extends Error {
  /** @param {{message: string, line?: number|null, column?: number|null, key?: string|null, hint?: string|null}} what */
  constructor(what) {
    super(what.message);
    this.name = "EngineError";
    this.line = what.line ?? null;
    this.column = what.column ?? null;
    this.key = what.key ?? null;
    this.hint = what.hint ?? null;
  }

  /** The message with its hint, for a line of text. */
  get words() {
    return this.hint ? `${this.message} (${this.hint})` : this.message;
  }
}

/** @type {Promise<WebAssembly.Module>|null} */
let compiled = null;

/** The wasm of this page, compiled once: base64 of gzip in a script element. */
function module() {
  compiled ??= (async () => {
    const text = document.getElementById("engine")?.textContent ?? "";
    if (!text) throw new EngineError({ message: "this page has no engine in it", hint: "build it with `cargo xtask web`" });
    const raw = atob(text.trim());
    const packed = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; i += 1) packed[i] = raw.charCodeAt(i);
    const bytes = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
    return WebAssembly.compile(bytes);
  })();
  return compiled;
}

export class Engine {
  #module;
  /** @type {any} */
  #wasm;

  /** @param {WebAssembly.Module} module @param {WebAssembly.Instance} instance */
  constructor(module, instance) {
    this.#module = module;
    this.#wasm = instance.exports;
  }

  /** A new engine, empty. */
  static async start() {
    const code = await module();
    return new Engine(code, await WebAssembly.instantiate(code, {}));
  }

  /**
   * Asks the engine for one thing and returns its `ok`; throws `EngineError` with what is wrong.
   * @param {string} name @param {object} [args] @param {Uint8Array|null} [bytes]
   */
  do(name, args = {}, bytes = null) {
    const text = ENCODER.encode(JSON.stringify({ ...args, do: name }));
    const length = text.length + (bytes ? bytes.length + 1 : 0);
    let answer;
    try {
      const at = this.#wasm.input(length) >>> 0;
      const room = new Uint8Array(this.#wasm.memory.buffer, at, length);
      room.set(text);
      if (bytes) {
        room[text.length] = 0;
        room.set(bytes, text.length + 1);
      }
      const answered = this.#wasm.call(length) >>> 0;
      answer = JSON.parse(DECODER.decode(new Uint8Array(this.#wasm.memory.buffer, this.#wasm.answer() >>> 0, answered)));
    } catch (fault) {
      if (!(fault instanceof WebAssembly.RuntimeError || fault instanceof RangeError)) throw fault;
      throw this.#renew(name, fault);
    }
    if (answer.error) throw new EngineError(answer.error);
    return answer.ok;
  }

  /** The bytes or numbers that belong to the last answer; a copy. */
  payload() {
    const at = this.#wasm.payload() >>> 0;
    return new Uint8Array(this.#wasm.memory.buffer, at, this.#wasm.payload_len() >>> 0).slice();
  }

  /** After a trap an instance is useless: a new, empty one takes its place. */
  #renew(name, fault) {
    this.#wasm = new WebAssembly.Instance(this.#module, {}).exports;
    return new EngineError({
      message: `the engine gave up at "${name}" (${fault.message})`,
      hint: "it was started again, empty: open the flight once more",
    });
  }
}
