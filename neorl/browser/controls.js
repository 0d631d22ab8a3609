/* The Explorer's controls: they write the reader's settings into the traits, and display the traits. */

class Controls {
  part(selector) {
    return this.root.querySelector(selector);
  }

  control(name) {
    return this.part(`[name="${name}"]`);
  }

  action(name) {
    return this.part(`[data-action="${name}"]`);
  }

  fillMenus() {
    const { presets } = this;
    fillMenu(this.control("preset"), presets, orderedKeys(presets));
    this.part(".chips").append(...CHIPS.map(chip));
    this.control("learned").append(...LESSONS.map((minutes) => new Option(`${minutes} minutes`, minutes)));
    this.control("modality").append(...Object.keys(this.modalities).map((name) => new Option(name, name)));
    this.control("object_state").append(...Object.entries(STATES).map(([state, label]) => new Option(label, state)));
  }

  /** Put one control beside the tank, with a sentence on it, and fold the others. */
  putFirst(name) {
    this.only = name;
    this.write({ speed: this.pace = 0 });
    this.offerOfPage();
    const { parentElement: label } = this.control(name);
    const help = element("p", { className: "help" }, HELP[name]);
    const first = element("div", { className: "only" }, label.closest(".setting") ?? label, help);
    this.part(".starters").prepend(this.action("red"), this.action("tour"));
    this.part(".more").prepend(...[".bar", ".settings", ".starters", ".tools"].map((each) => this.part(each)));
    this.part(".columns").prepend(first);
    this.part("summary").textContent = "All controls";
    this.isPart = true;
  }

  /** Offer the agents of the page before all others, and as resolutions those of their maps. */
  offerOfPage() {
    const { presets } = this;
    const menu = this.control("preset");
    menu.prepend(...menu.querySelectorAll(`[label="${OF_PAGE}"]`));
    const own = orderedKeys(presets).filter((key) => presets[key].is_condition);
    const numbers = inOrder(own.flatMap((key) => presets[key].resolutions)).filter((n) => n > 1);
    if (numbers.length) this.part(".chips").replaceChildren(...numbers.map(chip));
  }

  /** What a run is called whose only control stands beside the tank: by its setting. */
  settingText() {
    const { model, presets, only } = this;
    const value = model.get(only) ?? "";
    const nameOf = (preset) => presets[preset].label.split(": ").at(-1); // without its figure
    if (only && value === "") return nameOf(model.get("preset")); // an agent without such a setting
    const texts = { resolutions: () => inOrder(value).map((n) => `N${n}`).join(", "), modality: () => value,
      object_state: () => STATES[value], preset: () => nameOf(value) };
    return only && (texts[only]?.() ?? `${NAMES[only]} ${shown(value)}`);
  }

  /** Let the next run be drawn as a whole, if this control stands by itself. */
  drawWhole(name) {
    if (name === this.only) this.write({ playing: true, speed: 0 });
  }

  /** Keep the reward of a run that is over, to be drawn beside the next one, which has another setting. */
  keepCurve() {
    const { frame, name, length, world: { fps } } = this.life;
    if (!this.only || !frame?.ended || name === this.settingText()) return;
    const span = { seconds: length.steps / fps, binSeconds: length.bin / fps, lived: frame.step / fps };
    this.before = { name, span, totals: frame.rewards, colour: "place", isPale: true };
  }

  turned({ type, target }) {
    const { name, type: kind, value } = target;
    if (type !== (["text", "number"].includes(kind) ? "change" : "input")) return null;
    this.touched = true;
    if (kind === "number" && !target.checkValidity()) return this.refuse(target, WHOLE(target));
    if (kind === "number") this.forgive();
    const act = { resolutions: () => this.writeResolutions(target), preset: () => this.chooseAgent(value),
      modality: () => this.write({ modality: value }), object_state: () => this.write({ object_state: value }),
      speed: () => this.write({ speed: SPEEDS[value] }),
      learning_rate: () => this.write({ learning_rate: power(value) }),
      learns: () => this.write({ learning_rate: target.checked ? this.rate : 0 }), "open-run": () => null,
      horizon: () => this.write({ discount: 1 - 1 / power(value) }),
      memory: () => this.write({ memory: Number(value) === NO_MEMORY ? 0 : power(value) }),
      map: () => this.look({ map: value, goal: null }), field: () => this.look(this.layers()),
      heat: () => this.look(this.layers()), trail: () => this.wake(),
      beside: () => this.chooseSecond(), learned: () => this.chooseSecond(),
      "element-valence": () => this.changeElement(this.selected, { valence: Number(value) }) }[name];
    this.drawWhole(name);
    if (act) return act();
    const [, node] = name.match(/^gain-(\d+)$/) ?? [];
    return this.write(node ? { gains: this.model.get("gains").with(node, Number(value)) } : { [name]: Number(value) });
  }

