// The worker that runs an agent: the book's own kernels, in WebAssembly. Nothing else affects a run.
//
// 1. `layout` (from Python) describes the arguments of each kernel, the fields of its tuples, and its enumerations.
// 2. A run has a WebAssembly memory of its own, in which its arrays are placed one after the other.
// 3. Every request gets one answer, in order: `REQUESTS` at the end lists them all.
// Places and velocities are sent in units of the world's size, y downward; inside WaterWorld they are in pixels.

const SLICE_MS = 4; // between two readings of the clock
const [TRAIL, BETWEEN] = [3, 2]; // simulated seconds, and steps from one place of the trail to the next

const modules = {}; // by name, {layout, compiled}
let run = null;
// The name of a map, a cell of it, and the tiles along each side of the superposed value as a field and as a heat map.
let look = { map: "", goal: null, field: 0, heat: 0 };

/** A run in a machine of its own, with its parameters derived and everything else at 0. */
function newRun({ parameters: choices, world, steps, bin_steps }) {
  const { maps, nodes, axes, desires, contacts, frames, push } = choices;
  const sizes = {
    maps: maps.resolution.length, map_axes: mapAxes(choices), nodes: nodes.follows.length,
    node_axes: axes.what.length, boundaries: axes.boundary.length, landmarks: nodes.landmark.length,
    frames: frames.length, left: contacts.trace, desires: desires.source.length, coordinates: choices.coordinates,
    actions: push.length, axes: push[0].length, things: world.things, ...world.sizes,
    kinds: world.kinds.length, bins: Math.ceil(steps / bin_steps),
  };
  const draft = new Machine(2 ** 20 + bytesOf("Parameters", sizes)); // the memory of a run follows from its parameters
  const derived = draft.tuple("Parameters", sizes, choices);
  draft.call("derive", sizes, { parameters: derived, n_things: sizes.things });
  const last = (name) => Number(derived.maps[name].at(-1));
  Object.assign(sizes, { values: last("first_value"), cells: last("first_cell"), tracks: last("first_track"),
    traces: last("first_trace"), passed: last("first_passed") });
  sizes.scratch = sizes.actions * sizes.cells;
  sizes.trace_weights = 2 * sizes.actions * sizes.traces;

  const bytes = 2 ** 20 + 8 * sizes.bins + bytesOf("Parameters", sizes) + bytesOf("State", sizes)
    + bytesOf("State", { ...sizes, values: 0 }) + 3 * bytesOf(layout.state, sizes) + bytesOf(layout.rules, sizes);
  const machine = new Machine(bytes);
  const state = machine.tuple("State", sizes);
  const worldState = machine.tuple(layout.state, sizes);
  const { position, velocity, ...shared } = worldState.scene;
  const { q, goal_range } = state.values;
  const made = {
    machine, sizes, world, steps, bin_steps, choices, state, world_state: worldState, scene: worldState.scene,
    rules: machine.tuple(layout.rules, sizes, world.rules), step: 0, reward: 0,
    parameters: machine.tuple("Parameters", sizes, choices),
    clock: machine.put("int64", [2]),
    rewards: machine.put("float32", [sizes.bins]),
    hits: machine.put("int16", [sizes.bins, sizes.kinds]),
    elsewhere: machine.tuple("State", sizes, { values: { q, goal_range } }),
    there: machine.tuple("Scene", sizes, { ...shared, velocity }),
    second: machine.tuple("Scene", sizes, shared), // a second body in the same tank
    player: null, slice: 16, trail: [],
  };
  machine.call("derive", sizes, { parameters: made.parameters, n_things: sizes.things });
  return made;
}

/** The number of axes of all maps together. */
function mapAxes({ nodes: { first_map, first_axis, follows } }) {
  return follows.reduce((sum, _, n) =>
    sum + (first_map[n + 1] - first_map[n]) * (first_axis[n + 1] - first_axis[n]), 0);
}

const call = (name, more = {}) => run.machine.call(name, { ...run.sizes, ...more }, { ...run, ...more });

