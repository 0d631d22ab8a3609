/* A second tank beside the first, on the same seed: with another agent, or with one that has learned before.

Both show the same moment of their runs. The same agent has the settings of the first, another one those of its preset,
and elements are dropped into both. An agent that has learned keeps the values of a run of the next seed, like the
veterans of chapter 1; nothing else of that run remains. */

const LESSONS = [100, 10, 0]; // simulated minutes for which the second agent may have learned
const VETERAN = { agent: "", learned: LESSONS[0] };

class Beside extends Starters {
  /** Two minutes of a newborn and a veteran, at a pace at which they can be told apart. */
  meetVeteran() {
    const { steps, world: { fps } } = this.presets[this.model.get("preset")];
    const act = () => {
      const { beside, life: { frame, second } } = this;
      if (!beside || !second) return;
      this.write({ playing: false });
      const lead = second.frame.reward - frame.reward;
      const ahead = lead < 0 ? "newborn" : "veteran";
      this.life.news = `${this.livedText()}: the ${ahead} is ${shown(Math.abs(lead))} ahead.`;
    };
    const news = "Same agent, same seed, for two minutes.";
    this.fresh({ speed: 10, playing: true }, { step: Math.min(steps, 120 * fps), hurries: false, act, news },
      { beside: VETERAN });
  }

  /** Begin a run beside {agent: a preset, or "" for the same one, learned: minutes}, or, given null, end that. */
  compare(beside) {
    this.beside = beside;
    if (beside) this.note("run"), this.write({ playing: true }); // both from their first step
    else this.stopSecond();
    this.refresh();
  }

  toggleSecond() {
    return this.beside ? this.compare(null) : this.meetVeteran();
  }

  chooseSecond() {
    return this.compare({ agent: this.control("beside").value, learned: Number(this.control("learned").value) });
  }

  stopSecond() {
    this.secondEngine?.stop();
    Object.assign(this, { secondEngine: null });
    this.life.second = null;
  }

  /** The agents whose worlds are like that of a preset, without the preset itself. */
  rivalsOf(preset) {
    const { presets } = this;
    return orderedKeys(presets).filter((key) =>
      key !== preset && presets[key].world.name === presets[preset].world.name);
  }

  /** A message on a comparison that cannot be made, or "". */
  problemBeside(preset, beside) {
    if (!beside) return "";
    const isKnown = ["", ...this.rivalsOf(preset)].includes(beside.agent) && LESSONS.includes(beside.learned);
    return isKnown ? "" : `There is no agent “${beside.agent}” that has learned for ${beside.learned} minutes in such a world.`;
  }

  secondSettings() {
    const { presets, beside: { agent } } = this;
    const settings = this.settings();
    return agent ? { ...initialSettings(presets, agent), n_creeps: settings.n_creeps } : settings;
  }

  askSecond(message) {
    return this.ask(message, this.secondEngine);
  }

  async beginSecond() {
    const { presets, model, life: { length, changes, world: { fps } } } = this;
    if (!this.beside) return;
    const { agent: chosen } = this.beside;
    if (chosen && !this.rivalsOf(model.get("preset")).includes(chosen)) this.beside = VETERAN;
    const [{ agent, learned }, settings] = [this.beside, this.secondSettings()];
    const world = worldOf(presets, settings);
    const stepsIn = (seconds) => Math.max(1, Math.round(seconds * world.fps));
    const request = { type: "begin", parameters: this.parameters(settings), world, run: model.get("run"),
      changes: agent ? presets[agent].changes : changes, map: this.control("map").value, ...this.layers() };
    this.secondEngine ??= startEngine(model, (message) => this.fail(message));
    if (learned && !await this.teach({ ...request, steps: stepsIn(60 * learned) })) return;
    const frame = await this.askSecond({ ...request, seed: model.get("seed"), keeps: learned > 0,
      steps: stepsIn(length.steps / fps), bin_steps: stepsIn(length.bin / fps) });
    if (frame) this.life.second = { world, parameters: request.parameters };
    this.takeSecond(frame);
  }

