/* Direct interaction with the tank: choosing a cell, dropping and dragging things, playing against the agent. */

class Hands {
  elements = []; // of interest, dropped by the reader: {x, y, valence}
  selected = null; // the number of one of them
  dropping = false; // whether the next click drops one

  /** parts: {panel, traits, tank}, and functions {look, refresh, wake, togglePlay} of the Explorer. */
  constructor(parts) {
    Object.assign(this, parts);
  }

  placeHandles() {
    const { elements, selected, panel, tank: { run: { frame } } } = this;
    const creeps = this.traits.hasCreeps() ? frame?.things ?? [] : []; // places cannot be dragged
    const [grips, marks] = [panel.part(".grips"), panel.part(".marks")];
    grow(grips, creeps.length, () => element("span", { className: "grip" }));
    grow(marks, elements.length, () => element("button", { type: "button", className: "interest" }));
    for (const [parent, things] of [[grips, creeps], [marks, elements]]) things.forEach(({ x, y }, index) =>
      Object.assign(parent.children[index].style, { left: `${100 * shareOf(x)}%`, top: `${100 * shareOf(y)}%` }));
    elements.forEach(({ valence }, index) => {
      const [mark, worth] = [marks.children[index], signed(valence)];
      mark.textContent = worth;
      mark.ariaLabel = `Element ${index + 1}, valence ${worth}. Arrow keys move it, Delete removes it.`;
      mark.classList.toggle("red", valence < 0);
      mark.classList.toggle("chosen", index === selected);
    });
  }

  placeOf({ clientX, clientY }) {
    const { left, top, width } = this.panel.arena.getBoundingClientRect();
    const [x, y] = [clientX - left, clientY - top].map((offset) => clampedToBoard(placeAt(offset / width)));
    return { x, y };
  }

  /** Draggable things are elements over the canvas, so that elsewhere a touch scrolls the page. */
  grasp(event) {
    const { target, clientX, clientY, pointerId } = event;
    const thing = target.closest(".grip, .interest");
    const { run } = this.tank;
    run.slid = false;
    if (target.dataset.key) event.preventDefault(), this.hold(KEYS[target.dataset.key][0]);
    if (!thing || !run.frame) return;
    thing.setPointerCapture(pointerId);
    run.held = { index: indexOf(thing), isCreep: thing.matches(".grip"), clientX, clientY };
  }

  /** Whether the pointer is near a creep or holds one: time then slows, or the creep would escape. */
  isReaching() {
    const { held, pointer, frame, game } = this.tank.run;
    if (held?.isCreep) return true;
    if (!pointer || game || !this.traits.hasCreeps() || performance.now() - pointer.at > REACHING) return false;
    return frame.things.some(({ x, y }) => Math.hypot(x - pointer.x, y - pointer.y) < frame.radius + REACH);
  }

  pull(event) {
    const { tank: { run, run: { held } } } = this;
    if (event.pointerType === "mouse") run.pointer = { ...this.placeOf(event), at: performance.now() };
    run.slid ||= held && Math.hypot(event.clientX - held.clientX, event.clientY - held.clientY) > 3;
    if (!held || !run.slid) return;
    if (!held.isCreep) return this.changeElement(held.index, this.placeOf(event));
    run.dragged = { creep: held.index, ...this.placeOf(event) }; // sent once per picture
    this.wake();
  }

  async sendDragged() {
    const { tank, tank: { run, run: { dragged } } } = this;
    Object.assign(run, { dragged: null, changed: true });
    tank.take(await tank.ask({ type: "drag", ...dragged }));
  }

  /** A tap chooses a cell; a second one at the same place undoes that and drops an element. */
  async tap(event) {
    const { panel, tank: { run, run: { frame, tapped: before } } } = this;
    if (run.slid || run.game || !frame || !event.target.matches("canvas, .grip")) return;
    const place = this.placeOf(event);
    if (this.dropping) return this.dropElement(place);
    run.tapped = { ...place, at: event.timeStamp, goal: frame.seen.goal };
    this.select(null);
    panel.arena.focus({ preventScroll: true });
    const [late, far] = [event.timeStamp - before?.at, Math.hypot(place.x - before?.x, place.y - before?.y)];
    if (!(late < DOUBLE_TAP && far < NEARBY)) return this.look({ at: place });
    run.tapped = null;
    this.dropElement(place);
    return this.look({ goal: before.goal });
  }

