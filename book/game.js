/* The game below the star: twenty seconds of a reader beside an experienced agent, and half-way red becomes good.

- Both tanks begin alike, on a board that the page's address may name, with a score to beat:
  `#game_board-7_beat-12`. The agent has had its lesson, as in game.py, and learns no more.
- The reader steers with the arrow keys, or draws a finger or the mouse in the direction of a push.
- What both want changes at the same step, without a word: red discs then carry a plus. A score is what discs were worth
  when they were taken.
- It is part of the star's script, after `star.js`, whose data and helpers it uses. */

const GAME = /^#game_board-(\d{1,9})_beat-(-?\d{1,4})$/;
const COUNTDOWN = 3; // seconds
const PACE = 1; // times real time
const [THRUST, LEAST_DRAW] = [5, 10]; // steps from push to push of a held key; pixels of a draw
const PUSHES = { ArrowUp: "N", ArrowDown: "S", ArrowRight: "E", ArrowLeft: "W" };

class Game {
  constructor(root, data) {
    Object.assign(this, { root, data, round: null, board: 1, beat: null, hasLearned: false, engines: [] });
    [this.mine, this.its] = root.querySelectorAll("canvas");
    this.actions = data._layout.plane.enumerations.Action;
    this.listen();
    this.follow();
  }

  listen() {
    const { root } = this;
    const tanks = root.querySelector(".tanks");
    const on = (target, type, act) => target.addEventListener(type, this.safely(act));
    on(root.querySelector(".buttons"), "click", ({ target: { dataset: { action } } }) =>
      ({ begin: () => this.play(), share: () => this.copyLink() })[action]?.());
    root.addEventListener("keydown", (event) => this.turn(event, PUSHES[event.key]));
    root.addEventListener("keyup", (event) => PUSHES[event.key] === this.round?.held && this.hold(null));
    tanks.addEventListener("pointerdown", (event) => this.grasp(event, tanks));
    tanks.addEventListener("pointermove", (event) => this.pull(event));
    for (const type of ["pointerup", "pointercancel"]) tanks.addEventListener(type, () => this.release());
    on(window, "hashchange", () => this.follow());
    watchLook([this.mine, this.its], () => this.draw());
  }

  /** Take the board, and the score to beat, that the page's address names. */
  follow() {
    const [, board, beat] = GAME.exec(location.hash) ?? [];
    if (board === undefined || this.round) return;
    Object.assign(this, { board: Number(board), beat: Number(beat) });
    this.say(`Somebody has scored ${signedScore(this.beat)} on this board. Beat that.`);
    this.root.scrollIntoView({ block: "center" });
  }

  // What the reader does

  turn(event, push) {
    if (push === undefined || !this.round) return;
    event.preventDefault();
    if (!event.repeat) this.hold(push);
  }

  grasp(event, tanks) {
    if (!this.round) return;
    tanks.setPointerCapture(event.pointerId);
    this.round.grasped = { x: event.clientX, y: event.clientY };
  }

  /** Push where the finger has been drawn to, mostly across or mostly down; it need not go back to where it began. */
  pull({ clientX, clientY }) {
    const { grasped } = this.round ?? {};
    if (!grasped) return;
    const [across, down] = [clientX - grasped.x, clientY - grasped.y];
    if (Math.hypot(across, down) < LEAST_DRAW) return;
    this.hold(Math.abs(across) > Math.abs(down) ? (across > 0 ? "E" : "W") : (down > 0 ? "S" : "N"));
    this.round.grasped = { x: clientX - Math.sign(across) * LEAST_DRAW, y: clientY - Math.sign(down) * LEAST_DRAW };
  }

  release() {
    if (!this.round) return;
    this.round.grasped = null;
    this.hold(null);
  }

  hold(push) {
    const { round } = this;
    if (!round || round.held === push) return;
    Object.assign(round, { held: push, next: push ?? round.next });
  }

  async copyLink() {
    const { url } = this.result;
    await navigator.clipboard?.writeText(url).catch(() => null);
    this.say(`${this.result.said} The link: ${url}`);
  }

  // A round

  async play() {
    if (this.round) return;
    const { root, board, data: { steps, world: { fps } } } = this;
    const round = this.round = newRound(PACE * fps);
    root.querySelector("[data-action=share]").hidden = true;
    this.say("");
    if (!this.engines.length) {
      const model = { get: (name) => this.data[name] };
      this.engines = [0, 1].map(() => startEngine(model, (message) => this.fail(message)));
    }
    await this.teach();
    if (round !== this.round) return; // it has failed
    const { game: [first, second] } = this.data;
    const request = { type: "begin", world: this.data.world, seed: board, run: 0, steps, bin_steps: steps / 2, map: "",
      heat: 0, field: 0, parameters: first, changes: [{ step: steps / 2, parameters: second }] };
    const [its, mine] = this.engines;
    round.frames = await Promise.all([its.ask({ ...request, keeps: true }), mine.ask(request)]);
    this.show("ready");
    this.draw();
    this.mine.focus({ preventScroll: true });
    for (let seconds = COUNTDOWN; seconds > 0; seconds -= 1) {
      this.say(`${seconds} …`);
      await new Promise((resolve) => setTimeout(resolve, 1000));
    }
    if (round !== this.round) return;
    this.say("");
    this.show("running");
    this.wake();
  }

