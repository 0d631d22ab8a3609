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

/** A run in a machine of its own, with its agent's record derived and everything else at 0. */
function newRun({ parameters: choices, world, steps, bin_steps }) {
  const laid = laidOut(choices);
  const [actions, axes] = [choices.push.length, choices.push[0].length];
  const sizes = { ...laid.sizes, actions, axes, things: world.things, ...world.sizes, kinds: world.kinds.length,
    bins: Math.ceil(steps / bin_steps), recorded: 0, episodes: 0 };
  for (const name of Object.keys(layout.sizes)) sizes[name] = 0; // they follow from the record
  const bytes = 2 ** 20 + 2 * layout.records.Agent.size + bytesOf("Memory", sizes);
  const last = newAgent(new Machine(bytes), sizes, laid).agent.maps.at(-1);
  const factor = (each) => (typeof each === "number" ? each : last[each] ?? { actions, ...choices.contacts }[each]);
  for (const [name, product] of Object.entries(layout.sizes)) {
    sizes[name] = product.map(factor).reduce((one, other) => one * other);
  }

  const machine = new Machine(bytes + bytesOf("Log", sizes) + bytesOf("Memory", sizes)
    + bytesOf("Memory", { ...sizes, values: 0 }) + 3 * bytesOf(layout.state, sizes) + bytesOf(layout.rules, sizes));
  const { agent, memory } = newAgent(machine, sizes, laid);
  const worldState = machine.tuple(layout.state, sizes);
  const { position, velocity, ...shared } = worldState.scene;
  const { q, goal_range, ...derived } = memory;
  const known = Object.fromEntries(["cuts", "goals", ...Object.keys(laid.memory)].map((name) => [name, derived[name]]));
  return {
    machine, sizes, world, steps, choices, laid, agent, memory, world_state: worldState, scene: worldState.scene,
    rules: machine.tuple(layout.rules, sizes, world.rules), step: 0,
    log: machine.tuple("Log", sizes, { bin_steps, first_step: 0, frame_steps: 1 }), // without a recording
    double: machine.record("Agent"), // the agent elsewhere, with a memory that has its values but tracks of its own
    elsewhere: machine.tuple("Memory", sizes, { q, goal_range, ...known }),
    there: machine.tuple("Scene", sizes, { ...shared, velocity }),
    second: machine.tuple("Scene", sizes, shared), // a second body in the same tank
    player: null, slice: 16, trail: [],
  };
}

/** An agent in a machine, with its record derived. */
function newAgent(machine, sizes, laid) {
  const made = { agent: machine.record("Agent", laid.agent), memory: machine.tuple("Memory", sizes, laid.memory) };
  machine.call("derive", sizes, { ...made, n_things: sizes.things });
  return made;
}

/** What `neorl.core.building` makes of choices: the fields of an agent's record, arrays of its memory, and sizes. */
function laidOut(choices) {
  const { nodes } = choices;
  const tables = {
    nodes, axes: nodes.flatMap((node) => node.axes),
    maps: nodes.flatMap(({ resolutions }, node) => resolutions.map((resolution) => ({ resolution, node }))),
    desires: choices.desires.map((desire) =>
      ({ ...desire, goals: desire.point.length ? nodes[desire.target].resolutions : [] })),
  };
  const counts = Object.fromEntries(Object.entries(tables).map(([name, { length }]) => [`n_${name}`, length]));
  if (Math.max(...Object.values(counts)) > layout.rows) {
    throw new Refusal(`An agent in a page can have ${layout.rows} nodes, maps, axes and desires. Choose fewer.`);
  }
  const rows = Object.fromEntries(Object.entries(tables).map(([name, each]) =>
    [name, withPlaces(each, layout.lists[name] ?? {})]));
  const sizes = { goals: tables.desires.flatMap(({ goals }) => goals).length,
    cuts: nodes.reduce((sum, { resolutions, axes }) => sum + resolutions.length * axes.length, 0) };
  const [shapes, memory] = [Object.fromEntries(layout.tuples.Memory), {}];
  for (const [name, [table, several]] of Object.entries(layout.joined)) {
    const [, [size]] = shapes[name];
    const entries = (table === "choices" ? [choices] : tables[table]).flatMap((row) => row[several]);
    Object.assign(sizes, { [size]: entries.length });
    Object.assign(memory, { [name]: entries.flat() });
  }
  return { agent: { ...counts, ...choices, ...rows }, memory, sizes }; // a table is as long as its count says
}

