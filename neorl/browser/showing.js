/* What the Explorer shows of a run: its tank and curves, and what it says of them, in words. */

class Showing {
  before = null; // the reward of the run before, where a control stands by itself, as a line of the curves
  stale = false; // whether there is anything new to draw
  drawn = 0; // when that was last done, in milliseconds

  /** parts: {panel, traits, tank, hands, second}, and running(), whether the run advances. */
  constructor(parts) {
    Object.assign(this, parts);
  }

  /** What a run is called whose only control stands beside the tank: by its setting. */
  name() {
    const { panel: { only }, traits } = this;
    return only && settingInWords(only, traits.settings(), traits.presets);
  }

  /** Keep the reward of a run that is over, to be drawn beside the next one, which has another setting. */
  keep() {
    const { frame, name, length, world: { fps } } = this.tank.run;
    if (!this.panel.only || !frame?.ended || name === this.name()) return;
    const span = { seconds: length.steps / fps, binSeconds: length.bin / fps, elapsed: frame.step / fps };
    this.before = { name, span, totals: frame.rewards, colour: "place", isPale: true };
  }

  /** Show what may be done with the run in its present state. */
  showState() {
    const { panel, traits, hands, tank: { run, run: { frame, game } } } = this;
    const idle = panel.failed ? "failed" : !frame ? "loading" : frame.ended ? "ended" : "paused";
    const state = this.running() ? "running" : idle;
    Object.assign(panel.root.dataset, { state, condition: traits.condition ?? "" });
    panel.action("play").textContent = frame?.ended ? "Play again" : traits.get("playing") ? "Pause" : "Play";
    panel.action("drop").disabled = !frame || hands.elements.length >= MOST_ELEMENTS;
    panel.action("drop").ariaPressed = Boolean(hands.dropping);
    Object.assign(panel.action("step"), { disabled: !frame, hidden: frame?.ended });
    panel.action("go-on").hidden = !frame?.ended;
    for (const name of ["link", "picture", "csv"]) panel.action(name).disabled = !frame;
    panel.action("link").hidden = isInApplication();
    panel.action("alone").hidden = !document.fullscreenEnabled;
    for (const name of ["map", "field", "heat"]) panel.control(name).disabled = !frame;
    panel.control("speed").disabled = Boolean(game);
    panel.part(".pad").hidden = !game;
    panel.part(".element").hidden = hands.selected === null;
    const { preset } = traits;
    panel.offer("learns", preset && canStopLearning(preset) && (!panel.only || run.turn));
    this.showLegend();
  }

  showLegend() {
    const { before, second, tank: { run: { name, changed } } } = this;
    const [{ label, runs }, behind] = [this.traits.shown, this.behind()];
    const swatch = (kind) => element("span", { className: `swatch ${kind}` });
    const own = `${name ? `${name}: ` : ""}this run${changed ? ", changed on the way" : ""}`;
    this.panel.part(".legend").replaceChildren(swatch("own"), own,
      ...(before ? [swatch("before"), `${before.name}: the one before`] : []),
      ...(second.beside ? [swatch("beside"), second.names()[1]] : []),
      ...(behind ? [swatch("band"), behind.words
        ?? `where ${behind.has_all ? "all" : "most"} of ${counted(runs, "run")} of ${label} lie`] : []));
  }

  /** Update the menu of maps, which change with the agent, in some conditions during a run. */
  showMaps({ maps, shapes, seen }) {
    const menu = this.panel.control("map");
    if (!isSame(maps, Array.from(menu.options, (option) => option.value))) {
      menu.replaceChildren(...maps.map((name, m) => new Option(inWords(name, shapes[m]), name)));
    }
    if (menu.value !== seen.name) menu.value = seen.name;
  }

  draw(now = performance.now()) {
    const { panel, traits, hands, second, tank: { run: { frame, cursor, world, rate } } } = this;
    const [isLoading, colours] = [!frame && !panel.failed, readColours(panel.root)];
    if (!panel.arena.clientWidth) return;
    this.drawCurve(colours); // whose recorded part is there at once
    this.showWay();
    if (isLoading && this.drawn) return; // keep the last picture while loading
    Object.assign(this, { drawn: now, stale: false });
    second.draw(colours);
    drawArena(panel.arena, colours, frame, { cursor, trail: panel.control("trail").checked });
    this.arrange(Boolean(frame?.arm));
    if (frame?.arm) drawLimb(panel.limb, colours, frame);
    this.drawCatches(colours);
    hands.placeHandles();
    this.showKey();
    if (frame && !this.running()) panel.part(".unseen").textContent = describe(frame);
    panel.part(".minutes").textContent = second.beside ? this.minutes() : this.progress(); // the tanks have titles
    panel.part(".pace").textContent = this.running() && rate
      ? `${grouped(rate)} steps per second, ${grouped(rate / world.fps)} × real time` : "";
    const able = [frame?.seen.axes.length, true, traits.hasCreeps()]; // the cells of contacts are not goals
    panel.part(".said").textContent = this.sentences().join(" ") || HINTS.filter((_, hint) => able[hint]).join(" ");
  }

  /** Draw in the colours of paper; a run that has not begun has nothing to print. */
  print(isOnPaper) {
    this.panel.root.classList.toggle("on-paper", isOnPaper && Boolean(this.tank.run.frame));
    this.draw(); // at once, since the page is printed as soon as this returns
  }

  /** The length of the run and its bins, and how much of it there is, in seconds. */
  span() {
    const { frame, length, world: { fps } } = this.tank.run;
    return { seconds: length.steps / fps, binSeconds: length.bin / fps, elapsed: (frame?.step ?? 0) / fps };
  }

