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

/** Whether the reader has chosen another modality than the preset's, which may have ranges of its own. */
function hasOtherModality({ nodes, modality, parameters }, settings) {
  return nodes.length === 1 && settings.modality !== "" && settings.modality !== modality
    && !parameters.nodes.learns_contacts[0];
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
  const { names, maps, nodes, axes, desires, learning, policy } = parameters;
  if (settings.resolutions.join() !== preset.resolutions.join()) { // the preset's may differ between nodes
    maps.resolution = names.flatMap(() => settings.resolutions);
    nodes.first_map = [0, ...names.map((_, n) => (n + 1) * settings.resolutions.length)];
  }
  if (hasOtherModality(preset, settings)) {
    Object.assign(nodes, modalities[settings.modality].nodes);
    Object.assign(axes, modalities[settings.modality].axes);
    parameters.coordinates = Math.max(parameters.push[0].length, axes.what.length);
    desires.at = desires.at.map((at) => padded(at, parameters.coordinates));
    rename(parameters, settings.modality); // so that its maps are named after the new modality
  }
  const { MapState } = layout.enumerations;
  for (const n of statedNodes(preset, modalities, settings)) {
    nodes.state[n] = MapState[(settings.object_state || "object").replace(" ", "_")];
    if (nodes.state[n] !== MapState.object) nodes.reach[n] = 0;
  }
  nodes.gain = [...settings.gains];
  policy.exploration = settings.exploration;
  learning.learning_rate = Math.fround(settings.learning_rate);
  learning.discount = Math.fround(settings.discount);
  learning.memory_retained = Math.fround(settings.memory / (1 + settings.memory));
  for (const e of preset.red) desires.valence[e] = settings.valence_red;
  for (const e of preset.recurring) desires.valence[e] = settings.recursion;
  const source = layout.enumerations.Source.place;
  for (const element of elements) {
    nodes.gain.forEach((gain, n) => gain !== 0 && addElement(parameters, n, source, element));
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

/** A point extended with zeros to this number of coordinates. */
function padded(point, coordinates) {
  return Array.from({ length: coordinates }, (_, axis) => point[axis] ?? 0);
}

function addElement({ names, edges, desires, coordinates }, target, source, { x, y, valence }) {
  const name = names[target];
  desires.elements.forEach((row, e) => row.push(edges[e].source === name && edges[e].of.length === 0));
  desires.elements.push(desires.elements.length ? desires.elements[0].map(() => false) : [false]);
  edges.push({ source: "", target: name, of: [] });
  const desire = { source, kind: -1, target, valence, sums_valence: false, scale: 1, signed: false,
    at: padded([x, y], coordinates) };
  for (const [field, value] of Object.entries(desire)) desires[field].push(value);
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
