/* The Explorer in the page: a learner that runs while the reader watches, with all its controls.

- The traits are the source of truth: a control writes its trait, and the page reacts to the trait, whether the change
  comes from a control, from Python or from a linked widget. Simultaneous changes are handled together.
- A new body, map or tank starts a new run; a new desire or way of learning continues with what was learned.
- A control that stands by itself draws whole runs, at full speed, and the last one with another setting beside it.
- The simulation runs in a worker, which answers every request once and in order. It advances only on request, with one
  such request at a time: a widget that is out of view makes none.
- The page holds a run in one object, `life`, which the next run replaces as a whole. A frame contains everything that
  is drawn, so runs cannot mix; requests for a run that has been replaced are not answered.
- Every failure ends the run with a message. The next change of a control tries again; Reset does so with the settings
  of the preset. */

class Explorer extends Saving {
  /** places: those of the model's views, of which the Explorer stands in the last one. */
  constructor(model, places) {
    super();
    Object.assign(this, { model, places, presets: model.get("_presets"), modalities: model.get("_modalities"),
      first: model.get("preset"), pace: Math.max(0, model.get("speed")), life: newLife(), elements: [], beside: null, selected: null,
      only: "", before: null, noted: new Set(), undo: [], drawn: 0, told: 0, failed: false });
    this.calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const id = `neorl-tank-${Math.random().toString(36).slice(2)}`; // each widget of a page has a module of its own
    this.root = elementOf(pageOf(id));
    [this.arena, this.second, this.limb, this.curve, this.catches] = this.root.querySelectorAll("canvas");
    this.fillMenus();
    places.at(-1).append(this.root);
    this.choosePart();
    this.due = this.beginningOf(this.first);
    this.listen();
    if (this.calm) this.write({ playing: false });
    this.arrive();
    this.refresh();
    const { top, height } = this.root.getBoundingClientRect();
    this.approach({ isIntersecting: height > 0 && top < innerHeight }); // before the page is first painted, not after
  }

  /** Begin with one control beside the tank, or, on a page about the Explorer, with all and the page's first agent. */
  choosePart() {
    const { model, presets } = this;
    const whole = this.root.closest(".neorl-whole");
    const first = whole && orderedKeys(presets).find((key) => presets[key].is_condition);
    if (first) this.write(initialSettings(presets, this.first = first));
    else if (!whole && model.get("control")) this.putFirst(model.get("control"));
  }

  listen() {
    const on = (target, types, act) => types.split(" ").forEach((type) => {
      const safe = this.safely(act);
      target.addEventListener(type, safe);
      this.undo.push(() => target.removeEventListener(type, safe));
    });
    const watch = (observer) => {
      observer.observe(this.root);
      this.undo.push(() => observer.disconnect());
    };
    on(this.root, "input change", (event) => this.turned(event));
    on(this.root, "click", ({ target, detail }) => this.clicked(target.closest("button")?.dataset ?? {}, detail));
    on(this.root, "keydown", (event) => this.pressed(event));
    on(this.root, "focusin", ({ target }) => target.matches(".interest") && this.select(indexOf(target)));
    const tank = this.part(".arena");
    for (const part of [tank, this.part(".pad")]) {
      on(part, "pointerdown", (event) => this.grasp(event));
      on(part, "pointerup pointercancel keyup focusout", () => this.life.game && (this.life.game.held = NO_ACTION));
    }
    on(tank, "pointermove", (event) => this.pull(event));
    on(tank, "lostpointercapture", () => { this.life.held = null; });
    on(tank, "pointerleave", () => { this.life.pointer = null; });
    on(tank, "click", (event) => this.tap(event));
    on(window, "hashchange", ({ newURL }) => this.hasAddress() && this.visit(new URL(newURL).hash));
    on(document, "click", (event) => this.followLink(event));
    on(document, "visibilitychange", () => this.refresh());
    for (const event of ["beforeprint", "afterprint"]) on(window, event, () => this.print(event === "beforeprint"));
    this.undo.push(watchLook([...this.root.querySelectorAll("canvas")], () => this.wake()));
    watch(new IntersectionObserver((entries) => this.approach(entries.at(-1)), { rootMargin: "200px" }));
    watch(new IntersectionObserver((entries) => this.sight(entries.at(-1))));
    for (const name of [...NEW_RUN, ...GOES_ON, "speed", "playing"]) {
      const note = () => this.note(name);
      this.model.on(`change:${name}`, note);
      this.undo.push(() => this.model.off(`change:${name}`, note));
    }
  }

  approach({ isIntersecting }) {
    if (!isIntersecting || this.near) return;
    this.near = true;
    this.note("near");
    this.arrive();
  }

  sight({ isIntersecting }) {
    this.inSight = isIntersecting;
    this.refresh();
  }

  // Reactions to traits