function begin(request) {
  const taught = request.keeps ? run.state.values : null; // of a run of the same agent, as in `Run.transfer`
  run = null; // so that its memory can be freed before the next is allocated
  ({ layout, compiled } = modules[request.world.module]);
  run = newRun(request);
  run.changes = [...(request.changes ?? [])];
  const { seed, run: index } = request;
  for (const [key, stream] of [[[index], run.world_state.stream], [[index, 0], run.state.stream]]) {
    const words = run.machine.put("uint64", [4 + key.length]);
    words.set([seed, 0, 0, 0, ...key].map(BigInt));
    run.machine.call("start_stream", { words: words.length }, { words, stream });
  }
  call("reset", { state: run.world_state });
  call("begin_values");
  call("begin");
  for (const name of taught ? ["q", "goal_range"] : []) run.state.values[name].set(taught[name]);
  lookAt({ map: request.map, goal: null, field: request.field, heat: request.heat });
  return frame();
}

/** Show a map, or, if there is none of that name, one whose cells are large enough to click. */
function lookAt(choice) {
  const { maps: { resolution }, nodes: { first_map } } = run.choices;
  const names = mapNames(run.choices);
  look = { ...look, ...choice };
  if (names.includes(look.map)) return;
  const large = resolution.findLastIndex((each, m) => m < first_map[1] && each <= 7);
  Object.assign(look, { map: names[Math.max(0, large)], goal: null });
}

const nodeOf = (firstMaps, m) => firstMaps.findLastIndex((first) => first <= m);

function mapNames({ names, maps, nodes }) {
  return maps.resolution.map((each, m) => `${names[nodeOf(nodes.first_map, m)]} N${each}`);
}

/** The numbers of intervals of a map along its axes, such as "5 × 5". */
function shapeOf(m) {
  const { grid, maps: { first_grid } } = run.parameters;
  const rows = grid.subarray(5 * Number(first_grid[m]), 5 * Number(first_grid[m + 1]));
  return Array.from({ length: rows.length / 5 }, (_, axis) => rows[5 * axis + 2] + 1).join(" × ");
}

/** The name of an enumeration's member, by number. */
const nameOf = (enumeration, number) =>
  Object.entries(layout.enumerations[enumeration]).find(([, each]) => each === Number(number))[0];

const learnsContacts = (m) => run.choices.nodes.learns_contacts[nodeOf(run.choices.nodes.first_map, m)];

/** Whether the state of a map is the self, always in the centre, so that each cell is a goal with values of its own. */
function isOfSelf({ nodes }, m) {
  return nodes.state[nodeOf(nodes.first_map, m)] !== layout.enumerations.MapState.object;
}

/** The map that is shown, as it is drawn, and the way to the goal chosen in it. */
function seen(m) {
  const { follows, ends, first_map } = run.choices.nodes;
  const vector = nameOf("Vector", follows[nodeOf(first_map, m)]);
  if (learnsContacts(m)) return { name: look.map, vector, axes: [], goal: null, ways: null }; // its cells are not goals
  return {
    name: look.map, vector, axes: axesOf(m), ends: ends[nodeOf(first_map, m)], ofSelf: isOfSelf(run.choices, m),
    goal: look.goal,
    ways: look.goal === null ? null : valueFunction(m, look.goal),
  };
}

/** How a map divides the axes of the vector that its node follows: other axes cannot be drawn in the world. */
function axesOf(m) {
  const { choices: { nodes, axes }, parameters: { grid, maps } } = run;
  const n = nodeOf(nodes.first_map, m);
  const [first, end] = [nodes.first_axis[n], nodes.first_axis[n + 1]];
  return axes.what.slice(first, end).flatMap(([vector, feature, along, cut], axis) => {
    const row = 5 * (Number(maps.first_grid[m]) + axis);
    const [low, scale, last, , stride] = grid.slice(row, row + 5);
    const inner = axes.boundary.slice(axes.first_boundary[first + axis], axes.first_boundary[first + axis + 1]);
    const borders = nameOf("Cut", cut) === "boundaries" ? [axes.low[first + axis], ...inner, axes.high[first + axis]]
      : Array.from({ length: last + 2 }, (_, index) => low + index / scale);
    if (nodes.ends[n] && nameOf("Cut", cut) === "centred") { // half of either outermost interval is beyond the range
      Object.assign(borders, { 0: axes.low[first + axis], [last + 1]: axes.high[first + axis] });
    }
    const isBearing = nameOf("Vector", vector) === "own"; // the only user-defined axis in a module
    if (vector !== nodes.follows[n] && !isBearing) return [];
    return [{ feature: isBearing ? "bearing" : nameOf("Feature", feature), along, stride, borders,
      closed: nameOf("Cut", cut) === "closed", high: axes.high[first + axis] }];
  });
}

