/* A second tank beside the first, on the same seed: with another agent, or with one that has learned before.

Both show the same moment of their runs. The same agent has the settings of the first, another one those of its preset,
and elements are dropped into both. An agent that has learned keeps the values of a run of the next seed, like the
veterans of chapter 1; nothing else of that run remains. */

const LESSONS = [100, 10, 0]; // simulated minutes for which the second agent may have learned
const VETERAN = { agent: "", learned: LESSONS[0] };

class Second {
  beside = null; // who is in the second tank: {agent: a preset, or "" for the same one, learned: minutes}
  engine = null;

  /** parts: {panel, traits, tank, hands}, and functions {refresh, wake, fail} of the Explorer. */
  constructor(parts) {
    Object.assign(this, parts);
  }

  /** Begin a run beside somebody, or, given null, end that. */
  compare(beside) {
    this.beside = beside;
    if (beside) this.traits.note("run"), this.traits.write({ playing: true }); // both from their first step
    else this.stop();
    this.refresh();
  }

  choose() {
    const [agent, learned] = ["beside", "learned"].map((name) => this.panel.control(name).value);
    return this.compare({ agent, learned: Number(learned) });
  }

  stop() {
    this.engine?.stop();
    this.engine = null;
    this.tank.run.second = null;
  }

  /** The agents whose worlds are like that of a preset, without the preset itself. */
  rivalsOf(preset) {
    const { presets } = this.traits;
    return orderedKeys(presets).filter((key) =>
      key !== preset && presets[key].world.name === presets[preset].world.name);
  }

  /** A message on a comparison that cannot be made, or "". */
  problem(preset, beside) {
    if (!beside) return "";
    const isKnown = ["", ...this.rivalsOf(preset)].includes(beside.agent) && LESSONS.includes(beside.learned);
    const learned = counted(beside.learned, "minute");
    return isKnown ? "" : `There is no agent “${beside.agent}” that has learned for ${learned} in such a world.`;
  }

  settings() {
    const { traits: { presets }, beside: { agent } } = this;
    const settings = this.traits.settings();
    return agent ? { ...initialSettings(presets, agent), n_creeps: settings.n_creeps } : settings;
  }

  parameters() {
    return this.traits.parameters(this.hands.elements, this.settings());
  }

  ask(message) {
    return this.tank.ask(message, this.engine);
  }

  async begin() {
    const { panel, traits, tank: { run: { length, changes, world: { fps } } } } = this;
    if (!this.beside) return;
    const { agent: chosen } = this.beside;
    if (chosen && !this.rivalsOf(traits.get("preset")).includes(chosen)) this.beside = VETERAN;
    const { agent, learned } = this.beside;
    const world = traits.world(this.settings());
    const stepsIn = (seconds) => Math.max(1, Math.round(seconds * world.fps));
    const request = { type: "begin", parameters: this.parameters(), world, run: traits.get("run"),
      changes: agent ? traits.presets[agent].changes : changes, map: panel.control("map").value, ...panel.layers() };
    this.engine ??= startEngine(traits.model, this.fail);
    if (learned && !await this.teach({ ...request, steps: stepsIn(60 * learned) })) return;
    const frame = await this.ask({ ...request, seed: traits.get("seed"), keeps: learned > 0,
      steps: stepsIn(length.steps / fps), bin_steps: stepsIn(length.bin / fps) });
    if (frame) this.tank.run.second = { world, parameters: request.parameters };
    this.take(frame);
  }

  /** Let the second agent learn. Returns whether it did, and was not interrupted by another choice of the reader's. */
  async teach(request) {
    const { panel, traits, tank } = this;
    const seed = (traits.get("seed") + 1) % (MOST_SEED + 1);
    let frame = await this.ask({ ...request, seed, changes: [], bin_steps: request.steps });
    const isLeft = () => [...traits.noted].some((name) => !["speed", "playing"].includes(name));
    while (frame && !frame.ended && !isLeft()) {
      const minutes = Math.floor(frame.step / request.world.fps / 60);
      panel.part(".minutes").textContent = `The second agent has learned for ${counted(minutes, "minute")} …`;
      frame = await this.ask({ type: "advance", steps: STEPS_WITHOUT_END, budget: FREE_BUDGET });
    }
    if (frame && !frame.ended) {
      if (!NEW_RUN.some((name) => traits.noted.has(name))) tank.due = tank.run.due;
      traits.note("run");
    }
    return Boolean(frame?.ended);
  }