  /** Let the agent have its lesson, once. */
  async teach() {
    if (this.hasLearned) return;
    const { engines: [its], data: { world, lesson, lesson_seed: seed, parameters } } = this;
    this.show("learning");
    await its.ask({ type: "begin", world, seed, run: 0, steps: lesson, bin_steps: lesson, map: "", heat: 0, field: 0,
      parameters });
    for (let frame = {}; !frame.ended;) {
      frame = await its.ask({ type: "advance", steps: lesson, budget: 24 });
      this.say(`The agent has its lesson: minute ${Math.floor(minutesOf(frame.step, world))} of `
        + `${minutesOf(lesson, world)} …`);
    }
    this.hasLearned = true;
  }

  /** The actions of so many steps: a push at once, and then one from time to time for as long as it is held. */
  pushes(steps) {
    const { round, actions } = this;
    return Array.from({ length: steps }, () => {
      const push = round.next ?? (round.wait > 0 ? null : round.held);
      Object.assign(round, { next: null, wait: push === null ? round.wait - 1 : THRUST - 1 });
      return push === null ? actions.no_op : actions[push];
    });
  }

  async advance(steps) {
    const { round, engines: [its, mine] } = this;
    round.isBusy = true;
    round.frames = await Promise.all([its.ask({ type: "advance", steps, budget: Infinity }),
      mine.ask({ type: "steer", actions: this.pushes(steps) })]);
    round.isBusy = false;
    if (round.frames[0].ended) this.end();
    else this.wake();
    this.draw();
  }

  end() {
    const { root, round: { frames }, board, beat } = this;
    const [its, mine] = frames.map(halvesOf);
    const score = total(mine);
    const better = beat === null ? "" : score > beat ? ` You have beaten ${signedScore(beat)}.`
      : ` There were ${signedScore(beat)} to beat.`;
    const said = `You scored ${signedScore(score)}, ${signedScore(mine[1])} of it after red had become good; the agent `
      + `${signedScore(total(its))}, ${signedScore(its[1])} of it after that. It had kept away from red discs all its `
      + `life, and has learned nothing since.${better}`;
    const url = `${location.href.replace(/#.*/, "")}#game_board-${board}_beat-${score}`;
    Object.assign(this, { result: { said, url }, board: board + 1, beat: null, shown: frames, round: null });
    root.querySelector("[data-action=share]").hidden = false;
    root.querySelector("[data-action=begin]").textContent = "Once more";
    this.show("over");
    this.say(said);
    root.querySelector("[data-action=begin]").focus({ preventScroll: true });
  }

  // What is shown

  wake() {
    requestAnimationFrame(this.safely((now) => this.tick(now)));
  }

  tick(now) {
    const { round } = this;
    if (!round || round.isBusy) return null;
    round.owed += Math.min((now - (round.before ?? now)) / 1000, MOST_SECONDS) * round.fps;
    round.before = now;
    const steps = Math.floor(round.owed);
    round.owed -= steps;
    return steps ? this.advance(steps) : this.wake();
  }

  show(state) {
    this.root.dataset.state = state;
    this.root.querySelector("[data-action=begin]").disabled = !["idle", "over"].includes(state);
  }

  say(text) {
    this.root.querySelector(".said").textContent = text;
  }

  draw() {
    const { root, data: { steps } } = this;
    const frames = this.round?.frames ?? this.shown ?? [];
    if (!frames.length) return;
    const colours = readColours(root);
    const [its, mine] = frames.map(bare);
    drawArena(this.its, colours, its, { trail: true });
    drawArena(this.mine, { ...colours, agent: colours.place }, mine, { trail: true });
    const [first, second] = root.querySelectorAll("output");
    [first.textContent, second.textContent] = [mine, its].map((frame) => signedScore(total(halvesOf(frame))));
    root.querySelector("progress").value = its.step / steps;
    Object.assign(root.dataset, { step: its.step, redIsGood: its.step > steps / 2,
      at: [mine.agent.x, mine.agent.y].join(" ") });
  }

  safely(act) {
    return guarded(act, (message) => this.fail(message));
  }

  fail(message = STOPPED) {
    for (const engine of this.engines) engine.stop();
    Object.assign(this, { engines: [], round: null, hasLearned: false });
    this.show("failed");
    Object.assign(this.root.querySelector("[role=alert]"), { hidden: false, textContent: message });
  }
}

/** held, next: the push that is held, and one to give in any case; wait: steps until that is repeated. */
const newRound = (fps) => ({ fps, held: null, next: null, wait: 0, grasped: null, owed: 0, before: null, frames: [],
  isBusy: false });

/** What a tank has brought before and after red became good. */
const halvesOf = ({ hits }) => [-1, 1].map((worth, half) => hits[GREEN].counts[half] + worth * hits[RED].counts[half]);

const total = ([first, second]) => first + second;

const signedScore = (score) => String(score).replace("-", "−");

new Game(document.querySelector(".neorl-game"), data);