/** Rows with the length in place of each list, and where it begins and ends among those of all rows. */
function withPlaces(rows, names) {
  const ends = {};
  return rows.map((row) => Object.entries(names).reduce((placed, [one, several]) => {
    const first = ends[one] ?? 0;
    ends[one] = first + row[several].length;
    return { ...placed, [several]: row[several].length, [`first_${one}`]: first, [`end_${one}`]: ends[one] };
  }, row));
}

const call = (name, more = {}) => run.machine.call(name, { ...run.sizes, ...more }, { ...run, ...more });

function begin(request) {
  const taught = request.keeps ? run.memory : null; // of a run of the same agent, as in `Run.transfer`
  run = null; // so that its memory can be freed before the next is allocated
  ({ layout, compiled } = modules[request.world.module]);
  run = newRun(request);
  run.changes = [...(request.changes ?? [])];
  const { seed, run: index } = request;
  for (const [key, stream] of [[[index], run.world_state.stream], [[index, 0], run.agent.stream]]) {
    const words = run.machine.put("uint64", [4 + key.length]);
    words.set([seed, 0, 0, 0, ...key].map(BigInt));
    run.machine.call("start_stream", { words: words.length }, { words, stream });
  }
  call("reset", { state: run.world_state });
  call("begin_values");
  call("begin");
  for (const name of taught ? ["q", "goal_range"] : []) run.memory[name].set(taught[name]);
  lookAt({ map: request.map, goal: null, field: request.field, heat: request.heat });
  return frame();
}

/** Show a map, or, if there is none of that name, one whose cells are large enough to click. */
function lookAt(choice) {
  const names = mapNames(run.choices);
  look = { ...look, ...choice };
  if (names.includes(look.map)) return;
  const large = run.choices.nodes[0].resolutions.findLastIndex((cells) => cells <= 7);
  Object.assign(look, { map: names[Math.max(0, large)], goal: null });
}

/** The choices of the node that has a map of a run. */
const nodeOf = ({ choices, agent }, m) => choices.nodes[agent.maps[m].node];

function mapNames({ names, nodes }) {
  return nodes.flatMap(({ resolutions }, n) => resolutions.map((cells) => `${names[n]} N${cells}`));
}

/** How a map cuts the axes of its node. */
function cutsOf(m) {
  const { first_cut, node } = run.agent.maps[m];
  return rowsOf(run.memory.cuts, "CUT", first_cut, first_cut + run.agent.nodes[node].axes);
}

/** The numbers of intervals of a map along its axes, such as "5 × 5". */
const shapeOf = (m) => cutsOf(m).map(({ last }) => last + 1).join(" × ");

/** The name of an enumeration's member, by number. */
const nameOf = (enumeration, number) =>
  Object.entries(layout.enumerations[enumeration]).find(([, each]) => each === Number(number))[0];

const learnsContacts = (m) => nodeOf(run, m).learns_contacts;

/** Whether the state of a node is the self, always in the centre: each cell is then a goal with values of its own. */
const isOfSelf = ({ state }) => state !== layout.enumerations.MapState.object;

/** The map that is shown, as it is drawn, and the way to the goal chosen in it. */
function seen(m) {
  const node = nodeOf(run, m);
  const vector = nameOf("Vector", node.follows);
  if (learnsContacts(m)) return { name: look.map, vector, axes: [], goal: null, ways: null }; // its cells are not goals
  return {
    name: look.map, vector, axes: axesOf(m), ends: node.ends, ofSelf: isOfSelf(node), goal: look.goal,
    ways: look.goal === null ? null : valueFunction(m, look.goal),
  };
}

