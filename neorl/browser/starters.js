/* Things to try with one click. Each sets the controls as a reader would; a later action is `due` at a step. */

const [LEARNED, CORNER, FINE_ENOUGH] = [60_000, { x: 0.04, y: 0.04 }, 7]; // steps, a place, a resolution
const EXPLORING = 0.05; // the least exploration that goes with a changed valence
const OFFERED = { red: "Only an agent that avoids red creeps can come to desire them.",
  corner: "Only an agent with cells as goals knows the way to a corner.",
  game: "Only an agent among creeps can be played against." };

/** Which things to try a preset offers. */
function offersOf({ avoided, n_creeps, parameters: { nodes } }) {
  return { watch: true, red: avoided === "red", corner: !nodes.every((node) => node.learns_contacts),
    game: n_creeps !== null };
}

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
      `The first ${minutes} minutes ${each}. “Watch it learn” shows them.`);
    const act = () => {
      this.life.news = after;
      this.refresh();
    };
    return begins ? { step: begins, hurries: true, act, news: before } : null;
  }

  watch() {
    this.fresh({ speed: 50, playing: true });
  }

  revalueRed() {
    const { steps } = this.presets[this.model.get("preset")];
    const half = Math.floor(steps / 2);
    const after = "Red is desirable now: its valence is +1, and the agent seeks it at once. It still pays −1. One "
      + "action in 20 is random: with nothing to avoid and no random moves, an agent can shuttle between two cells.";
    const act = () => {
      this.life.news = after;
      const exploration = Math.max(EXPLORING, this.model.get("exploration"));
      this.write({ valence_red: 1, exploration, speed: 50 });
    };
    const before = "In the middle of the run, red creeps become desirable.";
    this.fresh({ speed: 1000, playing: true }, { step: half, hurries: false, act, news: before });
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
