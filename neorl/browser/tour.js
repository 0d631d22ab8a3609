/* A guided tour of a few stops. Each points at a part of the page and operates the controls as a reader would; it starts
only when asked to, and at its end the reader is back at the moment from which it started. */

const STOPS = [
  { at: ".space", act: (page) => page.beginTourRun(),
    text: "The blue disc is the agent. Green creeps pay +1, red ones −1. The shaded cell is where it is, on one of its "
      + "maps. It has learned nothing yet." },
  { at: `[data-action="play"]`, act: (page) => page.write({ speed: 5, playing: true }),
    text: "It knows nothing yet, so chance decides. From every move it learns something about the ways to all cells, "
      + "whatever it wants." },
  { at: ".space", act: (page) => page.runAhead(),
    text: `${grouped(LEARNED)} steps later it has learned from green creeps and red ones. Dashed arrows are its desires: `
      + "where each kind of cell would take it now." },
  { at: `[name="heat"]`, act: (page) => page.showValue(),
    text: "The deeper the green of the ground, the more it is worth to be there: the values of all desires, added up. "
      + "They follow the creeps." },
  { at: ".space", act: (page) => page.addElement({ x: 0.25, y: 0.25 }),
    text: "Now something to desire at the top left, worth +1. It counts at once, with what was learned before. Drag it "
      + "about, or drop more by “Drop an element”." },
  { at: ".versus", act: (page) => page.meetVeteran(),
    text: "Two tanks, one seed: the newborn begins without knowledge, the veteran has learned for 100 minutes. The menus "
      + "below the tanks set any other agent beside the first." },
];

class Tour extends Beside {
  startTour() {
    const { model } = this;
    this.left ??= { address: this.addressOfNow(true), speed: model.get("speed"), playing: model.get("playing") };
    this.showStop(0);
    this.action("next").focus({ preventScroll: true });
  }

  /** Go on to the next stop, but not while a run loads. */
  nextStop() {
    if (this.stopShown + 1 === STOPS.length) return this.endTour();
    return this.life.frame ? this.showStop(this.stopShown + 1) : null;
  }

  endTour() {
    this.part(".tour").hidden = true;
    this.part(".pointed")?.classList.remove("pointed");
    this.action("tour").focus({ preventScroll: true });
    if (!this.left) return; // another link has been followed since
    const { address, ...values } = this.left;
    this.visit(address, values);
  }

  showStop(index) {
    const { at, text, act } = STOPS[index];
    this.stopShown = index;
    this.part(".tour").hidden = false;
    this.part(".tour p").textContent = `${index + 1} of ${STOPS.length}: ${text}`;
    this.action("next").textContent = index + 1 < STOPS.length ? "Next" : "Done";
    this.part(".pointed")?.classList.remove("pointed");
    const acted = act(this);
    const pointed = this.part(at).closest("label") ?? this.part(at);
    pointed.classList.add("pointed");
    pointed.closest("details")?.setAttribute("open", "");
    for (const each of [this.part(".board canvas"), pointed]) each.scrollIntoView({ block: "nearest" });
    return acted;
  }

  /** Begin a run of the present agent, or else of the first one that can do everything that the tour shows. */
  beginTourRun() {
    const { presets, model } = this;
    const preset = [model.get("preset"), ...orderedKeys(presets)].find((key) => {
      const { steps, avoided, parameters: { nodes } } = presets[key] ?? { parameters: {} };
      return steps > 2 * LEARNED && avoided === "red" && !nodes.some((node) => node.learns_contacts);
    });
    this.fresh({ ...initialSettings(presets, preset), seed: presets[preset].seed, playing: false });
  }

  runAhead() {
    const { life } = this;
    const act = () => this.write({ speed: 2 });
    if (life.frame.step < LEARNED) life.due = { step: LEARNED, hurries: true, act, news: "Learning for a moment …" };
    this.write({ playing: true });
  }

  showValue() {
    this.control("heat").checked = true;
    return this.look(this.layers());
  }
}
