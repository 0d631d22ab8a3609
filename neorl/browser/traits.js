/* The traits of the Explorer's model, which are its settings. Whoever writes them, the page reacts to the change. */

class Traits {
  noted = new Set(); // the names of what has changed since the page reacted last
  condition = null; // the page's condition that has these settings, by its key, or null

  /** react: called after each change. */
  constructor(model, react) {
    Object.assign(this, { model, react, presets: model.get("_presets"), modalities: model.get("_modalities"),
      first: model.get("preset"), layout: model.get("_layout").plane }); // enumerations are the same in all modules
  }

  get(name) {
    return this.model.get(name);
  }

  /** The chosen preset, or undefined if there is none of that name. */
  get preset() {
    return this.presetOf(this.get("preset"));
  }

  /** The preset of the condition that has these settings; an empty one if there is none. */
  get shown() {
    return (this.condition !== null && this.presetOf(this.condition)) || {};
  }

  presetOf(key) {
    return Object.hasOwn(this.presets, key) ? this.presets[key] : undefined;
  }

  hasCreeps() {
    return this.get("n_creeps") !== null;
  }

  settings() {
    return Object.fromEntries(["preset", ...OF_PRESET].map((name) => [name, this.get(name)]));
  }

  /** The engine's parameters of these settings, with elements dropped by the reader. */
  parameters(elements, settings = this.settings()) {
    return chosenParameters(this.layout, this.presets, this.modalities, settings, elements);
  }

  /** The engine's world of these settings. */
  world(settings = this.settings()) {
    return worldOf(this.presets, settings);
  }

  findCondition() {
    this.condition = conditionOf(this.layout, this.presets, this.modalities, this.settings());
  }

  /** Let the page react to a change of something, as of the trait of that name. */
  note(name) {
    this.noted.add(name);
    this.react();
  }

  write(values) {
    for (const [name, value] of Object.entries(values)) {
      if (isSame(this.get(name), value)) continue;
      this.model.set(name, value);
      this.note(name);
    }
    this.model.save_changes();
  }

  /** Tell Python of the run. Nothing in the page reacts to these. */
  report(values) {
    for (const [name, value] of Object.entries(values)) this.model.set(name, value);
    this.model.save_changes();
  }

  /** A message on the first invalid trait, or on the first of others, by a function of their names; or "". */
  problem(get = (name) => this.get(name)) {
    const [preset, { modalities }] = [this.presetOf(get("preset")), this];
    if (!preset) return `There is no agent “${get("preset")}”. Choose one from the menu.`;
    const [isNumber, isPlace, { nodes }] = [Number.isFinite, isWhole(0, MOST_SEED), preset];
    const allowed = {
      resolutions: (value) => isList(value, isWhole(1, 90)), learning_rate: isNumber, discount: isNumber,
      modality: (value) => value === "" || (preset.modality !== "" && Object.hasOwn(modalities, value)),
      valence_red: (value) => (preset.red.length ? isNumber(value) : value === preset.valence_red),
      memory: (value) => value === 0 || (value > 0 && preset.can_remember),
      object_state: (value) => preset.states.includes(value),
      exploration: (value) => value >= 0 && value <= 1,
      gains: (value) => isList(value, isNumber) && value.length === nodes.length, seed: isPlace,
      n_creeps: (value) => (preset.n_creeps === null ? value === null : isWhole(1, 20)(value)),
      recursion: (value) => (preset.recursion === null ? value === null : isNumber(value)),
      speed: (value) => value >= 0, run: isPlace };
    const wrong = Object.keys(allowed).find((name) => !allowed[name](get(name)));
    return wrong ? `The Explorer cannot run with ${wrong} = ${JSON.stringify(get(wrong))}.` : "";
  }
}
