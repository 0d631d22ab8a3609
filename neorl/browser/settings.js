// From the controls to the engine's parameters: those of a preset, overridden by the reader's settings.

// Those that may change during a run, and those with defaults in a preset.
const GOES_ON = ["recursion", "valence_red", "gains", "exploration", "learning_rate", "discount"];
const OF_PRESET = [...GOES_ON, "memory", "resolutions", "modality", "object_state", "n_creeps"];

/** The keys of the presets in Python's order; the stored state may have another. */
function orderedKeys(presets) {
  return Object.keys(presets).sort((a, b) => presets[a].place - presets[b].place);
}

function initialSettings(presets, key) {
  return { preset: key, ...Object.fromEntries(OF_PRESET.map((name) => [name, presets[key][name]])) };
}

/** What tells a setting of a control from its others: its value, or the nodes of an agent that has no such setting. */
function choiceOf(control, settings, presets) {
  return settings[control] || presets[settings.preset].nodes.join(" + ");
}

/** Whether the reader has chosen another modality than the preset's, which may have ranges of its own. */
function hasOtherModality({ nodes, modality, parameters }, settings) {
  return nodes.length === 1 && settings.modality !== "" && settings.modality !== modality
    && !parameters.nodes[0].learns_contacts;
}

/** The nodes of Cartesian object vectors, whose state can be chosen. */
function statedNodes(preset, modalities, settings) {
  if (!hasOtherModality(preset, settings)) return preset.stated;
  return modalities[settings.modality].stated && preset.states.length > 1 ? [0] : [];
}

/** `elements`: [{x, y, valence}], dropped by the reader; every node with a nonzero gain desires them. */
function chosenParameters(layout, presets, modalities, settings, elements = []) {
  const preset = presets[settings.preset];
  const parameters = structuredClone(preset.parameters);
  const { nodes, desires, learning, policy } = parameters;
  if (settings.resolutions.join() !== preset.resolutions.join()) { // the preset's may differ between nodes
    for (const node of nodes) node.resolutions = [...settings.resolutions];
  }
  if (hasOtherModality(preset, settings)) {
    Object.assign(nodes[0], modalities[settings.modality].node);
    rename(parameters, settings.modality); // so that its maps are named after the new modality
  }
  const { MapState } = layout.enumerations;
  for (const n of statedNodes(preset, modalities, settings)) {
    nodes[n].state = MapState[(settings.object_state || "object").replace(" ", "_")];
    if (nodes[n].state !== MapState.object) nodes[n].reach = 0;
  }
  nodes.forEach((node, n) => Object.assign(node, { gain: settings.gains[n] }));
  policy.exploration = settings.exploration;
  learning.learning_rate = Math.fround(settings.learning_rate);
  learning.discount = Math.fround(settings.discount);
  learning.memory_retained = Math.fround(settings.memory / (1 + settings.memory));
  for (const e of preset.red) desires[e].valence = settings.valence_red;
  for (const e of preset.recurring) desires[e].valence = settings.recursion;
  const source = layout.enumerations.Source.place;
  for (const element of elements) {
    nodes.forEach(({ gain }, n) => gain !== 0 && addElement(parameters, n, source, element));
  }
  return parameters;
}

/** Give the only node another name. */
function rename({ names, edges }, name) {
  for (const edge of edges) {
    edge.target = name;
    if (edge.source === names[0]) edge.source = name;
  }
  names[0] = name;
}

function addElement({ names, edges, desires, push }, target, source, { x, y, valence }) {
  const name = names[target];
  desires.forEach(({ elements }, e) => {
    if (edges[e].source === name && edges[e].of.length === 0) elements.push(desires.length);
  });
  edges.push({ source: null, target: name, of: [] });
  desires.push({ source, kind: -1, target, valence, learned: false, sums_valence: false, scale: 1, signed: false,
    place: push[0].map((_, axis) => [x, y][axis] ?? 0), point: [], elements: [] });
}

/** The key of the page's condition with the agent and the world of these settings, or null. */
function conditionOf(layout, presets, modalities, settings) {
  const chosen = JSON.stringify(chosenParameters(layout, presets, modalities, settings));
  const world = JSON.stringify(worldOf(presets, settings));
  // Conditions that differ only in later changes of the agent are distinguished by the preset.
  return [settings.preset, ...orderedKeys(presets)].find((key) => presets[key].is_condition
    && JSON.stringify(presets[key].world) === world && JSON.stringify(presets[key].parameters) === chosen) ?? null;
}

/** The world of the preset, with the set number of creeps if it has creeps. */
function worldOf(presets, settings) {
  const { world } = presets[settings.preset];
  return { ...world, things: settings.n_creeps ?? world.things };
}
