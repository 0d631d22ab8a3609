/* Direct interaction with the tank: choosing a cell, dropping and dragging things, playing against the agent. */

class Hands extends Controls {
  placeHandles() {
    const { elements, selected, life: { frame } } = this;
    const creeps = this.hasCreeps() ? frame?.things ?? [] : []; // places cannot be dragged
    const [grips, marks] = [this.part(".grips"), this.part(".marks")];
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

  showTank() {
    this.part(".board canvas").scrollIntoView({ block: "nearest" });
  }

  placeOf({ clientX, clientY }) {
    const { left, top, width } = this.arena.getBoundingClientRect();
    const [x, y] = [clientX - left, clientY - top].map((offset) => clampedToBoard(placeAt(offset / width)));
    return { x, y };
  }

  /** Draggable things are elements over the canvas, so that elsewhere a touch scrolls the page. */
  grasp(event) {
    const { target, clientX, clientY, pointerId } = event;
    const thing = target.closest(".grip, .interest");
    this.life.slid = false;
    if (target.dataset.key) event.preventDefault(), this.hold(KEYS[target.dataset.key][0]);
    if (!thing || !this.life.frame) return;
    thing.setPointerCapture(pointerId);
    this.life.held = { index: indexOf(thing), isCreep: thing.matches(".grip"), clientX, clientY };
  }

  /** Whether the pointer is near a creep or holds one: time then slows, or the creep would escape. */
  isReaching() {
    const { held, pointer, frame, game } = this.life;
    if (held?.isCreep) return true;
    if (!pointer || game || !this.hasCreeps() || performance.now() - pointer.at > REACHING) return false;
    return frame.things.some(({ x, y }) => Math.hypot(x - pointer.x, y - pointer.y) < frame.radius + REACH);
  }

  pull(event) {
    const { life, life: { held } } = this;
    if (event.pointerType === "mouse") life.pointer = { ...this.placeOf(event), at: performance.now() };
    life.slid ||= held && Math.hypot(event.clientX - held.clientX, event.clientY - held.clientY) > 3;
    if (!held || !life.slid) return;
    if (!held.isCreep) return this.changeElement(held.index, this.placeOf(event));
    life.dragged = { creep: held.index, ...this.placeOf(event) }; // sent once per picture
    this.wake();
  }

  async sendDragged() {
    const { life, life: { dragged } } = this;
    Object.assign(life, { dragged: null, changed: true });
    this.take(await this.ask({ type: "drag", ...dragged }));
  }

  /** A tap chooses a cell; a second one at the same place undoes that and drops an element. */
  async tap(event) {
    const { life, life: { frame, tapped: before } } = this;
    if (life.slid || life.game || !frame || !event.target.matches("canvas, .grip")) return;
    const place = this.placeOf(event);
    if (this.dropping) return this.dropElement(place);
    life.tapped = { ...place, at: event.timeStamp, goal: frame.seen.goal };
    this.select(null);
    this.arena.focus({ preventScroll: true });
    const [late, far] = [event.timeStamp - before?.at, Math.hypot(place.x - before?.x, place.y - before?.y)];
    if (!(late < DOUBLE_TAP && far < NEARBY)) return this.look({ at: place });
    life.tapped = null;
    this.dropElement(place);
    return this.look({ goal: before.goal });
  }

  pressed(event) {
    const { life, life: { game } } = this;
    const { target, key } = event;
    const [action, dx, dy] = KEYS[key] ?? [];
    if (key === "Escape" && target.closest(".tour")) return this.endTour();
    const [onMark, onTank] = [target.matches(".interest"), target === this.arena];
    if (key === "Escape" && game) return this.leaveGame();
    if (!onMark && !onTank || (action === undefined && !["Enter", " ", "Escape", "Delete"].includes(key))) return null;
    if (onMark && ["Enter", " "].includes(key)) return null;
    if (key === " ") return event.preventDefault(), this.togglePlay();
    if (key === "Escape" && this.dropping) this.dropping = false, this.refresh();
    event.preventDefault();
    if (key === "Escape") return this.arena.focus(), this.select(null), life.cursor = null, this.look({ goal: null });
    if (onMark && key === "Delete") return this.deleteElement();
    if (onMark) return this.changeElement(indexOf(target), shifted(this.elements[indexOf(target)], dx, dy, 0.02));
    if (game) return this.hold(action);
    life.cursor = shifted(life.cursor ?? { x: 0.5, y: 0.5 }, dx ?? 0, dy ?? 0, 0.025);
    this.wake();
    if (action === undefined && this.dropping) return this.dropElement(life.cursor);
    return action === undefined ? this.look({ at: life.cursor }) : null;
  }

  /** Drop an element where the next click is; by keyboard in the middle, from where the arrow keys move it. */
  beginDrop(byKeyboard) {
    if (byKeyboard) return this.dropElement({ x: 0.5, y: 0.5 });
    this.dropping = !this.dropping;
    return this.refresh();
  }

  dropElement(place) {
    this.dropping = false;
    if (this.elements.length >= MOST_ELEMENTS || !this.life.frame) return;
    this.addElement(place);
    this.part(".marks").lastChild.focus();
  }

  addElement(element) {
    this.elements.push({ valence: 1, ...element });
    this.placeHandles();
    this.note("elements");
  }

  changeElement(index, change) {
    Object.assign(this.elements[index], change);
    this.select(index);
    this.note("elements");
  }

  deleteElement() {
    this.elements.splice(this.selected, 1);
    this.life.held = null;
    this.select(null);
    this.action("drop").focus();
    this.note("elements");
  }

  clearElements() {
    this.dropElements();
    this.note("elements");
  }

  dropElements() {
    Object.assign(this, { elements: [], dropping: false });
    this.life.held = null;
    this.select(null);
  }

  select(index) {
    this.selected = index;
    const { valence } = this.elements[index] ?? {};
    if (index !== null) this.showSlider("element-valence", valence, signed(valence));
    this.refresh();
  }

  // Play against it

  async joinGame() {
    const { life } = this;
    this.compare(null); // there is one game at a time
    life.game = { held: NO_ACTION, next: null, sent: NO_ACTION, pushed: 0, score: life.frame.reward };
    life.changed = true;
    this.write({ playing: true });
    this.arena.focus();
    this.refresh();
    this.take(await this.ask({ type: "play", action: NO_ACTION }));
  }

  async leaveGame() {
    this.life.game = null;
    this.refresh();
    this.take(await this.ask({ type: "play", action: null }));
  }

  hold(action) {
    const { game } = this.life;
    if (!game || action === undefined || action === game.held) return;
    Object.assign(game, { held: action, next: action });
  }

  steer(now) {
    const { game } = this.life;
    const action = game.next ?? (now - game.pushed >= THRUST_EVERY ? game.held : NO_ACTION);
    if (action !== game.sent) this.ask({ type: "play", action });
    Object.assign(game, { sent: action, next: null, pushed: action === NO_ACTION ? game.pushed : now });
  }
}