  clicked({ action, chip: resolution }, detail) {
    if (resolution) return this.toggleResolution(Number(resolution));
    const acts = { play: () => this.togglePlay(), step: () => this.step(), reset: () => this.reset(),
      "new-run": () => this.newRun(), open: () => this.openRun(), drop: () => this.beginDrop(detail === 0),
      delete: () => this.deleteElement(), link: () => this.copyLink(), picture: () => this.savePicture(),
      csv: () => this.saveRun(), alone: () => this.showAlone(), "go-on": () => this.goOn(), watch: () => this.watch(),
      red: () => this.revalueRed(), corner: () => this.showCorner(), compare: () => this.toggleSecond(),
      game: () => (this.life.game ? this.leaveGame() : this.joinGame()), clear: () => this.clearElements(),
      tour: () => this.startTour(), next: () => this.nextStop(), end: () => this.endTour() };
    this.touched ||= action in acts;
    if (TO_WATCH.includes(action)) this.showTank();
    return acts[action]?.();
  }

  /** Begin a run of an agent, also of the present one, since its run may have failed. */
  chooseAgent(preset) {
    this.due = this.beginningOf(preset);
    this.write(initialSettings(this.presets, preset));
    this.showControls(); // at once, so that no slider of the previous agent is left
    this.note("preset");
  }

  togglePlay() {
    const again = this.life.frame?.ended;
    if (again) this.note("run"); // the same run, with the present settings
    this.write({ playing: again || !this.model.get("playing") });
  }

  /** Let a run that is over go on for as long again. */
  async goOn() {
    const { length, second } = this.life;
    Object.assign(length, { steps: 2 * length.steps, bin: 2 * length.bin });
    this.take(await this.ask({ type: "extend" }));
    if (second) this.takeSecond(await this.askSecond({ type: "extend" }));
    this.refresh();
  }

  step() {
    this.write({ playing: false });
    return this.life.advancing ? null : this.advance(1, TIMED_BUDGET);
  }

  /** Restart with the preset's own settings: the present ones may be the cause of a failure. */
  reset() {
    if (!this.life.frame) this.abandon();
    const keys = [this.model.get("preset"), ...orderedKeys(this.presets)];
    const preset = keys.find((each) => Object.hasOwn(this.presets, each));
    this.write({ preset });
    this.fresh();
  }

  /** The next run of these settings, with the same elements. */
  newRun() {
    this.write({ run: (this.model.get("run") + 1) % (MOST_SEED + 1) });
  }

  openRun() {
    const run = this.control("open-run");
    if (!run.checkValidity()) return this.refuse(run, WHOLE(run));
    this.forgive();
    if (!this.life.frame) this.abandon();
    this.write({ preset: this.condition });
    return this.fresh({ run: run.valueAsNumber, speed: 0, playing: true });
  }

  /** Offer the runs of the condition that is watched, if it has any. */
  offerRuns() {
    const { totals = [] } = this.presets[this.condition] ?? {};
    this.part(".open").hidden = !totals.length;
    this.part(".of").textContent = `of ${totals.length}, as behind the figure`;
    this.control("open-run").max = totals.length - 1;
  }

  writeResolutions(field) {
    const numbers = field.value.split(/[\s,;]+/).filter(Boolean).map(Number);
    const valid = isList(numbers, isWhole(1, 90));
    if (!valid) return this.refuse(field, ALLOWED);
    this.forgive();
    return this.write({ resolutions: inOrder(numbers) });
  }

