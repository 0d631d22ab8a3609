/* The Explorer in the page: a learner that runs while the reader watches, with all its controls.

- The traits are the source of truth: a control writes its trait, and the page reacts to the trait, whether the change
  comes from a control, from Python or from a linked widget. Simultaneous changes are handled together.
- A new body, map or tank starts a new run; a new desire or way of learning continues with what was learned.
- A control that stands by itself draws whole runs, at full speed, and the last one with another setting beside it.
- The simulation runs in a worker, which answers every request once and in order. It advances only on request, with one
  such request at a time: a widget that is out of view makes none.
- Every failure ends the run with a message. The next change of a control tries again; Reset does so with the settings
  of the preset.

The Explorer gives its parts to each other, reacts to traits, and lets the run advance. */

class Explorer {
  undo = []; // what ends all that listens
  told = 0; // when the run was last described to screen readers, in milliseconds

  /** places: those of the model's views, of which the Explorer stands in the last one. */
  constructor(model, places) {
    const [refresh, wake, look] = [() => this.refresh(), () => this.wake(), (choice) => this.look(choice)];
    const [fail, abandon, running] = [(message) => this.fail(message), () => this.abandon(), () => this.running()];
    const safely = (act) => this.safely(act);
    const panel = new Panel();
    const traits = new Traits(model, () => this.react());
    const tank = new Tank(model, { taken: (frame) => this.taken(frame), fail });
    const hands = new Hands({ panel, traits, tank, look, refresh, wake, togglePlay: () => this.togglePlay() });
    const second = new Second({ panel, traits, tank, hands, refresh, wake, fail });
    const controls = new Controls({ panel, traits });
    const showing = new Showing({ panel, traits, tank, hands, second, running });
    const starters = new Starters({ panel, traits, tank, hands, second, controls, showing, look, refresh, abandon });
    const address = new Address({ panel, traits, tank, hands, second, starters, places, look, refresh, running });
    const tour = new Tour({ panel, traits, tank, hands, starters, address, look });
    const saving = new Saving({ panel, traits, tank, hands, address, refresh, wake, safely });
    Object.assign(this, { panel, traits, tank, hands, second, controls, showing, starters, address, tour, saving });
    this.open(places.at(-1));
  }

  /** Begin in a place of the page. */
  open(place) {
    const { panel, panel: { root }, traits, tank } = this;
    panel.fillMenus(traits.presets, traits.modalities);
    place.append(root);
    this.choosePart();
    tank.due = this.starters.beginningOf(traits.first);
    this.listen();
    if (isCalm()) traits.write({ playing: false });
    this.address.arrive();
    this.refresh();
    const { top, height } = root.getBoundingClientRect();
    this.approach({ isIntersecting: height > 0 && top < innerHeight }); // before the page is first painted, not after
  }

  /** Begin with one control beside the tank, or, on a page about the Explorer, with all and the page's first agent. */
  choosePart() {
    const { traits, traits: { presets } } = this;
    const whole = this.panel.root.closest(".neorl-whole");
    const first = whole && orderedKeys(presets).find((key) => presets[key].is_condition);
    if (first) traits.write(initialSettings(presets, traits.first = first));
    else if (!whole && traits.get("control")) this.controls.putFirst(traits.get("control"));
  }

