/* A guided tour of a few stops. Each points at a part of the page and operates the controls as a reader would; it starts
only when asked to, and at its end the reader is back at the moment from which it started. */

const STOPS = [
  { at: ".space", act: (tour) => tour.beginRun(),
    text: "The blue disc is the agent. Green creeps pay +1, red ones −1. The shaded cell is where it is, on one of its "
      + "maps. It has learned nothing yet." },
  { at: `[data-action="play"]`, act: ({ traits }) => traits.write({ speed: 5, playing: true }),
    text: "It knows nothing yet, so chance decides. From every move it learns something about the ways to all cells, "
      + "whatever it wants." },
  { at: ".space", act: (tour) => tour.runAhead(),
    text: `${grouped(LEARNED)} steps later it has learned from green creeps and red ones. Dashed arrows are its desires: `
      + "where each kind of cell would take it now." },
  { at: `[name="heat"]`, act: (tour) => tour.showValue(),
    text: "The deeper the green of the ground, the more it is worth to be there: the values of all desires, added up. "
      + "They follow the creeps." },
  { at: ".space", act: ({ hands }) => hands.addElement({ x: 0.25, y: 0.25 }),
    text: "Now something to desire at the top left, worth +1. It counts at once, with what was learned before. Drag it "
      + "about, or drop more by “Drop an element”." },
  { at: ".versus", act: ({ starters }) => starters.meetVeteran(),
    text: "Two tanks, one seed: the newborn begins without knowledge, the veteran has learned for 100 minutes. The menus "
      + "below the tanks set any other agent beside the first." },
];

class Tour {
  left = null; // where the reader was when the tour began, unless another link has been followed since
  stopShown = 0;

  /** parts: {panel, traits, tank, hands, starters, address}, and look() of the Explorer. */
  constructor(parts) {
    Object.assign(this, parts);
  }

  start() {
    const { traits, address } = this;
    if (this.left?.visits !== address.visits) {
      this.left = { hash: address.now(true), speed: traits.get("speed"), playing: traits.get("playing"),
        visits: address.visits };
    }
    this.showStop(0);
    this.panel.action("next").focus({ preventScroll: true });
  }

  /** Go on to the next stop, but not while a run loads. */
  next() {
    if (this.stopShown + 1 === STOPS.length) return this.end();
    return this.tank.run.frame ? this.showStop(this.stopShown + 1) : null;
  }

  end() {
    const { panel, left, address } = this;
    panel.part(".tour").hidden = true;
    panel.part(".pointed")?.classList.remove("pointed");
    panel.action("tour").focus({ preventScroll: true });
    if (left?.visits === address.visits) address.visit(left.hash, { speed: left.speed, playing: left.playing });
  }

  showStop(index) {
    const { at, text, act } = STOPS[index];
    this.stopShown = index;
    this.panel.part(".tour").hidden = false;
    this.panel.part(".tour p").textContent = `${index + 1} of ${STOPS.length}: ${text}`;
    this.panel.action("next").textContent = index + 1 < STOPS.length ? "Next" : "Done";
    this.panel.part(".pointed")?.classList.remove("pointed");
    const acted = act(this);
    const pointed = this.panel.part(at).closest("label") ?? this.panel.part(at);
    pointed.classList.add("pointed");
    pointed.closest("details")?.setAttribute("open", "");
    for (const each of [this.panel.part(".board canvas"), pointed]) each.scrollIntoView({ block: "nearest" });
    return acted;
  }

  /** Begin a run of the present agent, or else of the first one that can do everything that the tour shows. */
  beginRun() {
    const { traits: { presets }, traits } = this;
    const preset = [traits.get("preset"), ...orderedKeys(presets)].find((key) => {
      const { steps, avoided, parameters: { nodes } } = traits.presetOf(key) ?? { parameters: {} };
      return steps > 2 * LEARNED && avoided === "red" && !nodes.some((node) => node.learns_contacts);
    });
    this.starters.fresh({ ...initialSettings(presets, preset), seed: presets[preset].seed, playing: false });
  }

  runAhead() {
    const { traits, tank: { run } } = this;
    const act = () => traits.write({ speed: 2 });
    if (run.frame.step < LEARNED) run.due = { step: LEARNED, hurries: true, act, news: "Learning for a moment …" };
    traits.write({ playing: true });
  }

  showValue() {
    this.panel.control("heat").checked = true;
    return this.look(this.panel.layers());
  }
}