  /** Restore the old value of a field whose new one is not allowed, with a message below it. */
  refuse(field, allowed) {
    field.ariaInvalid = "true";
    (field.closest(".setting, .open") ?? field.parentElement).after(this.refusal(allowed));
    if (field.name === "open-run") field.value = 0;
    this.showControls();
  }

  /** The message of a refusal, to be put where the reader looks. */
  refusal(reason) {
    return Object.assign(this.part(".refused"), { textContent: `${reason} Nothing was changed.` });
  }

  /** Clear the message of a refusal, once another input has been accepted. */
  forgive() {
    for (const field of this.root.querySelectorAll("[aria-invalid]")) field.ariaInvalid = null;
    this.part(".refused").textContent = "";
  }

  toggleResolution(one) {
    this.drawWhole("resolutions");
    const before = this.model.get("resolutions");
    const after = before.includes(one) ? before.filter((other) => other !== one) : inOrder([...before, one]);
    if (after.length) this.write({ resolutions: after });
  }

  write(values) {
    for (const [name, value] of Object.entries(values)) {
      if (isSame(this.model.get(name), value)) continue;
      this.model.set(name, value);
      this.note(name);
    }
    this.model.save_changes();
  }

  refresh() {
    const { life, life: { frame, game }, root, model } = this;
    const [running, before] = [this.running(), root.dataset.state];
    const idle = this.failed ? "failed" : !frame ? "loading" : frame.ended ? "ended" : "paused";
    Object.assign(root.dataset, { state: running ? "running" : idle, condition: this.condition ?? "" });
    if (running && before !== "running") Object.assign(life, { since: performance.now(), counted: 0 });
    if (!running && before === "running" && frame) life.rate = 0, this.report();
    this.action("play").textContent = frame?.ended ? "Play again" : model.get("playing") ? "Pause" : "Play";
    this.action("drop").disabled = !frame || this.elements.length >= MOST_ELEMENTS;
    this.action("drop").ariaPressed = Boolean(this.dropping);
    Object.assign(this.action("step"), { disabled: !frame, hidden: frame?.ended });
    this.action("go-on").hidden = !frame?.ended;
    for (const name of ["link", "picture", "csv"]) this.action(name).disabled = !frame;
    this.action("link").hidden = isInApplication();
    this.action("alone").hidden = !document.fullscreenEnabled;
    this.offerStarters();
    this.showSecond();
    for (const name of ["map", "field", "heat"]) this.control(name).disabled = !frame;
    this.part(".pad").hidden = !game;
    this.showSpeed();
    this.part(".element").hidden = this.selected === null;
    const preset = this.presets[model.get("preset")];
    this.offer("learns", preset && canStopLearning(preset) && (!this.isPart || life.turn));
    this.showLegend();
    this.writeAddress();
    this.wake();
  }

  showLegend() {
    const { before, life: { name, changed } } = this;
    const { label, runs, band } = this.presets[this.condition] ?? {};
    const swatch = (kind) => element("span", { className: `swatch ${kind}` });
    const own = `${name ? `${name}: ` : ""}this run${changed ? ", changed on the way" : ""}`;
    this.part(".legend").replaceChildren(swatch("own"), own,
      ...(before ? [swatch("before"), `${before.name}: the one before`] : []),
      ...(this.beside ? [swatch("beside"), this.names()[1]] : []),
      ...(band ? [swatch("band"), `where ${band.has_all ? "all" : "most"} of ${runs} runs of ${label} lie`] : []));
  }

