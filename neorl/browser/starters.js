/* Things to try with one click. Each sets the controls as a reader would; a later action is `due` at a step. */

const [LEARNED, CORNER, FINE_ENOUGH] = [60_000, { x: 0.04, y: 0.04 }, 7]; // steps, a place, a resolution
const [TURN, MINUTES_BEFORE, WATCHED] = [100, 10, 20]; // minutes before red is good; counted before; times real time
const WANTED = "Red creeps are desirable now: their valence is +1. They still pay −1.";
const STAYS = "Learning is off: all that the agent does, it knew before. Switch it on, and see how long that lasts.";
const LEARNS = "Learning is on. Without fear and without chance, an agent may come to shuttle on one line, between "
  + "cells each of which has the other as its best neighbour, and learning confirms it. Exploration only slows that.";
const OFFERED = { red: "Only an agent that avoids red creeps can come to desire them.",
  corner: "Only an agent with cells as goals knows the way to a corner.",
  game: "Only an agent among creeps can be played against." };

/** Which things to try a preset offers. */
function offersOf({ avoided, n_creeps, parameters: { nodes } }) {
  return { watch: true, red: avoided === "red", corner: !nodes.every((node) => node.learns_contacts),
    game: n_creeps !== null };
}

/** Whether an agent stops learning at a learning rate of 0, unlike one that learns contacts. */
const canStopLearning = ({ parameters: { nodes } }) => !nodes.some((node) => node.learns_contacts);

/** A message on a thing to try that a preset does not offer, or "". */
function problemOfStart(preset, start) {
  return Object.hasOwn(OFFERED, start) && !offersOf(preset)[start] ? OFFERED[start] : "";
}

/** The creeps of a kind that were caught in a run. */
function caughtIn({ frame }, kind) {
  return frame.hits.find((each) => each.kind === kind).counts.reduce((sum, count) => sum + count, 0);
}

/** The red creeps caught in a minute before the turn of a run, in the first one after it, and in the last one. */
function turnText(run) {
  const { turn, frame } = run;
  if (!turn || turn.caught.length < 2) return "";
  const { from, at, minute, caught: [start, middle, end], recent } = turn;
  const now = { step: frame.step, count: caughtIn(run, "red") };
  if (now.step !== recent.at(-1)?.step) recent.push(now);
  while (recent[1]?.step <= now.step - minute) recent.shift();
  const rate = ({ step, count }) => ((now.count - count) / (now.step - step) * minute).toFixed(0);
  const before = shown(((middle - start) / (at - from) * minute).toFixed(1));
  const first = end === undefined ? "…" : end - middle;
  return `Red a minute: ${before}, then ${first}, now ${now.step - recent[0].step < minute ? "…" : rate(recent[0])}`;
}

/** What becomes of red creeps while they are desirable. */
function turnSentences({ turn }, traits) {
  if (!(turn?.caught.length > 1) || traits.get("valence_red") <= 0) return [];
  if (!canStopLearning(traits.preset)) return [WANTED];
  return [WANTED, traits.get("learning_rate") ? LEARNS : STAYS];
}

class Starters {
  /** parts: {panel, traits, tank, hands, second, controls, showing}, and functions {look, refresh, abandon} of the
   * Explorer. */
  constructor(parts) {
    Object.assign(this, parts);
    this.pace = Math.max(0, this.traits.get("speed")); // of runs that begin, unless only whole ones are drawn
  }

  /** A new run with the settings of the preset and nothing of what was tried before: with an action that is due later,
   * another agent beside it, and elements, if any. */
  fresh(values = {}, due = null, { beside = null, elements = [] } = {}) {
    const { panel, traits, tank, hands, second } = this;
    const key = traits.get("preset");
    hands.dropElements();
    Object.assign(tank, { due });
    Object.assign(hands, { elements });
    Object.assign(second, { beside });
    if (!beside) second.stop();
    for (const name of ["field", "heat", "trail"]) panel.control(name).checked = panel.control(name).defaultChecked;
    const speed = panel.only ? 0 : this.pace;
    traits.write({ ...initialSettings(traits.presets, key), seed: traits.preset.seed, run: 0, speed, ...values });
    for (const name of ["run", "elements"]) traits.note(name);
  }

  /** Begin a run of an agent, also of the present one, since its run may have failed. */
  choose(preset) {
    const { traits, tank } = this;
    tank.due = this.beginningOf(preset);
    traits.write(initialSettings(traits.presets, preset));
    this.controls.show(); // at once, so that no slider of the previous agent is left
    traits.note("preset");
  }

  /** Restart with the preset's own settings: the present ones may be the cause of a failure. */
  reset() {
    const { traits } = this;
    if (!this.tank.run.frame) this.abandon();
    const preset = [traits.get("preset"), ...orderedKeys(traits.presets)].find((key) => traits.presetOf(key));
    traits.write({ preset });
    this.fresh();
  }

  /** The next run of these settings, with the same elements. */
  next() {
    this.traits.write({ run: (this.traits.get("run") + 1) % (MOST_SEED + 1) });
  }

  /** A run of the condition that is watched, by its number. */
  open() {
    const field = this.panel.control("open-run");
    if (!this.controls.accepts(field)) return;
    if (!this.tank.run.frame) this.abandon();
    this.traits.write({ preset: this.traits.condition });
    this.fresh({ run: field.valueAsNumber, speed: 0, playing: true });
  }

