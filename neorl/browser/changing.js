// Change the agent of a run on the way, as `neorl.Run.change` does, with all that both agents have in common.

/** Continue as another agent, as `Run.change` does: maps that both have are kept, the last step's desires are not. */
function become(choices) {
  const old = run;
  const keys = mapKeys(choices);
  const isOrdered = choices.learning.bootstrap === old.choices.learning.bootstrap;
  const laid = laidOut(choices);
  if (isOrdered && same(laid.sizes, old.laid.sizes) && same(laid.agent.n_desires, old.laid.agent.n_desires)
    && same(keys, mapKeys(old.choices))) {
    assign(run.agent, laid.agent);
    for (const [name, values] of Object.entries(laid.memory)) fill(run.memory[name], values);
    Object.assign(run, { choices, laid });
    call("derive", { n_things: run.sizes.things });
    for (const desire of run.agent.desires) {
      for (const values of [desire.q, desire.target_at]) values.fill(0);
      Object.assign(desire, { target_valence: 0, total_valence: 0 });
    }
  } else {
    run = newRun({ ...old, bin_steps: old.log.bin_steps, parameters: choices });
    for (const name of ["world_state", "second", "log"]) copy(run[name], old[name]);
    const { step, player, changes, trail } = old;
    Object.assign(run, { step, player, changes, trail });
    call("begin_values");
    call("begin");
    for (const name of ["stream", "activity"]) run.agent[name].set(old.agent[name]);
    run.agent.last_event = old.agent.last_event;
    const oldKeys = mapKeys(old.choices);
    keys.forEach((key, m) => oldKeys.includes(key) && keepMap(old, oldKeys.indexOf(key), m));
    const isKept = keys.includes(oldKeys[mapNames(old.choices).indexOf(look.map)]);
    lookAt({ goal: isKept ? look.goal : null });
  }
}

/** Copy the arrays of a named tuple, also of nested ones. */
function copy(to, from) {
  for (const [name, value] of Object.entries(to)) {
    if (ArrayBuffer.isView(value)) value.set(from[name]);
    else copy(value, from[name]);
  }
}

const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);

function mapKeys({ names, nodes, learning }) {
  return nodes.flatMap((node, n) => {
    const { learns_contacts: learnsOf, state, ends, axes, landmarks, resolutions } = node;
    const memory = isOfSelf(node) ? learning.memory_retained : learning.memory_retained > 0;
    return resolutions.map((cells) => JSON.stringify([names[n], learnsOf, state, ends, cells, memory, axes, landmarks]));
  });
}

/** Copy an old run's values of a map, its active cells, and its memory of how they were reached. */
function keepMap(old, from, to) {
  const [was, now] = [old.agent.maps, run.agent.maps];
  for (const [part, names] of Object.entries(layout.of_a_map)) {
    const [first, end] = [`first_${part}`, `end_${part}`];
    for (const name of names.filter(() => was[from][end] > was[from][first])) {
      const width = old.memory[name].length / was.at(-1)[end];
      const kept = old.memory[name].subarray(was[from][first] * width, was[from][end] * width);
      run.memory[name].set(kept, now[to][first] * width);
    }
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
