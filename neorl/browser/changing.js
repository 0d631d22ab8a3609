// Change the agent of a run on the way, as `neorl.Run.change` does, with all that both agents have in common.

/** Continue as another agent, with all that `neorl.agents.keeping` says. */
function become(choices) {
  const old = run;
  const [keys, before] = [mapKeys(choices), mapKeys(old.choices)];
  const [recall, recalled] = [memories(choices), memories(old.choices)];
  const isOrdered = choices.learning.bootstrap === old.choices.learning.bootstrap;
  const laid = laidOut(choices);
  const desires = desiresOf(old);
  if (isOrdered && same(laid.sizes, old.laid.sizes) && same(laid.agent.n_desires, old.laid.agent.n_desires)
    && same(keys, before) && same(recall, recalled)) {
    assign(run.agent, laid.agent);
    for (const [name, values] of Object.entries(laid.memory)) fill(run.memory[name], values);
    Object.assign(run, { choices, laid });
    call("derive", { n_things: run.sizes.things });
  } else {
    run = newRun({ ...old, bin_steps: old.log.bin_steps, parameters: choices });
    for (const name of ["world_state", "second", "log"]) copy(run[name], old[name]);
    const { step, player, changes, trail } = old;
    Object.assign(run, { step, player, changes, trail });
    call("begin_values");
    call("begin");
    put(run.agent, stateOf(old.agent, layout.of_an_agent));
    keys.forEach((key, m) => {
      const from = before.indexOf(key);
      if (from >= 0) keepMap(old, from, m, recalled[from] === recall[m]);
    });
    const isKept = keys.includes(before[mapNames(old.choices).indexOf(look.map)]);
    lookAt({ goal: isKept ? look.goal : null });
  }
  for (const [key, { desire, state }] of desiresOf(run)) put(desire, desires.get(key)?.state ?? blank(state));
}

/** A copy of some fields of a record. */
const stateOf = (record, names) => Object.fromEntries(names.filter((name) => name in record).map((name) =>
  [name, ArrayBuffer.isView(record[name]) ? record[name].slice() : record[name]]));

/** The state of a desire before the first choice. */
const blank = ({ worth, ...state }) => Object.fromEntries(Object.entries(state).map(([name, value]) =>
  [name, ArrayBuffer.isView(value) ? value.map(() => 0) : 0]));

/** Write fields into a record. */
function put(record, values) {
  for (const [name, value] of Object.entries(values)) {
    if (ArrayBuffer.isView(value)) record[name].set(value);
    else record[name] = value;
  }
}

/** The desires of a run's agent, by all that makes two of them the same: {desire, state}, the state being a copy. */
function desiresOf({ agent, choices: { desires, edges, names, nodes } }) {
  const keys = numbered(desires.map((desire, e) => {
    const { target, elements, ...own } = desire; // which are numbers of nodes and of desires
    return JSON.stringify([own, edges[e], names[target], nodes[target]]);
  }));
  return new Map(keys.map((key, e) => [key, {
    desire: agent.desires[e], state: stateOf(agent.desires[e], layout.of_a_desire) }]));
}

/** Texts, each with its number among equal ones. */
const numbered = (texts) => texts.map((text, i) => `${text} ${texts.slice(0, i).filter((other) => other === text).length}`);

/** Copy the arrays of a named tuple, also of nested ones. */
function copy(to, from) {
  for (const [name, value] of Object.entries(to)) {
    if (ArrayBuffer.isView(value)) value.set(from[name]);
    else copy(value, from[name]);
  }
}

const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);

/** What the maps of an agent have in common with those that can take their values. */
function mapKeys({ names, nodes, contacts: { after_states: after } }) {
  return numbered(nodes.flatMap(({ learns_contacts: contacts, state, ends, axes, landmarks, resolutions }, n) =>
    resolutions.map((cells) =>
      JSON.stringify([names[n], contacts, contacts && after > 0, state, ends, cells, axes, landmarks]))));
}

/** What the maps of an agent remember of how their cells were reached: more than values only if it is the same. */
function memories({ nodes, learning: { memory_retained: retained }, contacts: { efference } }) {
  return nodes.flatMap((node) => node.resolutions.map(() =>
    (node.learns_contacts ? efference : isOfSelf(node) ? retained : retained > 0)));
}

/** Copy an old run's values of a map, and, if it remembers alike, its active cells and how they were reached. */
function keepMap(old, from, to, isRecalled) {
  const [was, now] = [old.agent.maps, run.agent.maps];
  const moved = now[to].first_value - was[from].first_value;
  for (const [name, [keeping, part]] of Object.entries(layout.kept)) {
    const [first, end] = [`first_${part}`, `end_${part}`];
    if (name === "q" || (keeping !== "values" && !isRecalled) || was[from][end] <= was[from][first]) continue;
    const width = old.memory[name].length / was.at(-1)[end];
    const kept = old.memory[name].slice(was[from][first] * width, was[from][end] * width);
    run.memory[name].set(keeping === "places" ? kept.map((place) => place + BigInt(moved)) : kept, now[to][first] * width);
  }
  const values = old.memory.q.subarray(was[from].first_value, was[from].end_value);
  run.memory.q.set(reordered(values, old, from), now[to].first_value);
}

/** A function of state, action and goal: the place of their value in a map (neorl.core.learning.Order). */
const placeOf = ({ learning: { bootstrap } }, cells, actions) => (state, action, goal) =>
  (bootstrap ? (state * actions + action) * cells + goal : (goal * cells + state) * actions + action);

/** The values of a map of an old run, reordered as in the present run. */
function reordered(values, old, m) {
  const node = nodeOf(old, m);
  const isSquare = !node.learns_contacts && !isOfSelf(node);
  if (old.choices.learning.bootstrap === run.choices.learning.bootstrap || !isSquare) return values;
  const [{ cells }, { actions }] = [old.agent.maps[m], old.sizes];
  const [before, now] = [old, run].map((each) => placeOf(each.choices, cells, actions));
  const moved = values.slice();
  for (let at = 0; at < moved.length; at += 1) {
    const each = [Math.floor(at / cells / actions), Math.floor(at / cells) % actions, at % cells];
    moved[now(...each)] = values[before(...each)];
  }
  return moved;
}