  note(name) {
    this.noted.add(name);
    if (this.following) return;
    const turn = this.following = {};
    queueMicrotask(this.safely(() => this.follow(turn)));
  }

  async follow(turn) {
    const { model, noted, presets, modalities } = this;
    while (turn === this.following && noted.size) {
      this.control("preset").value = model.get("preset");
      if (noted.has("preset") && presets[model.get("preset")] && !OF_PRESET.some((name) => noted.has(name))) {
        this.write(initialSettings(presets, model.get("preset"))); // as if chosen from the menu
      }
      if (noted.has("preset") && !noted.has("elements")) this.dropElements();
      const problem = problemOf(presets, modalities, model);
      this.complain(problem);
      if (problem || !this.near) break;
      const names = [...noted];
      noted.clear();
      if (names.some((name) => name !== "near")) this.forgive();
      const before = this.condition;
      this.condition = conditionOf(model.get("_layout").plane, presets, modalities, this.settings());
      if (this.condition !== before || !before) this.offerRuns();
      this.showControls();
      const begins = (name) => NEW_RUN.includes(name) || name === this.only;
      if (!this.engine || names.some(begins)) await this.begin();
      else if (names.some((name) => name === "elements" || GOES_ON.includes(name))) await this.change();
      this.refresh();
    }
    if (turn === this.following) this.following = null;
  }

  settings() {
    return Object.fromEntries(["preset", ...OF_PRESET].map((name) => [name, this.model.get(name)]));
  }

  parameters(settings = this.settings()) {
    const layout = this.model.get("_layout").plane; // enumerations are the same in all modules
    return chosenParameters(layout, this.presets, this.modalities, settings, this.elements);
  }

  async begin() {
    const { presets, model } = this;
    const [{ steps, band }, seed, run] = [presets[model.get("preset")], model.get("seed"), model.get("run")];
    const [world, bin] = [worldOf(presets, this.settings()), band?.steps_per_bin ?? Math.ceil(steps / 50)];
    const changes = this.condition === model.get("preset") ? presets[this.condition].changes : [];
    this.keepCurve();
    const times = 2 ** Math.max(0, Math.ceil(Math.log2((this.due?.step ?? 0) / steps))); // as if it had gone on
    const length = { steps: times * steps, bin: times * bin };
    this.life = newLife({ world, length, changes, changed: this.elements.length > 0, due: this.due,
      name: this.settingText() });
    this.due = null;
    this.refresh();
    this.engine ??= startEngine(model, (message) => this.fail(message));
    const begun = this.ask({ type: "begin", parameters: this.parameters(), world, seed, run, steps: length.steps,
      bin_steps: length.bin, changes, map: this.control("map").value, ...this.layers() });
    await this.beginSecond();
    this.take(await begun);
    await this.meet();
  }

  /** An engine's answer; if the run has been replaced since the request, the promise never resolves. */
  ask(message, engine = this.engine) {
    const { life } = this;
    return new Promise((resolve) => engine.ask(message).then((answer) => life === this.life && resolve(answer)));
  }

  async change() {
    const { life } = this;
    life.changed ||= life.frame.step > 0 || this.elements.length > 0;
    const changed = this.ask({ type: "change", parameters: this.parameters() });
    await this.changeSecond();
    this.take(await changed);
    if (life.frame.ended) await this.goOn(); // or the change would show nothing
  }

  /** Show another map, goal or place, with or without the field. Has no effect while a run loads. */
  async look(choice) {
    if (!this.life.frame) return;
    this.take(await this.ask({ type: "look", ...choice }));
    await this.lookSecond();
    this.writeAddress();
  }

  /** What is drawn of the superposed value, with its tiles along each side. */
  layers() {
    const tilesOf = (name) => (this.control(name).checked ? FIELD_TILES : 0);
    return { field: tilesOf("field"), heat: tilesOf("heat") };
  }

  // The run

  running() {
    const { frame } = this.life;
    const lives = frame && !frame.ended && !this.failed;
    return Boolean(lives && this.model.get("playing") && this.inSight && !document.hidden);
  }

  async advance(steps, budget) {
    const { life } = this;
    life.advancing = true;
    const until = life.due ? Math.max(0, life.due.step - life.frame.step) : steps;
    const frame = await this.ask({ type: "advance", steps: Math.min(steps, until), budget });
    await this.keepStep(frame);
    life.advancing = false;
    this.take(frame);
    this.count(frame.steps);
    await this.meet();
    if (this.running() && this.speed() === 0) this.safely(() => this.advance(STEPS_WITHOUT_END, this.budget()))();
  }

  speed() {
    const { game, due, frame } = this.life;
    if (due?.hurries) return 0;
    return game ? 1 : frame && this.isReaching() ? SLOW : this.model.get("speed");
  }

  /** The milliseconds of a request at full speed: a whole run asks for few frames, each of which costs many steps. */
  budget() {
    return this.only ? WHOLE_BUDGET : FREE_BUDGET;
  }

