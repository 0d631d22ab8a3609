// The worker that runs an agent: the book's own kernels, in WebAssembly, and nothing else that decides a run.
//
// 1. `layout` (from Python) says what each kernel takes, and of which fields a plan, a memory and a state consist.
// 2. A run has a WebAssembly memory of its own, into which its arrays are laid one after the other.
// 3. Every request gets one answer, in order: `REQUESTS` at the end has them all.
// Places and velocities go out in board widths, y downward; inside they are pixels.

const ARRAYS = {
  float64: Float64Array, float32: Float32Array, int64: BigInt64Array, uint64: BigUint64Array, int16: Int16Array,
  int8: Int8Array, bool: Uint8Array,
};
const PAGE = 65536;
const MOST_GIGABYTES = 3;
const SLICE_MS = 4; // between two looks at the clock
const NODE = 2; // the source of a desire that comes from a node, in `plan.source`
const OWN = ["agent_position", "agent_velocity"]; // of a second body in the same tank; it shares all else
const VECTORS = ["position", "velocity", "objects", "boundaries", "landmarks"];
const TUNINGS = ["cartesian", "proximal", "polar", "angle", "length"];

let compiled = null;
let layout = null;
let run = null;
let look = { map: "", goal: null, field: 0 }; // the name of a map, a cell of it, and tiles a side

/** An error that the reader can mend, as a sentence. The words of all others are kept from the page. */
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
      throw new Refusal("This device has not enough memory for these maps. Choose coarser ones.");
    }
    this.exports = new WebAssembly.Instance(compiled, { env: { memory: this.memory } }).exports;
    this.end = this.exports.__heap_base.value;
    this.result = this.put("float64", [1]);
  }

  put(dtype, shape, values) {
    const count = shape.reduce((product, each) => product * each, 1);
    const at = Math.ceil(this.end / 64) * 64;
    this.end = at + count * ARRAYS[dtype].BYTES_PER_ELEMENT;
    const array = new ARRAYS[dtype](this.memory.buffer, at, count);
    if (values) fill(array, values);
    return array;
  }

  /** A named tuple: its scalars are given, and so may arrays be, in another tuple or in JSON; all else is 0. */
  tuple(kind, sizes, given = {}) {
    return Object.fromEntries(layout.tuples[kind].map(([name, [dtype, shape]]) => {
      if (shape === null || ArrayBuffer.isView(given[name])) return [name, given[name]];
      return [name, this.put(dtype, shape.map((each) => lengthOf(each, sizes)), given[name])];
    }));
  }

  call(name, sizes, given) {
    const { sizes: wanted, arguments: kinds, result } = layout.exports[name];
    const passed = wanted.map((each) => sizes[each]);
    for (const [argument, kind] of kinds) {
      const values = typeof kind === "string"
        ? layout.tuples[kind].map(([field]) => given[argument][field]) : [given[argument]];
      passed.push(...values.map((value) => (ArrayBuffer.isView(value) ? value.byteOffset : Number(value))));
    }
    if (this.exports[name](this.result.byteOffset, 0, ...passed) !== 0) throw new Error(`The kernel ${name} failed.`);
    const { buffer, byteOffset } = this.result;
    return result === "int64" ? Number(new BigInt64Array(buffer, byteOffset, 1)[0]) : this.result[0];
  }
}

function lengthOf(dimension, sizes) {
  if (typeof dimension === "number") return dimension;
  const [name, more] = dimension.split(" + ");
  return sizes[name] + Number(more || 0);
}

function fill(array, values) {
  const flat = values.flat();
  array.set(array instanceof BigInt64Array ? flat.map(BigInt) : flat);
}

function bytesOf(kind, sizes) {
  return layout.tuples[kind].filter(([, [, shape]]) => shape !== null).reduce((sum, [, [dtype, shape]]) =>
    sum + 64 + shape.reduce((product, each) => product * lengthOf(each, sizes), ARRAYS[dtype].BYTES_PER_ELEMENT), 0);
}