  listen() {
    const { panel, panel: { root }, traits, tank, hands, address } = this;
    const on = (target, types, act) => types.split(" ").forEach((type) => {
      const safe = this.safely(act);
      target.addEventListener(type, safe);
      this.undo.push(() => target.removeEventListener(type, safe));
    });
    const watch = (observer) => {
      observer.observe(root);
      this.undo.push(() => observer.disconnect());
    };
    on(root, "input change", (event) => this.turned(event));
    on(root, "click", ({ target, detail }) => this.clicked(target.closest("button")?.dataset ?? {}, detail));
    on(root, "keydown", (event) => this.pressed(event));
    on(root, "focusin", ({ target }) => target.matches(".interest") && hands.select(indexOf(target)));
    const arena = panel.part(".arena");
    for (const part of [arena, panel.part(".pad")]) {
      on(part, "pointerdown", (event) => hands.grasp(event));
      on(part, "pointerup pointercancel keyup focusout", () => tank.run.game && (tank.run.game.held = NO_ACTION));
    }
    on(arena, "pointermove", (event) => hands.pull(event));
    on(arena, "lostpointercapture", () => { tank.run.held = null; });
    on(arena, "pointerleave", () => { tank.run.pointer = null; });
    on(arena, "click", (event) => hands.tap(event));
    on(window, "hashchange", ({ newURL }) => address.isOwn() && address.visit(new URL(newURL).hash));
    on(document, "click", (event) => address.followLink(event));
    on(document, "visibilitychange", () => this.refresh());
    on(window, "beforeprint afterprint", ({ type }) => this.showing.print(type === "beforeprint"));
    this.undo.push(watchLook([...root.querySelectorAll("canvas")], () => this.wake()));
    watch(new IntersectionObserver((entries) => this.approach(entries.at(-1)), { rootMargin: "200px" }));
    watch(new IntersectionObserver((entries) => this.sight(entries.at(-1))));
    for (const name of [...NEW_RUN, ...GOES_ON, "speed", "playing"]) {
      const note = () => traits.note(name);
      traits.model.on(`change:${name}`, note);
      this.undo.push(() => traits.model.off(`change:${name}`, note));
    }
  }

  approach({ isIntersecting }) {
    if (!isIntersecting || this.near) return;
    this.near = true;
    this.traits.note("near");
    this.address.arrive();
  }

  sight({ isIntersecting }) {
    this.inSight = isIntersecting;
    this.refresh();
  }

  // What the reader does

  turned({ type, target }) {
    const { controls, starters, second, hands } = this;
    const { name, type: kind, value } = target;
    if (type !== (["text", "number"].includes(kind) ? "change" : "input")) return null;
    this.address.touched = true;
    if (kind === "number" && !controls.accepts(target)) return null;
    const lookAgain = () => this.look(this.panel.layers());
    const act = { preset: () => starters.choose(value), "open-run": () => null,
      map: () => this.look({ map: value, goal: null }), field: lookAgain, heat: lookAgain, trail: () => this.wake(),
      beside: () => second.choose(), learned: () => second.choose(),
      "element-valence": () => hands.changeElement(hands.selected, { valence: Number(value) }) }[name];
    controls.drawWhole(name);
    return act ? act() : controls.turned(target);
  }

  clicked({ action, chip: resolution, pick: preset }, detail) {
    const { controls, hands, second, starters, tour, saving } = this;
    if (resolution) return controls.toggleResolution(Number(resolution));
    if (preset) return controls.drawWhole(this.panel.only), starters.choose(preset);
    const acts = { play: () => this.togglePlay(), step: () => this.step(), "go-on": () => this.goOn(),
      reset: () => starters.reset(), "new-run": () => starters.next(), open: () => starters.open(),
      watch: () => starters.watch(), red: () => starters.revalueRed(), corner: () => starters.showCorner(),
      compare: () => starters.compare(), game: () => (this.tank.run.game ? hands.leaveGame() : starters.play()),
      drop: () => hands.beginDrop(detail === 0), delete: () => hands.deleteElement(),
      clear: () => hands.clearElements(),
      link: () => saving.copyLink(), picture: () => saving.savePicture(), csv: () => saving.saveRun(),
      more: () => this.panel.unfold(), alone: () => saving.showAlone(), tour: () => tour.start(),
      next: () => tour.next(), end: () => tour.end() };
    this.address.touched ||= action in acts;
    if (TO_WATCH.includes(action)) this.panel.showTank();
    return action in LABELS && starters.stops(action) ? starters.stop() : acts[action]?.();
  }

  pressed(event) {
    if (event.key === "Escape" && event.target.closest(".tour")) return this.tour.end();
    return this.hands.pressed(event);
  }

  togglePlay() {
    const { traits, tank: { run: { frame } } } = this;
    if (frame?.ended) traits.note("run"); // the same run, with the present settings
    traits.write({ playing: frame?.ended || !traits.get("playing") });
  }

