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

class Starters extends Hands {
  /** A new run with the settings of the preset and nothing of what was tried before: with an action that is due later,
   * another agent beside it, and elements, if any. */
  fresh(values = {}, due = null, { beside = null, elements = [] } = {}) {
    const key = this.model.get("preset");
    this.dropElements();
    Object.assign(this, { due, beside, elements });
    if (!beside) this.stopSecond();
    for (const name of ["field", "heat", "trail"]) this.control(name).checked = this.control(name).defaultChecked;
    const settings = { ...initialSettings(this.presets, key), seed: this.presets[key].seed, run: 0, speed: this.pace };
    this.write({ ...settings, ...values });
    for (const name of ["run", "elements"]) this.note(name);
  }

  /** What is due at the beginning of a run of an agent to which little happens at first, or null. */
  beginningOf(preset) {
    if (this.only) return null; // all of the run is at full speed
    const { begins, world: { fps } } = this.presets[preset] ?? { world: {} };
    const minutes = Math.round(begins / fps / 60);
    const [before, after] = ["begin at full speed, since networks learn slowly", "were at full speed"].map((each) =>
      `The first ${minutes} minutes ${each}.`);
    const act = () => {
      this.life.news = after;
      this.refresh();
    };
    return begins ? { step: begins, hurries: true, act, news: before } : null;
  }

  watch() {
    this.fresh({ speed: 50, playing: true });
  }

  /** Let the agent learn, make red creeps desirable, and stop its learning, if it can stop. Red creeps are counted. */
  revalueRed() {
    const preset = this.presets[this.model.get("preset")];
    const minute = 60 * preset.world.fps;
    const at = Math.min(Math.floor(preset.steps / 2), TURN * minute);
    const from = Math.max(0, at - MINUTES_BEFORE * minute);
    const news = `First it learns for ${shown(at / minute)} minutes, and keeps away from red creeps.`;
    const begin = () => {
      Object.assign(this.life, { turn: { from, at, minute, caught: [this.caught("red")], recent: [] },
        due: { step: at, hurries: true, act: turn, news } });
    };
    const turn = () => {
      this.life.turn.caught.push(this.caught("red"));
      this.life.due = { step: at + minute, hurries: false, act: () => this.life.turn.caught.push(this.caught("red")) };
      this.write({ valence_red: 1, speed: WATCHED, ...canStopLearning(preset) ? { learning_rate: 0 } : {} });
    };
    this.fresh({ speed: WATCHED, playing: true }, { step: from, hurries: true, act: begin, news });
  }

  /** The creeps of a kind that were caught in the run. */
  caught(kind) {
    return this.life.frame.hits.find((each) => each.kind === kind).counts.reduce((sum, count) => sum + count, 0);
  }

  /** The red creeps caught in a minute before the turn, in the first one after it, and in the last that was drawn. */
  turnText() {
    const { turn, frame } = this.life;
    if (!turn || turn.caught.length < 2) return "";
    const { from, at, minute, caught: [start, middle, end], recent } = turn;
    const now = { step: frame.step, count: this.caught("red") };
    if (now.step !== recent.at(-1)?.step) recent.push(now);
    while (recent[1]?.step <= now.step - minute) recent.shift();
    const rate = ({ step, count }) => ((now.count - count) / (now.step - step) * minute).toFixed(0);
    const before = shown(((middle - start) / (at - from) * minute).toFixed(1));
    const first = end === undefined ? "…" : end - middle;
    return `Red a minute: ${before}, then ${first}, now ${now.step - recent[0].step < minute ? "…" : rate(recent[0])}`;
  }

  /** What becomes of red creeps while they are desirable. */
  turnSentences() {
    const { model, presets, life: { turn } } = this;
    if (!(turn?.caught.length > 1) || model.get("valence_red") <= 0) return [];
    if (!canStopLearning(presets[model.get("preset")])) return [WANTED];
    return [WANTED, model.get("learning_rate") ? LEARNS : STAYS];
  }

  /** Once enough has been learned, show the way to a corner, in a map of places or else in the first map. */
  async showCorner() {
    const { life, life: { frame } } = this;
    const act = async () => {
      life.due = null; // an action of another starter
      this.write({ playing: false });
      await this.look({ map: this.mapOfPlaces(), goal: null });
      await this.look({ at: CORNER });
      if (this.life.frame.seen.goal === null) this.life.news = "This map does not reach as far as the corner.";
      this.refresh();
    };
    if (frame.step >= Math.min(LEARNED, life.length.steps)) return act();
    life.due = { step: Math.min(LEARNED, life.length.steps), hurries: true, act, news: "Learning for a moment …" };
    return this.write({ playing: true });
  }

  mapOfPlaces() {
    const { names, nodes } = this.parameters();
    const { position } = this.model.get("_layout").plane.enumerations.Vector;
    const name = names[Math.max(0, nodes.findIndex(({ follows }) => follows === position))];
    const resolutions = this.model.get("resolutions");
    const near = resolutions.toSorted((a, b) => Math.abs(a - FINE_ENOUGH) - Math.abs(b - FINE_ENOUGH))[0];
    return `${name} N${near}`;
  }

  /** Perform the action that is due, once the run has reached its step. */
  async meet() {
    const { life, life: { frame, due } } = this;
    if (!due || frame.step < due.step) return;
    life.due = null;
    await due.act();
  }

  offerStarters() {
    const { life: { frame, game }, model, presets } = this;
    const preset = presets[model.get("preset")];
    const offers = preset ? offersOf(preset) : {};
    const ready = { watch: true, red: true, corner: frame, game: frame && !frame.ended };
    for (const [name, isReady] of Object.entries(ready)) this.action(name).disabled = !isReady || !offers[name];
    this.action("game").textContent = game ? "Leave the game" : "Play against it";
    this.action("game").ariaPressed = Boolean(game);
  }
}
