/* The run in the tank, and the engine that computes it.

All that the page holds of a run is in one object, which the next run replaces as a whole. A frame contains everything
that is drawn, so runs cannot mix; requests for a run that has been replaced are not answered. */

/** Everything the page holds of one run; every run has its own, and they share nothing. */
const newRun = (given = {}) => ({ frame: null, world: { fps: 1 }, length: { steps: 1, bin: 1 }, changed: false,
  advancing: false, owed: 0, counted: 0, rate: 0, cursor: null, game: null, held: null, slid: false, dragged: null,
  tapped: null, pointer: null, second: null, changes: [], due: null, news: "", turn: null, ...given });

class Tank {
  run = newRun();
  engine = null;
  due = null; // what is due in the next run: {step, hurries (at full speed), act, news, of (the button that began it, if
  // that stops it, too), until (the last step of all that it begins; by default `step`)}

  /** taken: called with each frame; fail: with what the engine says when it fails. */
  constructor(model, { taken, fail }) {
    Object.assign(this, { model, taken, fail });
  }

  /** Replace the run by one that has not begun. */
  replace(given) {
    this.run = newRun({ ...given, due: this.due });
    this.due = null;
  }

  start() {
    this.engine ??= startEngine(this.model, this.fail);
  }

  stop() {
    this.engine?.stop();
    this.engine = null;
  }

  /** An engine's answer; if the run has been replaced since the request, the promise never resolves. */
  ask(message, engine = this.engine) {
    const { run } = this;
    return new Promise((resolve) => engine.ask(message).then((answer) => run === this.run && resolve(answer)));
  }

  take(frame) {
    Object.assign(this.run, { frame });
    this.taken(frame);
  }

  /** Perform the action that is due, once the run has reached its step. */
  async meet() {
    const { run, run: { frame, due } } = this;
    if (!due || frame.step < due.step) return;
    run.due = null;
    await due.act();
  }
}