  take(frame) {
    Object.assign(this.life, { frame });
    this.showMaps(frame);
    const { step, reward: score, seen: { name: map, goal } } = frame;
    Object.assign(this.root.dataset, { step, score, map, goal: goal ?? "" });
    if (frame.ended && this.life.game) this.safely(() => this.leaveGame())();
    if (frame.ended) this.refresh();
    this.wake();
  }

  /** Update the menu of maps, which change with the agent, in some conditions during a run. */
  showMaps({ maps, shapes, seen }) {
    const menu = this.control("map");
    if (!isSame(maps, Array.from(menu.options, (option) => option.value))) menu.replaceChildren(...maps.map((name, m) => new Option(inWords(name, shapes[m]), name)));
    if (menu.value !== seen.name) menu.value = seen.name;
  }

  count(steps) {
    const { life } = this;
    life.counted += steps;
    const now = performance.now();
    if (!this.running() || now - life.since < 1000) return;
    Object.assign(life, { rate: Math.round((1000 * life.counted) / (now - life.since)), counted: 0, since: now });
    this.report();
  }

  /** Report the score to Python, and at intervals to screen readers. */
  report() {
    const { model, root, life: { frame, world, rate } } = this;
    root.dataset.rate = rate;
    model.set("seconds", frame.step / world.fps);
    model.set("score", frame.reward);
    model.save_changes();
    if (this.running() && performance.now() - this.told < 5000) return;
    this.told = performance.now();
    this.part(".unseen").textContent = describe(frame);
    this.part(".told").textContent = [`${this.livedText()}.`, ...this.sentences()].join(" ");
  }

  wake() {
    this.stale = true;
    this.schedule();
  }

  schedule() {
    this.scheduled ??= requestAnimationFrame(this.safely((now) => this.tick(now)));
  }

  tick(now) {
    const { life } = this;
    this.scheduled = null;
    const elapsed = Math.min(now - (this.ticked ?? now), 100) / 1000;
    this.ticked = now;
    if (life.dragged) this.safely(() => this.sendDragged())();
    if (this.running()) {
      const [free, most] = [this.speed() === 0, this.speed() * life.world.fps];
      life.owed = Math.min(life.owed + elapsed * most, Math.max(1, most / 10));
      const steps = free ? STEPS_WITHOUT_END : Math.floor(life.owed);
      if (!life.advancing && steps > 0) {
        if (life.game) this.steer(now);
        life.owed -= free ? 0 : steps;
        this.safely(() => this.advance(steps, free ? this.budget() : TIMED_BUDGET))();
      }
      this.schedule();
    }
    if (this.stale && (!this.calm || !this.running() || now - this.drawn >= 500)) this.draw(now);
  }

  // Failures, and the end

  safely(act) {
    return guarded(act, (message) => this.fail(message));
  }

  complain(message) {
    this.failed = Boolean(message);
    Object.assign(this.part("[role=alert]"), { hidden: !message, textContent: message });
    this.refresh();
  }

  fail(message = STOPPED) {
    this.abandon();
    this.complain(message);
  }

  abandon() {
    this.engine?.stop();
    this.stopSecond();
    const { world, length } = this.life; // of the axes
    Object.assign(this, { engine: null, life: newLife({ world, length }), following: null });
  }

  stop() {
    this.inSight = false;
    cancelAnimationFrame(this.scheduled);
    this.engine?.stop();
    this.stopSecond();
    for (const undo of this.undo) undo();
    this.root.remove();
  }
}

/** A message on the first invalid trait, or "". */
function problemOf(presets, modalities, model) {
  const preset = Object.hasOwn(presets, model.get("preset")) ? presets[model.get("preset")] : null;
  if (!preset) return `There is no agent “${model.get("preset")}”. Choose one from the menu.`;
  const [isNumber, isPlace, { nodes }] = [Number.isFinite, isWhole(0, MOST_SEED), preset];
  const allowed = {
    resolutions: (value) => isList(value, isWhole(1, 90)), valence_red: isNumber, learning_rate: isNumber,
    modality: (value) => nodes.length > 1 || value === "" || Object.hasOwn(modalities, value), discount: isNumber,
    memory: (value) => value === 0 || (value > 0 && preset.can_remember),
    object_state: (value) => preset.states.includes(value),
    exploration: (value) => value >= 0 && value <= 1,
    gains: (value) => isList(value, isNumber) && value.length === nodes.length, seed: isPlace,
    n_creeps: (value) => (preset.n_creeps === null ? value === null : isWhole(1, 20)(value)),
    recursion: (value) => preset.recursion === null || isNumber(value), speed: (value) => value >= 0, run: isPlace };
  const wrong = Object.keys(allowed).find((name) => !allowed[name](model.get(name)));
  return wrong ? `The Explorer cannot run with ${wrong} = ${JSON.stringify(model.get(wrong))}.` : "";
}