  showControls() {
    const { model } = this;
    const preset = this.presets[model.get("preset")];
    const { nodes, modality, recursion, red, avoided, can_remember, learning_rate, parameters: { learning } } = preset;
    this.control("valence_red").previousElementSibling.textContent = `Valence of ${AVOIDED[avoided] ?? "red"}`;
    for (const name of ["modality", "seed", "run"]) this.control(name).value = model.get(name);
    this.offer("modality", nodes.length === 1 && modality !== "");
    this.control("object_state").value = model.get("object_state") || "object";
    this.offer("object_state", statedNodes(preset, this.modalities, this.settings()).length > 0);
    this.offer("recursion", recursion !== null);
    this.offer("valence_red", red.length > 0);
    this.offer("n_creeps", this.hasCreeps());
    this.control("resolutions").value = model.get("resolutions").join(", ");
    for (const chip of this.part(".chips").children) {
      chip.ariaPressed = model.get("resolutions").includes(Number(chip.dataset.chip));
    }
    this.offer("memory", can_remember);
    const sliders = ["recursion", "valence_red", "n_creeps", "exploration"];
    for (const name of sliders) this.showSlider(name, model.get(name) ?? 0);
    const [rate, horizon, memory] = [model.get("learning_rate"), 1 / (1 - model.get("discount")), model.get("memory")];
    this.rate = rate || this.rate || learning_rate; // with which learning goes on when it is switched on again
    this.control("learns").checked = rate > 0;
    this.showSlider("learning_rate", Math.log10(rate || 0.001), shown(rate));
    const discounts = learning.bootstrap || memory > 0;
    this.control("horizon").disabled = !discounts;
    const cells = horizon === Infinity ? "∞" : shown(horizon);
    this.showSlider("horizon", Math.log10(horizon), discounts ? cells : "no effect");
    this.showSlider("memory", memory ? Math.log10(memory) : NO_MEMORY, shown(memory));
    grow(this.part(".gains"), nodes.length, (index) => elementOf(slide(`gain-${index}`, "", 0, 5, 0.1)));
    this.part(".gains").hidden = nodes.length === 1; // the choice among actions does not depend on it
    nodes.forEach((node, index) => {
      this.control(`gain-${index}`).parentElement.firstChild.textContent = `Gain of ${titleOf(node)}`;
      this.showSlider(`gain-${index}`, model.get("gains")[index]);
    });
  }

  /** Show a control and enable it, or hide it where the agent or its world has no such setting. */
  offer(name, isOffered) {
    this.control(name).disabled = this.control(name).parentElement.hidden = !isOffered;
  }

  hasCreeps() {
    return this.model.get("n_creeps") !== null;
  }

  showSpeed() {
    const speed = this.speed();
    const notch = speed ? SPEEDS.findLastIndex((each) => each && each <= Math.max(1, speed)) : SPEEDS.length - 1;
    this.showSlider("speed", notch, speed ? `${shown(speed)}× real time` : "full speed");
    this.control("speed").disabled = Boolean(this.life.game);
  }

  showSlider(name, value, text = shown(value)) {
    const slider = this.control(name);
    slider.value = value;
    slider.nextElementSibling.value = slider.ariaValueText = text;
  }

  draw(now = performance.now()) {
    const { life: { frame, cursor, world, rate } } = this;
    const isLoading = !frame && !this.failed;
    if (!this.arena.clientWidth || (isLoading && this.drawn)) return; // keep the last picture while loading
    Object.assign(this, { drawn: now, stale: false });
    const colours = readColours(this.root);
    this.drawSecond(colours);
    drawArena(this.arena, colours, frame, { cursor, trail: this.control("trail").checked });
    this.arrange(Boolean(frame?.arm));
    if (frame?.arm) drawLimb(this.limb, colours, frame);
    this.drawRates(colours);
    this.placeHandles();
    this.showKey();
    if (frame && !this.running()) this.part(".unseen").textContent = describe(frame);
    this.part(".lived").textContent = this.beside ? this.minutesText() : this.livedText(); // the tanks have titles
    this.part(".pace").textContent = this.running() && rate
      ? `${grouped(rate)} steps per second, ${grouped(rate / world.fps)} × real time` : "";
    const able = [frame?.seen.axes.length, true, this.hasCreeps()]; // the cells of contacts are not goals
    this.part(".said").textContent = this.sentences().join(" ") || HINTS.filter((_, hint) => able[hint]).join(" ");
  }

  /** Draw in the colours of paper; a run that has not begun has nothing to print. */
  print(isOnPaper) {
    this.root.classList.toggle("on-paper", isOnPaper && Boolean(this.life.frame));
    this.draw(); // at once, since the page is printed as soon as this returns
  }