  /** Let the second agent learn. Returns whether it did, and was not interrupted by another choice of the reader's. */
  async teach(request) {
    const seed = (this.model.get("seed") + 1) % (MOST_SEED + 1);
    let frame = await this.askSecond({ ...request, seed, changes: [], bin_steps: request.steps });
    const isLeft = () => [...this.noted].some((name) => !["speed", "playing"].includes(name));
    while (frame && !frame.ended && !isLeft()) {
      const minutes = Math.floor(frame.step / request.world.fps / 60);
      this.part(".lived").textContent = `The second agent has learned for ${minutes} minutes …`;
      frame = await this.askSecond({ type: "advance", steps: STEPS_WITHOUT_END, budget: FREE_BUDGET });
    }
    if (frame && !frame.ended) {
      if (!NEW_RUN.some((name) => this.noted.has(name))) this.due = this.life.due;
      this.note("run");
    }
    return Boolean(frame?.ended);
  }

  /** Bring the second tank to a moment of the first. */
  async keepStep({ step }) {
    const { second, world: { fps } } = this.life;
    if (!second) return;
    const steps = Math.round((step / fps) * second.world.fps) - second.frame.step;
    if (steps > 0) this.takeSecond(await this.askSecond({ type: "advance", steps, budget: Infinity }));
  }

  async changeSecond() {
    const { second } = this.life;
    if (!second) return;
    const parameters = this.parameters(this.secondSettings());
    if (JSON.stringify(parameters) === JSON.stringify(second.parameters)) return;
    Object.assign(second, { parameters });
    this.takeSecond(await this.askSecond({ type: "change", parameters }));
  }

  /** Show the same map and layers as in the first tank, and the way to the same cell. */
  async lookSecond() {
    const { second, frame: { seen: { name, goal } } } = this.life;
    if (second) this.takeSecond(await this.askSecond({ type: "look", map: name, goal, ...this.layers() }));
  }

  /** Take a frame of the second run, or null, since that has ended. */
  takeSecond(frame) {
    const { second } = this.life;
    if (!frame || !second) return;
    Object.assign(second, { frame });
    const { step: secondStep, reward: secondScore, seen: { goal } } = frame;
    Object.assign(this.root.dataset, { secondStep, secondScore, secondGoal: goal ?? "" });
    this.wake();
  }

  /** What the two agents are called: short, since on a phone the tanks are narrow. */
  names() {
    const { presets, model, beside: { agent, learned } } = this;
    const { label } = presets[model.get("preset")] ?? {};
    if (!agent) return learned ? ["Newborn", "Veteran"] : [label, label];
    return [label, learned ? `${presets[agent].label}, a veteran` : presets[agent].label];
  }

  /** The scores of both, or "". */
  scores() {
    const { beside, life: { frame, second } } = this;
    if (!beside || !second) return "";
    const [first, other] = this.names();
    return `${first}: ${shown(frame.reward)} · ${other}: ${shown(second.frame.reward)}`;
  }

  showSecond() {
    const { beside, model, presets, root } = this;
    const preset = model.get("preset");
    for (const each of root.querySelectorAll(".second, .versus, .named")) each.hidden = !beside;
    this.action("compare").textContent = beside ? "End the comparison" : "Newborn beside veteran";
    this.action("compare").ariaPressed = Boolean(beside);
    if (!beside) delete root.dataset.beside;
    if (!beside || !Object.hasOwn(presets, preset)) return;
    if (root.dataset.of !== preset) {
      fillMenu(this.control("beside"), presets, this.rivalsOf(preset), new Option("the same agent", ""));
      root.dataset.of = preset;
    }
    Object.assign(this.control("beside"), { value: beside.agent });
    Object.assign(this.control("learned"), { value: beside.learned });
    root.dataset.beside = beside.agent;
  }

  drawSecond(colours) {
    const { beside, elements, life: { frame, second } } = this;
    if (!beside || !frame || !second) return;
    const [names, trail] = [this.names(), this.control("trail").checked];
    if (second.frame.arm) drawLimb(this.second, colours, second.frame);
    else drawArena(this.second, colours, second.frame, { trail, elements });
    this.root.querySelectorAll(".named").forEach((title, index) => {
      title.textContent = `${names[index]}: ${shown([frame, second.frame][index].reward)}`;
    });
  }
}