  pressed(event) {
    const { panel, tank: { run, run: { game } } } = this;
    const { target, key } = event;
    const [action, dx, dy] = KEYS[key] ?? [];
    const [onMark, onTank] = [target.matches(".interest"), target === panel.arena];
    if (key === "Escape" && game) return this.leaveGame();
    if (!onMark && !onTank || (action === undefined && !["Enter", " ", "Escape", "Delete"].includes(key))) return null;
    if (onMark && ["Enter", " "].includes(key)) return null;
    if (key === " ") return event.preventDefault(), this.togglePlay();
    if (key === "Escape" && this.dropping) this.dropping = false, this.refresh();
    event.preventDefault();
    if (key === "Escape") return panel.arena.focus(), this.select(null), run.cursor = null, this.look({ goal: null });
    if (onMark && key === "Delete") return this.deleteElement();
    if (onMark) return this.changeElement(indexOf(target), shifted(this.elements[indexOf(target)], dx, dy, 0.02));
    if (game) return this.hold(action);
    run.cursor = shifted(run.cursor ?? { x: 0.5, y: 0.5 }, dx ?? 0, dy ?? 0, 0.025);
    this.wake();
    if (action === undefined && this.dropping) return this.dropElement(run.cursor);
    return action === undefined ? this.look({ at: run.cursor }) : null;
  }

  /** Drop an element where the next click is; by keyboard in the middle, from where the arrow keys move it. */
  beginDrop(byKeyboard) {
    if (byKeyboard) return this.dropElement({ x: 0.5, y: 0.5 });
    this.dropping = !this.dropping;
    return this.refresh();
  }

  dropElement(place) {
    this.dropping = false;
    if (this.elements.length >= MOST_ELEMENTS || !this.tank.run.frame) return;
    this.addElement(place);
    this.panel.part(".marks").lastChild.focus();
  }

  addElement(element) {
    this.elements.push({ valence: 1, ...element });
    this.placeHandles();
    this.traits.note("elements");
  }

  changeElement(index, change) {
    Object.assign(this.elements[index], change);
    this.select(index);
    this.traits.note("elements");
  }

  deleteElement() {
    this.elements.splice(this.selected, 1);
    this.tank.run.held = null;
    this.select(null);
    this.panel.action("drop").focus();
    this.traits.note("elements");
  }

  clearElements() {
    this.dropElements();
    this.traits.note("elements");
  }

  dropElements() {
    Object.assign(this, { elements: [], dropping: false });
    this.tank.run.held = null;
    this.select(null);
  }

  select(index) {
    this.selected = index;
    const { valence } = this.elements[index] ?? {};
    if (index !== null) this.panel.showSlider("element-valence", valence, signed(valence));
    this.refresh();
  }

  // Play against it

  async joinGame() {
    const { panel, tank, tank: { run } } = this;
    run.game = { held: NO_ACTION, next: null, sent: NO_ACTION, pushed: 0, score: run.frame.reward };
    run.changed = true;
    this.traits.write({ playing: true });
    panel.arena.focus();
    this.refresh();
    tank.take(await tank.ask({ type: "play", action: NO_ACTION }));
  }

  async leaveGame() {
    const { tank } = this;
    tank.run.game = null;
    this.refresh();
    tank.take(await tank.ask({ type: "play", action: null }));
  }

  hold(action) {
    const { game } = this.tank.run;
    if (!game || action === undefined || action === game.held) return;
    Object.assign(game, { held: action, next: action });
  }

  steer(now) {
    const { tank, tank: { run: { game } } } = this;
    const action = game.next ?? (now - game.pushed >= THRUST_EVERY ? game.held : NO_ACTION);
    if (action !== game.sent) tank.ask({ type: "play", action });
    Object.assign(game, { sent: action, next: null, pushed: action === NO_ACTION ? game.pushed : now });
  }
}
