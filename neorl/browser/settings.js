// From the controls to the plan that the engine runs: a preset's plan, with what the reader has set put in its place.

const GOES_ON = ["recursion", "valence_red", "gains", "learning_rate", "discount"]; // may change while a run lives
const OF_PRESET = [...GOES_ON, "memory", "resolutions", "modality", "n_creeps"]; // what a preset has defaults of
const PLACE = 4; // the source of a desire that is a place in the arena, in `plan.source`

/** The keys of the presets as Python had them; what is stored may come in another order. */
function orderedKeys(presets) {
  return Object.keys(presets).sort((a, b) => presets[a].place - presets[b].place);
}

function initialSettings(presets, key) {
  return { preset: key, ...Object.fromEntries(OF_PRESET.map((name) => [name, presets[key][name]])) };
}

/** `elements`: [{x, y, valence}], what the reader has dropped; every node whose values count sees them. */
function chosenPlan(presets, modalities, settings, elements = []) {
  const preset = presets[settings.preset];
  const plan = structuredClone(preset.plan);
  plan.resolution = plan.nodes.flatMap(() => settings.resolutions);
  plan.first_map = [0, ...plan.nodes.map((_, n) => (n + 1) * settings.resolutions.length)];
  if (plan.nodes.length === 1 && settings.modality !== preset.modality) { // the preset's may have ranges of its own
    Object.assign(plan, modalities[settings.modality]);
  }
  plan.gain = [...settings.gains];
  plan.learning_rate = Math.fround(settings.learning_rate);
  plan.discount = Math.fround(settings.discount);
  const memory = settings.memory * (plan.memory_by_time ? preset.world.fps : 1); // in changes of cell, or in steps
  plan.memory_fade = Math.fround(memory / (1 + memory));
  for (const e of preset.red) plan.valence[e] = settings.valence_red;
  for (const e of preset.recurring) plan.valence[e] = settings.recursion;
  for (const element of elements) {
    plan.gain.forEach((gain, n) => gain !== 0 && addElement(plan, n, element));
  }
  return plan;
}

function addElement(plan, node, { x, y, valence }) {
  const name = plan.nodes[node];
  plan.elements.forEach((row, e) => {
    const { source, of } = plan.desires[e];
    row.push(source === name && of.length === 0);
  });
  plan.elements.push(plan.elements.length ? plan.elements[0].map(() => false) : [false]);
  plan.desires.push({ source: "", target: name, of: [] });
  const desire = { source: PLACE, target: node, valence, sums_valence: false, scale: 1, signed: false, at: [x, y] };
  for (const [field, value] of Object.entries(desire)) plan[field].push(value);
}

/** The condition of the page, if it has one, whose agent these settings are. */
function conditionOf(presets, modalities, settings) {
  const plan = JSON.stringify(chosenPlan(presets, modalities, settings));
  // Conditions that differ only in what they become later are told apart by the preset.
  return [settings.preset, ...orderedKeys(presets)].find((key) => presets[key].totals.length > 0
    && presets[key].n_creeps === settings.n_creeps && JSON.stringify(presets[key].plan) === plan) ?? null;
}

function worldOf(presets, settings) {
  return { ...presets[settings.preset].world, n_creeps: settings.n_creeps };
}