/** How a map divides the axes of the vector that its node follows: other axes cannot be drawn in the world. */
function axesOf(m) {
  const [{ axes, ends, follows }, cuts] = [nodeOf(run, m), cutsOf(m)];
  return axes.flatMap(({ vector, feature, along, cut, low, high, boundaries }, axis) => {
    const { low: first, scale, last, stride } = cuts[axis];
    const borders = nameOf("Cut", cut) === "boundaries" ? [low, ...boundaries, high]
      : Array.from({ length: last + 2 }, (_, index) => first + index / scale);
    if (ends && nameOf("Cut", cut) === "centred") { // half of either outermost interval is beyond the range
      Object.assign(borders, { 0: low, [last + 1]: high });
    }
    const isBearing = nameOf("Vector", vector) === "own"; // the only user-defined axis in a module
    if (vector !== follows && !isBearing) return [];
    return [{ feature: isBearing ? "bearing" : nameOf("Feature", feature), along, stride, borders,
      closed: nameOf("Cut", cut) === "closed", high }];
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
    call("rollout", { last_step: next });
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
  for (const [totals, width] of [[run.log.rewards, 1], [run.log.hits, run.sizes.kinds]]) {
    const before = totals.slice();
    totals.fill(0);
    before.forEach((total, at) => { totals[width * Math.floor(at / width / 2) + (at % width)] += total; });
  }
  run.steps *= 2;
  run.log.bin_steps *= 2;
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

/** Take a reader's actions in place of the agent's, one a step. */
function steer({ actions }) {
  for (const action of actions.slice(0, run.steps - run.step)) {
    if (run.changes[0]?.step === run.step) become(run.changes.shift().parameters);
    call("step_alone", { board: run.world_state, rules: run.rules.waterworld, action });
    run.step += 1;
    leaveTrail();
  }
  return frame();
}

function drag({ creep, x, y }) {
  const { width, radius } = run.rules.waterworld;
  const inside = [x, y].map((each) => Math.min(width - radius, Math.max(radius, each * width)));
  run.scene.things.set(inside, 2 * creep);
  call("begin"); // nothing is learned from a jump that the reader caused
  return frame();
}

function frame(steps = 0) {
  const { agent: { maps: nresMaps, desires }, memory, scene, world, second, player, choices, choices: { size } } = run;
  const body = ({ position: at, velocity: moving }) =>
    ({ x: at[0] / size, y: at[1] / size, vx: moving[0] / size, vy: moving[1] / size });
  const agent = body(scene);
  const maps = mapNames(choices);
  const m = maps.indexOf(look.map);
  const { first_track: from, end_track: to } = nresMaps[m];
  return {
    type: "frame", step: run.step, ended: run.step >= run.steps, reward: run.log.paid[0], rewards: run.log.rewards.slice(),
    maps, shapes: maps.map((_, each) => shapeOf(each)), seen: seen(m), steps, agent, things: thingsOf(run),
    trail: run.trail, round: false, obstacles: [], ...VIEWS[world.name](run),
    player: player && { ...body(second), reward: player.reward },
    hits: world.kinds.map((kind, k) => ({ kind, counts: run.log.hits.filter((_, i) => i % world.kinds.length === k) })),
    wants: choices.desires.flatMap(({ kind, valence }) => (kind < 0 ? [] : [{ kind: world.kinds[kind], valence }])),
    active: learnsContacts(m) ? [] : rowsOf(memory.tracks, "TRACK", from, to).map(({ cell }) => cell),
    nodes: choices.names.map((name, n) => ({ name, ...desire(n) })),
    landings: choices.edges.flatMap(({ source, target }, e) => (source === null ? [] : [{
      source, target, recurs: source === target, valence: desires[e].total_valence,
      x: agent.x + desires[e].target_at[0], y: agent.y + desires[e].target_at[1],
    }])),
    field: look.field ? field(look.field) : null, heat: look.heat ? heat(look.heat) : null,
  };
}

/** The desire vector of a node and its valence, as `Run.output` has it. */
function desire(node) {
  const total = { x: 0, y: 0, valence: 0 };
  run.agent.desires.filter(({ target }) => target === node).forEach(({ q, total_valence: valence }) => {
    const [x, y] = asVector(run, (action) => q[action]);
    total.x += Math.sign(valence) * x;
    total.y += Math.sign(valence) * y;
    total.valence += valence;
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
  run.double.bytes.set(run.agent.bytes);
  call("survey", { memory: run.elsewhere, side, tiles });
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
  const { sizes: { actions }, memory: { q } } = run;
  const { first_value: first, cells } = run.agent.maps[map];
  if (isOfSelf(nodeOf(run, map))) return vectors(cells, (cell, action) => q[first + actions * cell + action]);
  const place = placeOf(run.choices, cells, actions);
  return vectors(cells, (cell, action) => q[first + place(cell, action, goal)]);
}

/** The cell of the map shown that contains a place, or null. User-defined axes see the place as a thing there. */
function cellSeenAt(at) {
  const { scene: { things }, choices: { size } } = run;
  const before = things.slice(0, 2);
  things.set([at.x * size, at.y * size].slice(0, things.length));
  run.double.bytes.set(run.agent.bytes);
  const cell = call("cell_seen_at", { agent: run.double, m: mapNames(run.choices).indexOf(look.map), ...at });
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
    if (look.goal >= run.agent.maps[mapNames(run.choices).indexOf(look.map)].cells) look.goal = null;
    if (at && !learnsContacts(mapNames(run.choices).indexOf(look.map))) look.goal = cell === look.goal ? null : cell;
    return frame();
  },
  advance,
  extend,
  play,
  steer,
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
