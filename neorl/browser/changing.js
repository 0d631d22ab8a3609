// Change the agent of a run on the way, as `neorl.Run.change` does, with all that both agents have in common.

/** Continue as another agent, as `Run.change` does: maps that both have are kept, the last step's desires are not. */
function become(choices) {
  const old = run;
  const keys = mapKeys(choices);
  const isOrdered = choices.learning.bootstrap === old.choices.learning.bootstrap;
  if (isOrdered && choices.desires.source.length === old.sizes.desires && keys.join() === mapKeys(old.choices).join()) {
    take(run.parameters, choices);
    run.choices = choices;
    call("derive", { n_things: run.sizes.things });
    const { worth, meetings, ...ofBefore } = run.state.desires;
    for (const each of Object.values(ofBefore)) each.fill(0);
    choices.desires.valence.forEach((valence, e) => { if (!choices.desires.learned[e]) worth[e] = valence; });
  } else {
    run = newRun({ ...old, parameters: choices });
    copy(run.world_state, old.world_state);
    copy(run.second, old.second);
    run.rewards.set(old.rewards);
    run.hits.set(old.hits);
    run.clock.set(old.clock);
    const { step, reward, player, changes, trail } = old;
    Object.assign(run, { step, reward, player, changes, trail });
    call("begin_values");
    call("begin");
    for (const name of ["stream", "last_event", "activity"]) run.state[name].set(old.state[name]);
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

/** Write the chosen parameters; a field that is not chosen is derived. */
function take(parameters, choices) {
  for (const [name, value] of Object.entries(parameters)) {
    if (!(name in choices)) continue;
    if (ArrayBuffer.isView(value)) fill(value, choices[name]);
    else if (typeof value === "object") take(value, choices[name]);
    else parameters[name] = choices[name];
  }
}

function mapKeys({ names, maps, nodes, axes, learning }) {
  return maps.resolution.map((each, m) => {
    const n = nodeOf(nodes.first_map, m);
    const [first, end] = [nodes.first_axis[n], nodes.first_axis[n + 1]];
    const space = ["what", "low", "high"].map((name) => axes[name].slice(first, end));
    space.push(axes.boundary.slice(axes.first_boundary[first], axes.first_boundary[end]));
    const landmarks = nodes.landmark.slice(nodes.first_landmark[n], nodes.first_landmark[n + 1]);
    const kinds = [nodes.learns_contacts, nodes.state, nodes.ends].map((kind) => kind[n]);
    const memory = isOfSelf({ nodes }, m) ? learning.memory_retained : learning.memory_retained > 0;
    return JSON.stringify([names[n], kinds, each, memory, space, landmarks]);
  });
}

/** Copy an old run's values of a map, its active cells, and its memory of how they were reached. */
function keepMap(old, from, to) {
  for (const [firsts, fields] of Object.entries(layout.of_a_map)) {
    const [ofOld, ofNew] = [old.parameters.maps[firsts], run.parameters.maps[firsts]];
    const [begin, end] = [ofOld[from], ofOld[from + 1]].map(Number);
    for (const [part, name] of fields.map((field) => field.split("."))) {
      const kept = old.state[part][name];
      const width = kept.length / Number(ofOld.at(-1));
      const moved = kept.subarray(begin * width, end * width);
      run.state[part][name].set(name === "q" ? reordered(moved, old, from) : moved, Number(ofNew[to]) * width);
    }
  }
}

/** A function of state, action and goal: the place of their value in a map (neorl.core.learning.Order). */
const placeOf = ({ learning: { bootstrap } }, cells, actions) => (state, action, goal) =>
  (bootstrap ? (state * actions + action) * cells + goal : (goal * cells + state) * actions + action);

/** The values of a map of an old run, reordered as in the present run. */
function reordered(values, old, m) {
  const { choices: { nodes }, parameters: { maps } } = old;
  const isSquare = !nodes.learns_contacts[nodeOf(nodes.first_map, m)] && !isOfSelf(old.choices, m);
  if (old.choices.learning.bootstrap === run.choices.learning.bootstrap || !isSquare) return values;
  const [cells, actions] = [Number(maps.cells[m]), old.sizes.actions];
  const [before, now] = [old, run].map((each) => placeOf(each.choices, cells, actions));
  const moved = values.slice();
  for (let at = 0; at < moved.length; at += 1) {
    const each = [Math.floor(at / cells / actions), Math.floor(at / cells) % actions, at % cells];
    moved[now(...each)] = values[before(...each)];
  }
  return moved;
}
