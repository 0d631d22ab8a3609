/* The reader's hands in the tank: choosing a cell, dropping and dragging things, and playing against the agent. */

class Hands extends Controls {
  placeHandles() {
    const { frame: { creeps }, elements, selected } = this;
    const [grips, marks] = [this.part(".grips"), this.part(".marks")];
    grow(grips, creeps.length, () => "<span class='grip'></span>");
    grow(marks, elements.length, () => "<button type='button' class='interest'></button>");
    for (const [parent, things] of [[grips, creeps], [marks, elements]]) things.forEach(({ x, y }, index) =>
      Object.assign(parent.children[index].style, { left: `${100 * shareOf(x)}%`, top: `${100 * shareOf(y)}%` }));
    elements.forEach(({ valence }, index) => {
      const [mark, worth] = [marks.children[index], signed(valence)];
      mark.textContent = worth;
      mark.ariaLabel = `Element ${index + 1}, worth ${worth}. Arrow keys move it, Delete takes it away.`;
      mark.classList.toggle("red", valence < 0);
      mark.classList.toggle("chosen", index === selected);
    });
  }

  placeOf({ clientX, clientY }) {
    const { left, top, width } = this.arena.getBoundingClientRect();
    const [x, y] = [clientX - left, clientY - top].map((offset) => clampedToBoard(placeAt(offset / width)));
    return { x, y };
  }

  /** Things that can be dragged lie over the canvas, so that the page scrolls wherever there is none. */
  grasp(event) {
    const { target, clientX, clientY, pointerId } = event;
    const thing = target.closest(".grip, .interest");
    this.slid = false;
    if (target.dataset.key) event.preventDefault(), this.hold(KEYS[target.dataset.key][0]);
    if (!thing) return;
    thing.setPointerCapture(pointerId);
    this.held = { index: indexOf(thing), isCreep: thing.matches(".grip"), clientX, clientY };
  }

  pull(event) {
    const { held } = this;
    this.slid ||= held && Math.hypot(event.clientX - held.clientX, event.clientY - held.clientY) > 3;
    if (!held || !this.slid) return;
    if (!held.isCreep) return this.changeElement(held.index, this.placeOf(event));
    this.dragged = { creep: held.index, ...this.placeOf(event) }; // sent once a picture
    this.wake();
  }

  async sendDragged() {
    const { dragged } = this;
    Object.assign(this, { dragged: null, changed: true });
    this.take(await this.engine.ask({ type: "drag", ...dragged }));
  }

  /** A tap chooses a cell; a second one at the same place takes that back and drops an element. */
  async tap(event) {
    if (this.slid || this.game || !this.frame || !event.target.matches("canvas, .grip")) return;
    const [before, place] = [this.tapped, this.placeOf(event)];
    this.tapped = { ...place, at: event.timeStamp, goal: this.wanted.goal };
    this.select(null);
    this.arena.focus({ preventScroll: true });
    const [late, far] = [event.timeStamp - before?.at, Math.hypot(place.x - before?.x, place.y - before?.y)];
    if (!(late < DOUBLE_TAP && far < NEARBY)) return this.choose(place);
    this.tapped = null;
    this.dropElement(place);
    await this.look({ goal: before.goal });
  }

  async choose(place) {
    const { tapped } = this;
    const { cell } = await this.engine.ask({ type: "find", map: this.wanted.map, ...place });
    if (tapped === this.tapped) await this.look({ goal: cell === this.wanted.goal ? null : cell });
  }

  pressed(event) {
    const { target, key } = event;
    const [action, dx, dy] = KEYS[key] ?? [];
    const [onMark, onTank] = [target.matches(".interest"), target === this.arena];
    if (key === "Escape" && this.game) return this.leaveGame();
    if (!onMark && !onTank || (action === undefined && !["Enter", " ", "Escape", "Delete"].includes(key))) return null;
    if (onMark && ["Enter", " "].includes(key)) return null;
    event.preventDefault();
    if (key === "Escape") return this.arena.focus(), this.select(null), this.cursor = null, this.look({ goal: null });
    if (onMark && key === "Delete") return this.deleteElement();
    if (onMark) return this.changeElement(indexOf(target), shifted(this.elements[indexOf(target)], dx, dy, 0.02));
    if (this.game) return this.hold(action);
    this.cursor = shifted(this.cursor ?? { x: 0.5, y: 0.5 }, dx ?? 0, dy ?? 0, 0.025);
    this.wake();
    return action === undefined && this.frame ? this.choose(this.cursor) : null;
  }

  dropElement(place) {
    if (this.elements.length >= MOST_ELEMENTS || !this.frame) return;
    this.elements.push({ ...place, valence: 1 });
    this.placeHandles();
    this.part(".marks").lastChild.focus();
    this.note("elements");
  }

  changeElement(index, change) {
    Object.assign(this.elements[index], change);
    this.select(index);
    this.note("elements");
  }

  deleteElement() {
    this.elements.splice(this.selected, 1);
    this.select(null);
    this.action("drop").focus();
    this.note("elements");
  }

  select(index) {
    this.selected = index;
    const { valence } = this.elements[index] ?? {};
    if (index !== null) this.showSlider("element-valence", valence, signed(valence));
    this.refresh();
  }

  // Play against it

  async joinGame() {
    this.game = { held: NO_ACTION, next: null, sent: NO_ACTION, pushed: 0, score: this.frame.reward };
    Object.assign(this, { speedBefore: this.model.get("speed"), changed: true });
    this.write({ speed: 1, playing: true });
    this.arena.focus();
    this.refresh();
    this.take(await this.engine.ask({ type: "play", action: NO_ACTION }));
  }

  async leaveGame() {
    this.forgetGame();
    this.take(await this.engine.ask({ type: "play", action: null }));
  }

  forgetGame() {
    if (!this.game) return;
    this.game = null;
    this.write({ speed: this.speedBefore });
    this.refresh();
  }

  hold(action) {
    if (!this.game || action === undefined || action === this.game.held) return;
    Object.assign(this.game, { held: action, next: action });
  }

  steer(now) {
    const { game } = this;
    const action = game.next ?? (now - game.pushed >= THRUST_EVERY ? game.held : NO_ACTION);
    if (action !== game.sent) this.engine.ask({ type: "play", action });
    Object.assign(game, { sent: action, next: null, pushed: action === NO_ACTION ? game.pushed : now });
  }
}