/** A run in a machine of its own: its plan laid out, all else at 0. */
function newRun({ plan: choices, world, steps, bin_steps }) {
  const sizes = {
    maps: choices.resolution.length, nodes: choices.vector.length, landmarks: choices.landmark.length,
    desires: choices.source.length, trace: choices.trace, creeps: world.n_creeps, bins: Math.ceil(steps / bin_steps),
  };
  const draft = new Machine(2 ** 20 + bytesOf("Plan", sizes)); // how much memory a run needs follows from its plan
  const laidOut = draft.tuple("Plan", sizes, choices);
  draft.call("lay_out", sizes, { plan: laidOut, n_creeps: world.n_creeps });
  const last = (name) => Number(laidOut[name].at(-1));
  Object.assign(sizes, { values: last("first"), cells: last("first_cell"), tracks: last("first_track") });
  sizes.traces = choices.memory_fade > 0 ? last("first_trace") : 0;
  sizes.trace_rows = 8 * sizes.traces;

  const bytes = 2 ** 20 + 8 * sizes.bins + bytesOf("Plan", sizes) + bytesOf("Memory", sizes)
    + bytesOf("Memory", { ...sizes, values: 0 }) + 3 * bytesOf("WaterWorldState", sizes);
  const machine = new Machine(bytes);
  const memory = machine.tuple("Memory", sizes);
  const state = machine.tuple("WaterWorldState", sizes);
  const shared = Object.fromEntries(Object.entries(state).filter(([name]) => !OWN.includes(name)));
  const made = {
    machine, sizes, world, steps, bin_steps, choices, memory, state, rules: world.rules, step: 0, reward: 0,
    plan: machine.tuple("Plan", sizes, choices),
    contacts: machine.put("int8", [world.n_creeps]),
    rewards: machine.put("float32", [sizes.bins]),
    hits: machine.put("int16", [sizes.bins, 2]),
    elsewhere: machine.tuple("Memory", sizes, { q: memory.q, known: memory.known }),
    there: machine.tuple("WaterWorldState", sizes, { ...shared, agent_velocity: state.agent_velocity }),
    second: machine.tuple("WaterWorldState", sizes, shared),
    player: null, slice: 16,
  };
  machine.call("lay_out", sizes, { plan: made.plan, n_creeps: world.n_creeps });
  return made;
}

const call = (name, more = {}) => run.machine.call(name, { ...run.sizes, ...more }, { ...run, ...more });

function begin(request) {
  run = null; // so that its memory can go before the next is made
  run = newRun(request);
  run.changes = [...(request.changes ?? [])];
  const { seed, run: index } = request;
  for (const [key, stream] of [[[index], run.state.stream], [[index, 0], run.memory.stream]]) {
    const words = run.machine.put("uint64", [4 + key.length]);
    words.set([seed, 0, 0, 0, ...key].map(BigInt));
    run.machine.call("start_stream", { words: words.length }, { words, stream });
  }
  call("reset_board");
  call("know_nothing");
  call("begin_tracks");
  lookAt({ map: request.map, goal: null, field: request.field });
  return frame();
}

/** Look at a map, or, if there is none of its name, at one whose cells are large enough to click. */
function lookAt(choice) {
  const [{ resolution, first_map }, names] = [run.choices, mapNames(run.choices)];
  look = { ...look, ...choice };
  if (names.includes(look.map)) return;
  const large = resolution.findLastIndex((each, m) => m < first_map[1] && each <= 7);
  Object.assign(look, { map: names[Math.max(0, large)], goal: null });
}

const nodeOf = (firstMaps, m) => firstMaps.findLastIndex((first) => first <= m);

function mapNames({ nodes, resolution, first_map }) {
  return resolution.map((each, m) => `${nodes[nodeOf(first_map, m)]} N${each}`);
}

/** The map that is looked at, as it is drawn, and the way to the goal that is chosen in it. */
function seen(m) {
  const { plan, choices } = run;
  const n = nodeOf(choices.first_map, m);
  return {
    name: look.map, vector: VECTORS[plan.vector[n]], tuning: TUNINGS[plan.tuning[n]], columns: Number(plan.columns[m]),
    rows: Number(plan.rows[m]), low_u: plan.low_u[m], scale_u: plan.scale_u[m], low_v: plan.low_v[m],
    scale_v: plan.scale_v[m], reach: [plan.high[2 * n], plan.high[2 * n + 1]],
    goal: look.goal, ways: look.goal === null ? null : valueFunction(m, look.goal),
  };
}