  step() {
    this.traits.write({ playing: false });
    return this.tank.run.advancing ? null : this.advance(1, TIMED_BUDGET);
  }

  /** Let a run that is over go on for as long again. */
  async goOn() {
    const { tank, tank: { run: { length } } } = this;
    Object.assign(length, { steps: 2 * length.steps, bin: 2 * length.bin });
    tank.take(await tank.ask({ type: "extend" }));
    await this.second.extend();
    this.refresh();
  }

  // Reactions to traits

  react() {
    if (this.following) return;
    const turn = this.following = {};
    queueMicrotask(this.safely(() => this.follow(turn)));
  }

  async follow(turn) {
    const { panel, traits, traits: { noted }, controls } = this;
    while (turn === this.following && noted.size) {
      panel.control("preset").value = traits.get("preset");
      if (noted.has("preset") && traits.preset && !OF_PRESET.some((name) => noted.has(name))) {
        traits.write(initialSettings(traits.presets, traits.get("preset"))); // as if chosen from the menu
      }
      if (noted.has("preset") && !noted.has("elements")) this.hands.dropElements();
      const problem = traits.problem();
      this.complain(problem);
      if (problem || !this.near) break;
      const names = [...noted];
      noted.clear();
      if (names.some((name) => name !== "near")) panel.forgive();
      traits.findCondition();
      controls.offerRuns();
      controls.show();
      const begins = (name) => NEW_RUN.includes(name) || name === panel.only;
      if (!this.tank.engine || names.some(begins)) await this.begin();
      else if (names.some((name) => name === "elements" || GOES_ON.includes(name))) await this.change();
      this.refresh();
    }
    if (turn === this.following) this.following = null;
  }

  async begin() {
    const { panel, traits, traits: { preset }, tank, hands, showing } = this;
    const [{ steps, band }, world] = [preset, traits.world()];
    const bin = band?.steps_per_bin ?? Math.ceil(steps / 50);
    const changes = traits.condition === traits.get("preset") ? preset.changes : [];
    showing.keep();
    const times = 2 ** Math.max(0, Math.ceil(Math.log2((tank.due?.step ?? 0) / steps))); // as if it had gone on
    const length = { steps: times * steps, bin: times * bin };
    tank.replace({ world, length, changes, changed: hands.elements.length > 0, name: showing.name() });
    this.refresh();
    tank.start();
    const begun = tank.ask({ type: "begin", parameters: traits.parameters(hands.elements), world, changes,
      seed: traits.get("seed"), run: traits.get("run"), steps: length.steps, bin_steps: length.bin,
      map: panel.control("map").value, ...panel.layers() });
    await this.second.begin();
    tank.take(await begun);
    await tank.meet();
  }

  async change() {
    const { tank, tank: { run }, hands: { elements }, second } = this;
    run.changed ||= run.frame.step > 0 || elements.length > 0;
    const changed = tank.ask({ type: "change", parameters: this.traits.parameters(elements) });
    await second.change();
    tank.take(await changed);
    if (run.frame.ended) await this.goOn(); // or the change would show nothing
  }

  /** Show another map, goal or place, with or without the field. Has no effect while a run loads. */
  async look(choice) {
    const { tank } = this;
    if (!tank.run.frame) return;
    tank.take(await tank.ask({ type: "look", ...choice }));
    await this.second.look();
    this.address.write();
  }

  // The run

  running() {
    const { panel, traits, tank: { run: { frame } } } = this;
    const canAdvance = frame && !frame.ended && !panel.failed;
    return Boolean(canAdvance && traits.get("playing") && this.inSight && !document.hidden);
  }

  async advance(steps, budget) {
    const { tank, tank: { run } } = this;
    run.advancing = true;
    const until = run.due ? Math.max(0, run.due.step - run.frame.step) : steps;
    const frame = await tank.ask({ type: "advance", steps: Math.min(steps, until), budget });
    await this.second.keepStep(frame);
    if (run !== tank.run) return; // replaced while the second tank was asked
    run.advancing = false;
    tank.take(frame);
    this.count(frame.steps);
    await tank.meet();
    if (this.running() && this.speed() === 0) this.safely(() => this.advance(STEPS_WITHOUT_END, this.budget()))();
  }

