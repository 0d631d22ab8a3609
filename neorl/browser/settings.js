// From the controls to the parameters that the engine runs: a preset's, with what the reader has set put in their place.

const GOES_ON = ["recursion", "valence_red", "gains", "learning_rate", "discount"]; // may change while a run lives
const OF_PRESET = [...GOES_ON, "memory", "resolutions", "modality", "n_creeps"]; // what a preset has defaults of

/** The keys of the presets as Python had them; what is stored may come in another order. */
function orderedKeys(presets) {
  return Object.keys(presets).sort((a, b) => presets[a].place - presets[b].place);
}

function initialSettings(presets, key) {
  return { preset: key, ...Object.fromEntries(OF_PRESET.map((name) => [name, presets[key][name]])) };
}

/** `elements`: [{x, y, valence}], what the reader has dropped; every node whose values count sees them. */
function chosenParameters(layout, presets, modalities, settings, elements = []) {
  const preset = presets[settings.preset];
  const parameters = structuredClone(preset.parameters);
  const { names, maps, nodes, desires, learning } = parameters;
  maps.resolution = names.flatMap(() => settings.resolutions);
  nodes.first_map = [0, ...names.map((_, n) => (n + 1) * settings.resolutions.length)];
  if (names.length === 1 && settings.modality !== preset.modality) { // the preset's may have ranges of its own
    Object.assign(nodes, modalities[settings.modality]);
  }
  nodes.gain = [...settings.gains];
  learning.learning_rate = Math.fround(settings.learning_rate);
  learning.discount = Math.fround(settings.discount);
  const memory = settings.memory * (learning.memory_by_time ? preset.world.fps : 1); // in changes of cell, or in steps
  learning.memory_retained = Math.fround(memory / (1 + memory));
  for (const e of preset.red) desires.valence[e] = settings.valence_red;
  for (const e of preset.recurring) desires.valence[e] = settings.recursion;
  const source = layout.enumerations.Source.place;
  for (const element of elements) {
    nodes.gain.forEach((gain, n) => gain !== 0 && addElement(parameters, n, source, element));
  }
  return parameters;
}

function addElement({ names, edges, desires }, target, source, { x, y, valence }) {
  const name = names[target];
  desires.elements.forEach((row, e) => row.push(edges[e].source === name && edges[e].of.length === 0));
  desires.elements.push(desires.elements.length ? desires.elements[0].map(() => false) : [false]);
  edges.push({ source: "", target: name, of: [] });
  const desire = { source, target, valence, sums_valence: false, scale: 1, signed: false, at: [x, y] };
  for (const [field, value] of Object.entries(desire)) desires[field].push(value);
}

/** The condition of the page, if it has one, whose agent these settings are. */
function conditionOf(layout, presets, modalities, settings) {
  const chosen = JSON.stringify(chosenParameters(layout, presets, modalities, settings));
  // Conditions that differ only in what they become later are told apart by the preset.
  return [settings.preset, ...orderedKeys(presets)].find((key) => presets[key].totals.length > 0
    && presets[key].n_creeps === settings.n_creeps && JSON.stringify(presets[key].parameters) === chosen) ?? null;
}

function worldOf(presets, settings) {
  return { ...presets[settings.preset].world, n_creeps: settings.n_creeps };
}