  /** Draw and write what the run has earned and met, and that of the second tank. */
  drawRates(colours) {
    const { condition, life: { frame, length, world, second } } = this;
    const [frames, fps] = [[frame, second?.frame].filter(Boolean), world.fps];
    const span = { seconds: length.steps / fps, binSeconds: length.bin / fps, lived: (frame?.step ?? 0) / fps };
    const earned = frames.map(({ rewards }, tank) => ({ totals: rewards, colour: ["agent", "place"][tank] }));
    const all = [this.before, ...earned.reverse()].filter(Boolean);
    drawCurves(this.curve, colours, span, all, this.presets[condition]?.band);
    drawCurves(this.catches, colours, span, frames.flatMap(({ hits }, tank) => hits.map(({ kind, counts }) =>
      ({ totals: counts, per: 60, colour: COLOUR_OF.get(kind) ?? "place", isDashed: tank > 0 }))));
    const inWords = ({ hits }) => hits.map(({ kind, counts }) =>
      `${kind} ${shown((ratesOf(counts, span, 60).rates.at(-1) ?? 0).toFixed(1))}`).join(", ");
    const met = frames.map((each, tank) => `${second ? `${this.names()[tank]} ` : ""}${inWords(each)}`);
    const turned = this.turnText(); // counts of single minutes, beside which those of longer bins would confuse
    this.part(".counts").textContent = turned;
    this.part(".of-catches").textContent = turned ? "Caught a minute, by colour"
      : `${this.hasCreeps() ? "Caught" : "Met"} a minute: ${met.join(" · ")}`;
    const wanted = new Set((frame?.wants ?? []).map(({ kind, valence }) => `${kind} ${signed(valence)}`));
    const dropped = this.elements.map(({ valence }) => `element ${signed(valence)}`);
    this.part(".wants").textContent = frame ? `Wants: ${[...wanted, ...dropped].join(", ")}` : "";
  }

  /** Show an arm large in its workspace, with joint space, where its cells are, beside it. */
  arrange(hasArm) {
    const [space, limb] = [this.part(".space"), this.part(".limb")];
    if (limb.hidden === !hasArm) return;
    const [main, inset] = hasArm ? [limb, space] : [space, limb];
    this.part(".first").append(main);
    this.part(".side").prepend(inset);
    limb.hidden = space.firstElementChild.hidden = !hasArm;
  }

  showKey() {
    const { frame } = this.life;
    const entries = frame ? keyOf(frame) : [];
    if (isSame(entries, this.key)) return;
    this.key = entries;
    this.part(".key").replaceChildren(...entries.map(entryOf));
  }

  minutesText() {
    const { frame, world } = this.life;
    return frame ? `${(frame.step / world.fps / 60).toFixed(1)} simulated minutes` : "";
  }

  livedText() {
    const { frame, game } = this.life;
    if (!frame) return "";
    if (game) return `You: ${shown(frame.player?.reward ?? 0)} · neoRL: ${shown(frame.reward - game.score)}`;
    return `${this.minutesText()} · ${this.scores() || `score ${shown(frame.reward)}`}`;
  }

  sentences() {
    const { life: { frame, game, changed, due, news }, presets, condition, model } = this;
    if (!frame) return [];
    if (this.dropping) return [WHERE];
    const [said, run, score, { seen }] = [[], model.get("run"), shown(frame.reward), frame];
    const { totals = [], seed, steps } = presets[condition] ?? {};
    if (frame.ended) said.push(`Run ${run} is over: its score is ${score}.`);
    if (frame.ended && run < totals.length && seed === model.get("seed") && steps === frame.step && !changed) {
      const same = Math.abs(totals[run] - frame.reward) < 1e-6 ? "the same" : "not the same";
      said.push(`The notebook computed ${shown(totals[run])} for this run: ${same}.`);
    }
    if (game) said.push(STEER);
    if (seen.goal !== null) said.push(describeWay(frame));
    if (due?.news ?? news) said.push(due?.news ?? news);
    else said.push(...this.turnSentences());
    return said;
  }
}