/** Go on as another agent, as `Run.change` does: a map that both have stays as it is, the desires of before do not. */
function become(choices) {
  const old = run;
  const keys = mapKeys(choices);
  if (choices.source.length === old.sizes.desires && keys.join() === mapKeys(old.choices).join()) {
    for (const [name, value] of Object.entries(run.plan)) {
      if (ArrayBuffer.isView(value) && choices[name]) fill(value, choices[name]);
      else if (name in choices) run.plan[name] = choices[name];
    }
    run.choices = choices;
    call("lay_out", { n_creeps: run.sizes.creeps });
    for (const each of [run.memory.pull, run.memory.landing, run.memory.worth]) each.fill(0);
  } else {
    run = newRun({ ...old, plan: choices });
    for (const name of Object.keys(old.state)) run.state[name].set(old.state[name]);
    for (const name of OWN) run.second[name].set(old.second[name]);
    for (const name of ["stream", "last_event", "activity", "attended"]) run.memory[name].set(old.memory[name]);
    run.rewards.set(old.rewards);
    const { step, reward, player, changes } = old;
    Object.assign(run, { step, reward, player, changes });
    call("know_nothing");
    call("begin_tracks");
    const oldKeys = mapKeys(old.choices);
    keys.forEach((key, m) => oldKeys.includes(key) && keepMap(old, oldKeys.indexOf(key), m));
    const isKept = keys.includes(oldKeys[mapNames(old.choices).indexOf(look.map)]);
    lookAt({ goal: isKept ? look.goal : null });
  }
}

function mapKeys({ first_map, first_landmark, resolution, nodes, trace, memory_fade, ...choices }) {
  return resolution.map((each, m) => {
    const n = nodeOf(first_map, m);
    const space = ["vector", "tuning", "low", "high"].map((name) => choices[name][n]);
    const landmarks = choices.landmark.slice(first_landmark[n], first_landmark[n + 1]);
    return JSON.stringify([nodes[n], each, trace, memory_fade > 0, space, landmarks]);
  });
}

/** Take over all that an old run knows of a map, and what led to its active cells. */
function keepMap(old, from, to) {
  const parts = [["first", ["q"]], ["first_cell", ["known"]],
    ["first_track", ["cell", "events", "trace_cell", "trace_rates", "trace_count", "remembered_count"]],
    ["first_trace", ["remembered", "remembered_at", "strength", "trace_weight", "trace_worth"]]];
  for (const [firsts, names] of parts) {
    const [begin, end] = [old.plan[firsts][from], old.plan[firsts][from + 1]].map(Number);
    for (const name of names) {
      const width = old.memory[name].length / Number(old.plan[firsts].at(-1));
      run.memory[name].set(old.memory[name].subarray(begin * width, end * width), Number(run.plan[firsts][to]) * width);
    }
  }
}

function advance({ steps, budget }) {
  const began = performance.now();
  const first = run.step;
  const end = Math.min(run.steps, first + steps);
  while (run.step < end && performance.now() - began < budget) {
    if (run.changes[0]?.step === run.step) become(run.changes.shift().plan);
    const next = Math.min(end, run.step + (run.player ? 1 : run.slice), run.changes[0]?.step ?? end);
    const before = performance.now();
    run.reward += call("rollout", { first_step: run.step, last_step: next });
    run.step = next;
    if (run.player) run.player.reward += call("step_second", { action: run.player.action });
    else if (performance.now() - before < SLICE_MS / 2) run.slice *= 2;
    else if (performance.now() - before > SLICE_MS && run.slice > 1) run.slice /= 2;
  }
  return frame(run.step - first);
}

function play({ action }) {
  if (action === null) run.player = null;
  else if (run.player) run.player.action = action;
  else {
    run.player = { action, reward: 0 };
    run.second.agent_position.set([0.1 * run.rules.width, 0.1 * run.rules.width]);
    run.second.agent_velocity.fill(0);
  }
  return frame();
}

function drag({ creep, x, y }) {
  const { width, radius } = run.rules;
  const inside = [x, y].map((each) => Math.min(width - radius, Math.max(radius, each * width)));
  run.state.creep_position.set(inside, 2 * creep);
  call("begin_tracks"); // a leap by another's hand is nothing to learn from
  return frame();
}