  frames() {
    const { frame, second } = this.tank.run;
    return [frame, second?.frame].filter(Boolean);
  }

  /** What other runs of these settings have earned, to be drawn behind: of the record, or else of the page. */
  behind() {
    const { behind, band } = this.traits.shown;
    return behind ?? band;
  }

  /** Draw what the run has earned, and that of the second tank, over those before and behind. */
  drawCurve(colours) {
    const earned = this.frames().map(({ rewards }, tank) => ({ totals: rewards, colour: ["agent", "place"][tank] }));
    const all = [this.before, ...earned.reverse()].filter(Boolean);
    drawCurves(this.panel.curve, colours, this.span(), all, this.behind());
  }

  /** Draw and write what the run has met, and that of the second tank. */
  drawCatches(colours) {
    const { panel, traits, hands, second: other, tank: { run, run: { frame, second } } } = this;
    const [frames, span] = [this.frames(), this.span()];
    drawCurves(panel.catches, colours, span, frames.flatMap(({ hits }, tank) => hits.map(({ kind, counts }) =>
      ({ totals: counts, per: 60, colour: COLOUR_OF.get(kind) ?? "place", isDashed: tank > 0 }))));
    const inWords = ({ hits }) => hits.map(({ kind, counts }) =>
      `${kind} ${shown((ratesOf(counts, span, 60).rates.at(-1) ?? 0).toFixed(1))}`).join(", ");
    const met = frames.map((each, tank) => `${second ? `${other.names()[tank]} ` : ""}${inWords(each)}`);
    const turned = turnText(run); // counts of single minutes, beside which those of longer bins would confuse
    panel.part(".counts").textContent = turned;
    panel.part(".of-catches").textContent = turned ? "Caught a minute, by colour"
      : `${traits.hasCreeps() ? "Caught" : "Met"} a minute: ${met.join(" · ")}`;
    const wanted = new Set((frame?.wants ?? []).map(({ kind, valence }) => `${kind} ${signed(valence)}`));
    const dropped = hands.elements.map(({ valence }) => `element ${signed(valence)}`);
    panel.part(".wants").textContent = frame ? `Wants: ${[...wanted, ...dropped].join(", ")}` : "";
  }

  /** Show an arm large in its workspace, with joint space, where its cells are, beside it. */
  arrange(hasArm) {
    const { panel } = this;
    const [space, limb] = [panel.part(".space"), panel.part(".limb")];
    if (limb.hidden === !hasArm) return;
    const [main, inset] = hasArm ? [limb, space] : [space, limb];
    panel.part(".first").append(main);
    panel.part(".side").prepend(inset);
    limb.hidden = space.firstElementChild.hidden = !hasArm;
  }

  showKey() {
    const { frame } = this.tank.run;
    const entries = frame ? keyOf(frame) : [];
    if (isSame(entries, this.entries)) return;
    this.entries = entries;
    this.panel.part(".key").replaceChildren(...entries.map(entryOf));
  }

  /** The step to which a run is on its way at full speed, or 0. */
  destination() {
    const { panel, traits, tank: { run: { frame, due, length } } } = this;
    if (due?.hurries) return due.until ?? due.step;
    const goesOn = frame ? this.running() : traits.get("playing") && !panel.failed;
    return panel.only && goesOn && traits.get("speed") === 0 ? length.steps : 0;
  }

  showWay() {
    const [bar, step] = [this.panel.part("progress"), this.destination()];
    bar.classList.toggle("idle", !step);
    if (step) Object.assign(bar, { max: step, value: this.tank.run.frame?.step ?? 0 });
  }

  minutes() {
    const { frame, world } = this.tank.run;
    const inMinutes = (step) => step / world.fps / 60;
    const step = this.destination();
    const of = step ? ` of ${shown(inMinutes(step))}` : "";
    return frame ? `${inMinutes(frame.step).toFixed(1)}${of} simulated minutes` : "";
  }

  /** How far the run has come, and what it has earned. */
  progress() {
    const { frame, game } = this.tank.run;
    if (!frame) return "";
    if (game) return `You: ${shown(frame.player?.reward ?? 0)} · neoRL: ${shown(frame.reward - game.score)}`;
    return `${this.minutes()} · ${this.second.scores() || `score ${shown(frame.reward)}`}`;
  }

  sentences() {
    const { traits, hands, tank: { run, run: { frame, game, changed, due, news } } } = this;
    if (!frame) return [];
    if (hands.dropping) return [WHERE];
    const [said, number, score, { seen }] = [[], traits.get("run"), shown(frame.reward), frame];
    const { totals = [], seed, steps } = traits.shown;
    if (frame.ended) said.push(`Run ${number} is over: its score is ${score}.`);
    if (frame.ended && number < totals.length && seed === traits.get("seed") && steps === frame.step && !changed) {
      const same = Math.abs(totals[number] - frame.reward) < 1e-6 ? "the same" : "not the same";
      said.push(`The notebook computed ${shown(totals[number])} for this run: ${same}.`);
    }
    if (game) said.push(STEER);
    if (seen.goal !== null) said.push(describeWay(frame));
    if (due?.news ?? news) said.push(due?.news ?? news);
    else said.push(...turnSentences(run, traits));
    return said;
  }

  /** Describe the present frame to screen readers. */
  tell() {
    this.panel.part(".unseen").textContent = describe(this.tank.run.frame);
    this.panel.part(".told").textContent = [`${this.progress()}.`, ...this.sentences()].join(" ");
  }
}
