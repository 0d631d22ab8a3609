/* The Explorer's controls of settings: they display the traits, and write the reader's choices into them. */

class Controls {
  /** parts: {panel, traits}. */
  constructor(parts) {
    Object.assign(this, parts);
  }

  /** Let one control stand by itself. Each of its settings is a whole run. */
  putFirst(name) {
    this.panel.putFirst(name, this.traits.presets);
    this.panel.offerOfPage(this.traits.presets);
    this.traits.write({ speed: 0 });
  }

  /** Let the next run be drawn as a whole, if this control stands by itself. */
  drawWhole(name) {
    if (name === this.panel.only) this.traits.write({ playing: true, speed: 0 });
  }

  /** What the controls of settings do, by name; all others write a number into the trait that has their name. */
  turned({ name, value, checked }) {
    const { traits } = this;
    const act = { resolutions: () => this.writeResolutions(), modality: () => traits.write({ modality: value }),
      object_state: () => traits.write({ object_state: value }), speed: () => traits.write({ speed: SPEEDS[value] }),
      learning_rate: () => traits.write({ learning_rate: power(value) }),
      learns: () => traits.write({ learning_rate: checked ? this.rate : 0 }),
      horizon: () => traits.write({ discount: 1 - 1 / power(value) }),
      memory: () => traits.write({ memory: Number(value) === NO_MEMORY ? 0 : power(value) }) }[name];
    if (act) return act();
    const [, node] = name.match(/^gain-(\d+)$/) ?? [];
    return traits.write(node ? { gains: traits.get("gains").with(node, Number(value)) } : { [name]: Number(value) });
  }

  writeResolutions() {
    const field = this.panel.control("resolutions");
    const numbers = field.value.split(/[\s,;]+/).filter(Boolean).map(Number);
    if (!isList(numbers, isWhole(1, 90))) return this.refuse(field, ALLOWED);
    this.panel.forgive();
    return this.traits.write({ resolutions: inOrder(numbers) });
  }

  toggleResolution(one) {
    this.drawWhole("resolutions");
    const before = this.traits.get("resolutions");
    const after = before.includes(one) ? before.filter((other) => other !== one) : inOrder([...before, one]);
    if (after.length) this.traits.write({ resolutions: after });
  }

  /** Restore the old value of a field whose new one is not allowed. */
  refuse(field, allowed) {
    this.panel.refuse(field, allowed);
    this.show();
  }

  /** Refuse the number in a field if it is not allowed. Returns whether it is. */
  accepts(field) {
    const isAllowed = field.checkValidity();
    if (isAllowed) this.panel.forgive();
    else this.refuse(field, WHOLE(field));
    return isAllowed;
  }

  /** Offer the runs of the condition that is watched, if it has any. */
  offerRuns() {
    const { panel, traits: { shown: { totals = [] } } } = this;
    panel.part(".open").hidden = !totals.length;
    panel.part(".of").textContent = `of ${totals.length}, as behind the figure`;
    panel.control("open-run").max = totals.length - 1;
  }

  show() {
    const { panel, traits, traits: { preset } } = this;
    const { nodes, modality, recursion, red, avoided, can_remember, learning_rate, parameters: { learning } } = preset;
    panel.control("valence_red").previousElementSibling.textContent = `Valence of ${AVOIDED[avoided] ?? "red"}`;
    for (const name of ["modality", "seed", "run"]) panel.control(name).value = traits.get(name);
    panel.offer("modality", nodes.length === 1 && modality !== "");
    panel.control("object_state").value = traits.get("object_state") || "object";
    panel.offer("object_state", statedNodes(preset, traits.modalities, traits.settings()).length > 0);
    panel.offer("recursion", recursion !== null);
    panel.offer("valence_red", red.length > 0);
    panel.offer("n_creeps", traits.hasCreeps());
    panel.control("resolutions").value = traits.get("resolutions").join(", ");
    panel.offerResolutions(preset.resolutions);
    for (const chip of panel.part(".chips").children) {
      chip.ariaPressed = traits.get("resolutions").includes(Number(chip.dataset.chip));
    }
    panel.offer("memory", can_remember);
    const sliders = ["recursion", "valence_red", "n_creeps", "exploration"];
    for (const name of sliders) panel.showSlider(name, traits.get(name) ?? 0);
    const [rate, memory] = [traits.get("learning_rate"), traits.get("memory")];
    this.rate = rate || this.rate || learning_rate; // with which learning goes on when it is switched on again
    panel.control("learns").checked = rate > 0;
    panel.showSlider("learning_rate", Math.log10(rate || 0.001), shown(rate));
    this.showHorizon(learning.bootstrap || memory > 0);
    panel.showSlider("memory", memory ? Math.log10(memory) : NO_MEMORY, shown(memory));
    this.showGains(nodes);
    panel.showPick(traits.settings(), traits.presets);
  }

  showHorizon(isDiscounted) {
    const horizon = 1 / (1 - this.traits.get("discount"));
    const cells = horizon === Infinity ? "∞" : shown(horizon);
    this.panel.control("horizon").disabled = !isDiscounted;
    this.panel.showSlider("horizon", Math.log10(horizon), isDiscounted ? cells : "no effect");
  }

  showGains(nodes) {
    const { panel, traits } = this;
    grow(panel.part(".gains"), nodes.length, (index) => elementOf(slide(`gain-${index}`, "", 0, 5, 0.1)));
    panel.part(".gains").hidden = nodes.length === 1; // the choice among actions does not depend on it
    nodes.forEach((node, index) => {
      panel.control(`gain-${index}`).parentElement.firstChild.textContent = `Gain of ${titleOf(node)}`;
      panel.showSlider(`gain-${index}`, traits.get("gains")[index]);
    });
  }

  /** Show how many times as fast as real time the run is, 0 for full speed. */
  showSpeed(speed) {
    const notch = speed ? SPEEDS.findLastIndex((each) => each && each <= Math.max(1, speed)) : SPEEDS.length - 1;
    this.panel.showSlider("speed", notch, speed ? `${shown(speed)}× real time` : "full speed");
  }
}
