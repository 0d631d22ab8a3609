// The memory of the engine's kernels: arrays, named tuples of them, records, and calls with these.
//
// `layout` has the fields of tuples and records, and the arguments of kernels; this file is independent of their meaning.

const ARRAYS = {
  float64: Float64Array, float32: Float32Array, int64: BigInt64Array, uint64: BigUint64Array, int16: Int16Array,
  int8: Int8Array, bool: Uint8Array,
};
const PAGE = 65536;
const MOST_GIGABYTES = 3;

let compiled = null;
let layout = null;

/** An error that the reader can fix, with a message to show. The messages of other errors are not shown. */
class Refusal extends Error {}

/** Arrays in a WebAssembly memory, and the kernels that work on them. */
class Machine {
  constructor(bytes) {
    const gigabytes = bytes / 2 ** 30;
    if (gigabytes > MOST_GIGABYTES) {
      throw new Refusal(`These maps need ${gigabytes.toFixed(1)} GB of memory, and a page can have ${MOST_GIGABYTES}.`
        + " Choose coarser ones.");
    }
    try {
      this.memory = new WebAssembly.Memory({ initial: Math.ceil(bytes / PAGE) });
    } catch {
      throw new Refusal("This device does not have enough memory for these maps. Choose coarser ones.");
    }
    this.exports = new WebAssembly.Instance(compiled, { env: { memory: this.memory } }).exports;
    this.end = this.exports.__heap_base.value;
    this.result = this.put("float64", [1]);
  }

  /** The first free address. */
  free() {
    return Math.ceil(this.end / 64) * 64;
  }

  put(dtype, shape, values) {
    const at = this.free();
    const array = view(this.memory.buffer, dtype, at, shape);
    this.end = at + array.byteLength;
    if (values) fill(array, values);
    return array;
  }

  /** A record, filled with given values. */
  record(kind, given = {}) {
    const bytes = this.put("int8", [layout.records[kind].size]);
    const record = recordIn(this.memory.buffer, kind, bytes.byteOffset);
    assign(record, given);
    return Object.assign(record, { bytes });
  }

  /** A named tuple. Its scalars are given; arrays may be given, from another tuple or JSON, and are otherwise 0. */
  tuple(kind, sizes, given = {}) {
    return Object.fromEntries(layout.tuples[kind].map(([name, field]) => {
      if (typeof field === "string") return [name, this.tuple(field, sizes, given[name])];
      const [dtype, shape] = field;
      if (shape === null || ArrayBuffer.isView(given[name])) return [name, given[name]];
      return [name, this.put(dtype, shape.map((each) => lengthOf(each, sizes)), given[name])];
    }));
  }

  /** Call a kernel with a table of its arguments, which is written behind all arrays. */
  call(name, sizes, given) {
    const { arguments: kinds, result } = layout.exports[name];
    const { buffer, byteOffset } = this.result;
    const [words, table] = [wordsOf(kinds, given, sizes), this.free()];
    const [numbers, integers] = [Float64Array, BigInt64Array].map((type) => new type(buffer, table, words.length));
    words.forEach(([dtype, value], place) => {
      if (dtype.startsWith("float")) numbers[place] = value;
      else integers[place] = BigInt(value);
    });
    if (this.exports[name](byteOffset, 0, table) !== 0) throw new Error(`The kernel ${name} failed.`);
    return result === "int64" ? Number(new BigInt64Array(buffer, byteOffset, 1)[0]) : this.result[0];
  }
}

/** The words of a table, [type, value]: a number as it is, an array as its address and lengths, a tuple as its fields. */
function wordsOf(kinds, given, sizes) {
  return kinds.flatMap(([name, field]) => {
    const value = given[name];
    if (value === undefined) throw new Error(`The argument ${name} is missing.`);
    if (typeof field === "string") return wordsOf(layout.tuples[field], value, sizes);
    const [dtype, shape] = field;
    if (shape === null) return [[dtype, value]];
    if (dtype === "Agent") return [["int64", value.bytes.byteOffset]];
    return [["int64", value.byteOffset], ...shape.map((each) => ["int64", lengthOf(each, sizes)])];
  });
}

function lengthOf(dimension, sizes) {
  if (typeof dimension === "number") return dimension;
  const [name, more] = dimension.split(" + ");
  return sizes[name] + Number(more || 0);
}

function fill(array, values) {
  const flat = values.flat();
  array.set(array instanceof BigInt64Array || array instanceof BigUint64Array ? flat.map(BigInt) : flat);
}

function bytesOf(kind, sizes) {
  return layout.tuples[kind].reduce((sum, [, field]) => {
    if (typeof field === "string") return sum + bytesOf(field, sizes);
    const [dtype, shape] = field;
    if (shape === null) return sum;
    return sum + 64 + shape.reduce((product, each) => product * lengthOf(each, sizes), bytesOfOne(dtype));
  }, 0);
}

const bytesOfOne = (dtype) => layout.records[dtype]?.size ?? ARRAYS[dtype].BYTES_PER_ELEMENT;

/** An array of numbers; of records, their bytes. */
function view(buffer, dtype, at, shape) {
  const count = shape.reduce((product, each) => product * each, 1);
  return dtype in ARRAYS ? new ARRAYS[dtype](buffer, at, count) : new Uint8Array(buffer, at, count * bytesOfOne(dtype));
}

/** Records of a kind, from one row up to another, in an array of their bytes. */
function rowsOf(bytes, kind, begin, end) {
  return Array.from({ length: end - begin }, (_, row) =>
    recordIn(bytes.buffer, kind, bytes.byteOffset + (begin + row) * layout.records[kind].size));
}

/** A record in memory: a number is a property, an array a view, and a table a list of the rows in use. */
function recordIn(buffer, kind, at) {
  const { fields } = layout.records[kind];
  return Object.defineProperties({}, Object.fromEntries(fields.map(([name, dtype, offset, shape]) => {
    const place = at + offset;
    if (!(dtype in ARRAYS)) {
      let within = null; // once it is asked for
      const rows = (count) => Array.from({ length: count }, (_, row) =>
        recordIn(buffer, dtype, place + row * bytesOfOne(dtype)));
      return [name, { get() { return within ??= shape.length ? rows(this[`n_${name}`]) : rows(1)[0]; } }];
    }
    const array = view(buffer, dtype, place, shape);
    if (shape.length) return [name, { value: array }];
    return [name, { get: () => Number(array[0]), set: (value) => fill(array, [value]) }];
  })));
}

/** Write values into the fields of a record that have their names. */
function assign(record, values) {
  for (const [name, value] of Object.entries(values)) {
    if (ArrayBuffer.isView(record[name])) fill(record[name], value);
    else if (Array.isArray(record[name])) value.forEach((row, index) => assign(record[name][index], row));
    else if (typeof record[name] === "object") assign(record[name], value);
    else if (name in record) record[name] = value;
  }
}