function advance({ steps, budget }) {
  const began = performance.now();
  const first = run.step;
  const end = Math.min(run.steps, first + steps);
  const seen = Math.max(first, end - TRAIL * run.world.fps); // the trail to draw begins there
  while (run.step < end && performance.now() - began < budget) {
    if (run.changes[0]?.step === run.step) become(run.changes.shift().parameters);
    const isSeen = run.step >= seen;
    const slice = run.player ? 1 : isSeen ? Math.min(BETWEEN, run.slice) : run.slice;
    const next = Math.min(isSeen ? end : seen, run.step + slice, run.changes[0]?.step ?? end);
    const before = performance.now();
    run.reward = call("rollout", { last_step: next, total: run.reward });
    run.step = next;
    if (isSeen) leaveTrail();
    if (run.player) run.player.reward += stepSecond(run.player.action);
    else if (performance.now() - before > SLICE_MS && run.slice > 1) run.slice /= 2;
    else if (performance.now() - before < SLICE_MS / 2 && slice === run.slice) run.slice *= 2;
  }
  return frame(run.step - first);
}

/** Add the agent's place to the trail, and drop what is too long ago. */
function leaveTrail() {
  const [x, y] = run.scene.position.map((side) => side / run.choices.size);
  run.trail = [...run.trail, { x, y, step: run.step }].filter(({ step }) => run.step - step <= TRAIL * run.world.fps);
}

/** Let a run go on for as long again. Its bins stay as many, each twice as long. */
function extend() {
  for (const [totals, width] of [[run.rewards, 1], [run.hits, run.sizes.kinds]]) {
    const before = totals.slice();
    totals.fill(0);
    before.forEach((total, at) => { totals[width * Math.floor(at / width / 2) + (at % width)] += total; });
  }
  Object.assign(run, { steps: 2 * run.steps, bin_steps: 2 * run.bin_steps });
  return frame();
}

function play({ action }) {
  if (action === null) run.player = null;
  else if (run.player) run.player.action = action;
  else {
    run.player = { action, reward: 0 };
    run.second.position.fill(0.1 * run.rules.waterworld.width);
    run.second.velocity.fill(0);
  }
  return frame();
}

function stepSecond(action) {
  return call("step_second", { board: run.world_state, rules: run.rules.waterworld, action });
}

function drag({ creep, x, y }) {
  const { width, radius } = run.rules.waterworld;
  const inside = [x, y].map((each) => Math.min(width - radius, Math.max(radius, each * width)));
  run.scene.things.set(inside, 2 * creep);
  call("begin"); // nothing is learned from a jump that the reader caused
  return frame();
}

function frame(steps = 0) {
  const { state, scene, world, second, player, parameters, choices, choices: { size } } = run;
  const body = ({ position: at, velocity: moving }) =>
    ({ x: at[0] / size, y: at[1] / size, vx: moving[0] / size, vy: moving[1] / size });
  const agent = body(scene);
  const maps = mapNames(choices);
  const m = maps.indexOf(look.map);
  const [from, to] = [parameters.maps.first_track[m], parameters.maps.first_track[m + 1]].map(Number);
  return {
    type: "frame", step: run.step, ended: run.step >= run.steps, reward: run.reward, rewards: run.rewards.slice(),
    maps, shapes: maps.map((_, each) => shapeOf(each)), seen: seen(m), steps, agent, things: thingsOf(run),
    trail: run.trail, round: false, obstacles: [], ...VIEWS[world.name](run),
    player: player && { ...body(second), reward: player.reward },
    hits: world.kinds.map((kind, k) => ({ kind, counts: run.hits.filter((_, i) => i % world.kinds.length === k) })),
    wants: choices.desires.kind.flatMap((kind, e) =>
      (kind < 0 ? [] : [{ kind: world.kinds[kind], valence: choices.desires.valence[e] }])),
    active: learnsContacts(m) ? [] : Array.from(state.tracks.cell.subarray(from, to), Number),
    nodes: choices.names.map((name, n) => ({ name, ...desire(n) })),
    landings: choices.edges.flatMap(({ source, target }, e) => (source === "" ? [] : [{
      source, target, recurs: source === target, valence: state.desires.valence[e],
      x: agent.x + state.desires.target[3 * e], y: agent.y + state.desires.target[3 * e + 1],
    }])),
    field: look.field ? field(look.field) : null, heat: look.heat ? heat(look.heat) : null,
  };
}