  /** Bring the second tank to a moment of the first. */
  async keepStep({ step }) {
    const { second, world: { fps } } = this.tank.run;
    if (!second) return;
    const steps = Math.round((step / fps) * second.world.fps) - second.frame.step;
    if (steps > 0) this.take(await this.ask({ type: "advance", steps, budget: Infinity }));
  }

  async change() {
    const { second } = this.tank.run;
    if (!second) return;
    const parameters = this.parameters();
    if (JSON.stringify(parameters) === JSON.stringify(second.parameters)) return;
    Object.assign(second, { parameters });
    this.take(await this.ask({ type: "change", parameters }));
  }

  /** Show the same map and layers as in the first tank, and the way to the same cell. */
  async look() {
    const { second, frame: { seen: { name, goal } } } = this.tank.run;
    if (second) this.take(await this.ask({ type: "look", map: name, goal, ...this.panel.layers() }));
  }

  /** Go on for as long again. */
  async extend() {
    if (this.tank.run.second) this.take(await this.ask({ type: "extend" }));
  }

  /** Take a frame of the second run, or null, since that has ended. */
  take(frame) {
    const { second } = this.tank.run;
    if (!frame || !second) return;
    Object.assign(second, { frame });
    const { step: secondStep, reward: secondScore, seen: { goal } } = frame;
    Object.assign(this.panel.root.dataset, { secondStep, secondScore, secondGoal: goal ?? "" });
    this.wake();
  }

  /** What the two agents are called: short, since on a phone the tanks are narrow. */
  names() {
    const { traits: { presets, preset }, beside: { agent, learned } } = this;
    const { label } = preset ?? {};
    if (!agent) return learned ? ["Newborn", "Veteran"] : [label, label];
    return [label, learned ? `${presets[agent].label}, a veteran` : presets[agent].label];
  }

  /** The scores of both, or "". */
  scores() {
    const { beside, tank: { run: { frame, second } } } = this;
    if (!beside || !second) return "";
    const [first, other] = this.names();
    return `${first}: ${shown(frame.reward)} · ${other}: ${shown(second.frame.reward)}`;
  }

  show() {
    const { beside, panel, panel: { root }, traits } = this;
    const preset = traits.get("preset");
    for (const each of root.querySelectorAll(".second, .versus, .named")) each.hidden = !beside;
    panel.action("compare").textContent = beside ? "End the comparison" : "Newborn beside veteran";
    panel.action("compare").ariaPressed = Boolean(beside);
    if (!beside) delete root.dataset.beside;
    if (!beside || !traits.preset) return;
    if (root.dataset.of !== preset) {
      fillMenu(panel.control("beside"), traits.presets, this.rivalsOf(preset), new Option("the same agent", ""));
      root.dataset.of = preset;
    }
    Object.assign(panel.control("beside"), { value: beside.agent });
    Object.assign(panel.control("learned"), { value: beside.learned });
    root.dataset.beside = beside.agent;
  }

  draw(colours) {
    const { beside, panel, hands: { elements }, tank: { run: { frame, second } } } = this;
    if (!beside || !frame || !second) return;
    const [names, trail] = [this.names(), panel.control("trail").checked];
    if (second.frame.arm) drawLimb(panel.other, colours, second.frame);
    else drawArena(panel.other, colours, second.frame, { trail, elements });
    panel.root.querySelectorAll(".named").forEach((title, index) => {
      title.textContent = `${names[index]}: ${shown([frame, second.frame][index].reward)}`;
    });
  }
}