function frame(steps = 0) {
  const { state, second, player, rules, plan, memory, choices } = run;
  const body = ({ agent_position: at, agent_velocity: moving }) =>
    ({ x: at[0] / rules.width, y: at[1] / rules.width, vx: moving[0] / rules.width, vy: moving[1] / rules.width });
  const { creep_position: at, creep_direction: direction } = state;
  const creeps = Array.from(state.creep_speed, (speed, i) => ({
    x: at[2 * i] / rules.width, y: at[2 * i + 1] / rules.width, green: Boolean(state.creep_is_green[i]),
    vx: (speed * direction[2 * i]) / rules.width, vy: (speed * direction[2 * i + 1]) / rules.width,
  }));
  const agent = body(state);
  const maps = mapNames(choices);
  const m = maps.indexOf(look.map);
  const [from, to] = [plan.first_track[m], plan.first_track[m + 1]].map(Number);
  return {
    type: "frame", step: run.step, ended: run.step >= run.steps, reward: run.reward, rewards: run.rewards.slice(),
    maps, seen: seen(m), steps, agent, radius: rules.radius / rules.width, creeps,
    player: player && { ...body(second), reward: player.reward },
    active: Array.from(memory.cell.subarray(from, to), Number),
    nodes: choices.nodes.map((name, n) => ({ name, ...desire(n) })),
    landings: choices.desires.flatMap(({ source, target }, e) => (Number(plan.source[e]) !== NODE ? [] : [{
      source, target, recurs: source === target, valence: memory.worth[e],
      x: agent.x + memory.landing[3 * e], y: agent.y + memory.landing[3 * e + 1],
    }])),
    field: look.field ? field(look.field) : null,
  };
}

/** The desire vector of a node and its valence, as `Run.output` has it. */
function desire(node) {
  const { plan, memory: { pull, worth } } = run;
  const total = { x: 0, y: 0, valence: 0 };
  plan.target.forEach((target, e) => {
    if (Number(target) !== node) return;
    const [north, south, east, west] = pull.subarray(4 * e, 4 * e + 4);
    total.x += Math.sign(worth[e]) * (east - west);
    total.y += Math.sign(worth[e]) * (south - north);
    total.valence += worth[e];
  });
  return total;
}

const vectors = (count, valueOf) => Float32Array.from({ length: 2 * count }, (_, i) => {
  const place = i >> 1;
  return i % 2 ? valueOf(place, 1) - valueOf(place, 0) : valueOf(place, 2) - valueOf(place, 3);
});

function field(side) {
  const tiles = side * side;
  run.values = run.values?.length === 4 * tiles ? run.values : run.machine.put("float64", [tiles, 4]);
  call("survey", { side, tiles });
  return vectors(tiles, (tile, action) => run.values[4 * tile + action]);
}

/** What the agent knows of the way to one goal, in every cell of a map. */
function valueFunction(map, goal) {
  const [first, cells] = [Number(run.plan.first[map]), Number(run.plan.cells[map])];
  return vectors(cells, (cell, action) => run.memory.q[first + (4 * cell + action) * cells + goal]);
}

const REQUESTS = {
  async load(request) {
    layout = request.layout;
    compiled = await WebAssembly.compile(request.wasm);
    return { type: "ready" };
  },
  begin,
  change({ plan }) {
    become(plan);
    return frame();
  },
  /** `at`: a place, whose cell becomes the goal, or is no longer if it was. */
  look({ type, at, ...choice }) {
    lookAt(choice);
    const cell = at && call("cell_seen_at", { m: mapNames(run.choices).indexOf(look.map), ...at });
    if (at) look.goal = cell === look.goal ? null : cell;
    return frame();
  },
  advance,
  play,
  drag,
};

let last = Promise.resolve(); // so that answers keep the order of requests while the module is being compiled
onmessage = ({ data: request }) => {
  last = last.then(async () => {
    try {
      if (!run && !["load", "begin"].includes(request.type)) throw new Error("No run has begun.");
      postMessage(await REQUESTS[request.type](request));
    } catch (error) {
      postMessage({ type: "failed", message: error instanceof Refusal ? error.message : undefined });
    }
  });
};