  speed() {
    const { game, due, frame } = this.tank.run;
    if (due?.hurries) return 0;
    return game ? 1 : frame && this.hands.isReaching() ? SLOW : this.traits.get("speed");
  }

  /** The milliseconds of a request at full speed: a whole run asks for few frames, each of which costs many steps. */
  budget() {
    return this.panel.only ? WHOLE_BUDGET : FREE_BUDGET;
  }

  taken(frame) {
    this.showing.showMaps(frame);
    const { step, reward: score, seen: { name: map, goal } } = frame;
    Object.assign(this.panel.root.dataset, { step, score, map, goal: goal ?? "" });
    if (frame.ended && this.tank.run.game) this.safely(() => this.hands.leaveGame())();
    if (frame.ended) this.refresh();
    this.wake();
  }

  count(steps) {
    const { run } = this.tank;
    run.counted += steps;
    const now = performance.now();
    if (!this.running() || now - run.since < 1000) return;
    Object.assign(run, { rate: Math.round((1000 * run.counted) / (now - run.since)), counted: 0, since: now });
    this.report();
  }

  /** Report the score to Python, and at intervals to screen readers. */
  report() {
    const { frame, world, rate } = this.tank.run;
    this.panel.root.dataset.rate = rate;
    this.traits.report({ seconds: frame.step / world.fps, score: frame.reward });
    if (this.running() && performance.now() - this.told < 5000) return;
    this.told = performance.now();
    this.showing.tell();
  }

  refresh() {
    const { tank: { run } } = this;
    const [running, before] = [this.running(), this.panel.root.dataset.state];
    this.showing.showState();
    if (running && before !== "running") Object.assign(run, { since: performance.now(), counted: 0 });
    if (!running && before === "running" && run.frame) run.rate = 0, this.report();
    this.starters.offer();
    this.second.show();
    this.controls.showSpeed(this.speed());
    this.address.write();
    this.wake();
  }

  wake() {
    this.showing.stale = true;
    this.schedule();
  }

  schedule() {
    this.scheduled ??= requestAnimationFrame(this.safely((now) => this.tick(now)));
  }

  tick(now) {
    const { showing, hands, tank: { run } } = this;
    this.scheduled = null;
    const elapsed = Math.min(now - (this.ticked ?? now), 100) / 1000;
    this.ticked = now;
    if (run.dragged) this.safely(() => hands.sendDragged())();
    if (this.running()) {
      const [free, most] = [this.speed() === 0, this.speed() * run.world.fps];
      run.owed = Math.min(run.owed + elapsed * most, Math.max(1, most / 10));
      const steps = free ? STEPS_WITHOUT_END : Math.floor(run.owed);
      if (!run.advancing && steps > 0) {
        if (run.game) hands.steer(now);
        run.owed -= free ? 0 : steps;
        this.safely(() => this.advance(steps, free ? this.budget() : TIMED_BUDGET))();
      }
      this.schedule();
    }
    if (showing.stale && (!isCalm() || !this.running() || now - showing.drawn >= 500)) showing.draw(now);
  }

  // Failures, and the end

  safely(act) {
    return guarded(act, (message) => this.fail(message));
  }

  complain(message) {
    this.panel.complain(message);
    this.refresh();
  }

  fail(message = STOPPED) {
    this.abandon();
    this.complain(message);
  }

  abandon() {
    const { tank, tank: { run: { world, length } } } = this; // of the axes
    tank.stop();
    this.second.stop();
    tank.run = newRun({ world, length });
    this.following = null;
  }

  stop() {
    Object.assign(this, { inSight: false, following: null });
    cancelAnimationFrame(this.scheduled);
    this.tank.stop();
    this.second.stop();
    for (const undo of this.undo) undo();
    this.panel.root.remove();
  }
}