  /** What is due at the beginning of a run of an agent to which little happens at first, or null. */
  beginningOf(preset) {
    if (this.panel.only) return null; // all of the run is at full speed
    const { begins, world: { fps } } = this.traits.presetOf(preset) ?? { world: {} };
    const minutes = Math.round(begins / fps / 60);
    const [before, after] = ["begin at full speed, since networks learn slowly", "were at full speed"].map((each) =>
      `The first ${minutes} minutes ${each}.`);
    const act = () => {
      this.tank.run.news = after;
      this.refresh();
    };
    return begins ? { step: begins, hurries: true, act, news: before } : null;
  }

  watch() {
    this.fresh({ speed: 50, playing: true });
  }

  /** Let the agent learn, make red creeps desirable, and stop its learning, if it can stop. Red creeps are counted. */
  revalueRed() {
    const { tank, traits, traits: { preset } } = this;
    const minute = 60 * preset.world.fps;
    const at = Math.min(Math.floor(preset.steps / 2), TURN * minute);
    const from = Math.max(0, at - MINUTES_BEFORE * minute);
    const news = `First it learns for ${counted(shown(at / minute), "minute")}, and keeps away from red creeps.`;
    const begin = () => {
      const turning = { from, at, minute, caught: [caughtIn(tank.run, "red")], recent: [] };
      Object.assign(tank.run, { turn: turning,
        due: { step: at, hurries: true, act: turn, news, of: "red" } });
    };
    const turn = () => {
      const count = () => tank.run.turn.caught.push(caughtIn(tank.run, "red"));
      count();
      tank.run.due = { step: at + minute, hurries: false, act: count };
      traits.write({ valence_red: 1, speed: WATCHED, ...canStopLearning(preset) ? { learning_rate: 0 } : {} });
    };
    this.fresh({ speed: WATCHED, playing: true },
      { step: from, hurries: true, act: begin, news, of: "red", until: at });
  }

  /** Whether the button of a thing to try, which is on its way, stops it. */
  stops(name) {
    const { tank, tank: { run } } = this;
    return [tank.due, run.due].some((due) => due?.of === name);
  }

  /** Stop what is on its way, at the moment of the run. */
  stop() {
    const { tank, tank: { run }, traits } = this;
    tank.due = run.due = null;
    Object.assign(run, { turn: null, news: `Stopped after ${this.showing.minutes()}.` });
    traits.write({ playing: false });
    this.refresh();
  }

  /** Once enough has been learned, show the way to a corner, in a map of places or else in the first map. */
  async showCorner() {
    const { traits, tank: { run } } = this;
    const act = async () => {
      run.due = null; // an action of another starter
      traits.write({ playing: false });
      await this.look({ map: this.mapOfPlaces(), goal: null });
      await this.look({ at: CORNER });
      if (this.tank.run.frame.seen.goal === null) this.tank.run.news = "This map does not reach as far as the corner.";
      this.refresh();
    };
    const step = Math.min(LEARNED, run.length.steps);
    if (run.frame.step >= step) return act();
    run.due = { step, hurries: true, act, news: "Learning for a moment …", of: "corner" };
    return traits.write({ playing: true });
  }

  mapOfPlaces() {
    const { traits } = this;
    const { names, nodes } = traits.parameters();
    const { position } = traits.layout.enumerations.Vector;
    const name = names[Math.max(0, nodes.findIndex(({ follows }) => follows === position))];
    const resolutions = traits.get("resolutions");
    const near = resolutions.toSorted((a, b) => Math.abs(a - FINE_ENOUGH) - Math.abs(b - FINE_ENOUGH))[0];
    return `${name} N${near}`;
  }

  /** Two minutes of a newborn and a veteran, at a pace at which they can be told apart. */
  meetVeteran() {
    const { traits: { preset: { steps, world: { fps } } } } = this;
    const act = () => {
      const { second: { beside }, tank: { run, run: { frame, second } } } = this;
      if (!beside || !second) return;
      this.traits.write({ playing: false });
      const lead = second.frame.reward - frame.reward;
      const ahead = lead < 0 ? "newborn" : "veteran";
      run.news = `${this.showing.progress()}: the ${ahead} is ${shown(Math.abs(lead))} ahead.`;
    };
    const news = "Same agent, same seed, for two minutes.";
    this.fresh({ speed: 10, playing: true }, { step: Math.min(steps, 120 * fps), hurries: false, act, news },
      { beside: VETERAN });
  }

  compare() {
    return this.second.beside ? this.second.compare(null) : this.meetVeteran();
  }

  play() {
    this.second.compare(null); // there is one game at a time
    return this.hands.joinGame();
  }

  offer() {
    const { panel, traits: { preset }, tank: { run: { frame, game } } } = this;
    const offers = preset ? offersOf(preset) : {};
    const ready = { watch: true, red: true, corner: frame, game: frame && !frame.ended };
    for (const [name, isReady] of Object.entries(ready)) panel.action(name).disabled = !isReady || !offers[name];
    for (const [name, label] of Object.entries(LABELS)) {
      panel.action(name).textContent = this.stops(name) ? "Stop here" : label;
    }
    panel.action("game").textContent = game ? "Leave the game" : "Play against it";
    panel.action("game").ariaPressed = Boolean(game);
  }
}