/** The desire vector of a node and its valence, as `Run.output` has it. */
function desire(node) {
  const { q, valence } = run.state.desires;
  const total = { x: 0, y: 0, valence: 0 };
  run.parameters.desires.target.forEach((target, e) => {
    if (Number(target) !== node) return;
    const [x, y] = asVector(run, (action) => q[run.sizes.actions * e + action]);
    total.x += Math.sign(valence[e]) * x;
    total.y += Math.sign(valence[e]) * y;
    total.valence += valence[e];
  });
  return total;
}

function vectors(count, valueOf) {
  const found = new Float32Array(2 * count);
  for (let place = 0; place < count; place += 1) {
    found.set(asVector(run, (action) => valueOf(place, action)), 2 * place);
  }
  return found;
}

/** Survey the superposed value of each action in each of `tiles` tiles. */
function survey(side) {
  const [tiles, { actions }] = [side * side, run.sizes];
  run.values = run.values?.length === actions * tiles ? run.values : run.machine.put("float64", [tiles, actions]);
  call("survey", { side, tiles });
  return { tiles, valueOf: (tile, action) => run.values[actions * tile + action] };
}

function field(side) {
  const { tiles, valueOf } = survey(side);
  return vectors(tiles, valueOf);
}

/** The value of the best action in each tile. */
function heat(side) {
  const { tiles, valueOf } = survey(side);
  return Float32Array.from({ length: tiles }, (_, tile) =>
    Math.max(...Array.from({ length: run.sizes.actions }, (__, action) => valueOf(tile, action))));
}

/** The learned value function of a goal, as a vector in every cell of a map; of all goals, if its state is the self. */
function valueFunction(map, goal) {
  const { parameters: { maps }, sizes: { actions }, state: { values: { q } } } = run;
  const [first, cells] = [Number(maps.first_value[map]), Number(maps.cells[map])];
  if (isOfSelf(run.choices, map)) return vectors(cells, (cell, action) => q[first + actions * cell + action]);
  const place = placeOf(run.choices, cells, actions);
  return vectors(cells, (cell, action) => q[first + place(cell, action, goal)]);
}

/** The cell of the map shown that contains a place, or null. User-defined axes see the place as a thing there. */
function cellSeenAt(at) {
  const { scene: { things }, choices: { size } } = run;
  const before = things.slice(0, 2);
  things.set([at.x * size, at.y * size].slice(0, things.length));
  const cell = call("cell_seen_at", { m: mapNames(run.choices).indexOf(look.map), ...at });
  things.set(before);
  return cell < 0 ? null : cell;
}

const REQUESTS = {
  async load(request) {
    modules[request.name] = { layout: request.layout, compiled: await WebAssembly.compile(request.wasm) };
    return { type: "ready" };
  },
  begin,
  change({ parameters }) {
    become(parameters);
    return frame();
  },
  /** `at`: a place, whose cell becomes the goal, or ceases to be it. */
  look({ type, at, ...choice }) {
    lookAt(choice);
    const cell = at && cellSeenAt(at);
    if (look.goal >= Number(run.parameters.maps.cells[mapNames(run.choices).indexOf(look.map)])) look.goal = null;
    if (at && !learnsContacts(mapNames(run.choices).indexOf(look.map))) look.goal = cell === look.goal ? null : cell;
    return frame();
  },
  advance,
  extend,
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
