/* The Explorer's page: its parts and controls by name, and the messages on them. It knows nothing of runs. */

class Panel {
  only = ""; // the name of a control that stands beside the tank by itself
  numbers = CHIPS; // resolutions to press
  failed = false; // whether a message stands in the place of a run

  constructor() {
    // Each widget of a page has a module of its own, and so a number of its own.
    this.root = elementOf(pageOf(`neorl-tank-${Math.random().toString(36).slice(2)}`));
    [this.arena, this.other, this.limb, this.curve, this.catches] = this.root.querySelectorAll("canvas");
  }

  part(selector) {
    return this.root.querySelector(selector);
  }

  control(name) {
    return this.part(`[name="${name}"]`);
  }

  action(name) {
    return this.part(`[data-action="${name}"]`);
  }

  fillMenus(presets, modalities) {
    fillMenu(this.control("preset"), presets, orderedKeys(presets));
    this.control("learned").append(...LESSONS.map((minutes) => new Option(counted(minutes, "minute"), minutes)));
    this.control("modality").append(...Object.keys(modalities).map((name) => new Option(name, name)));
    this.control("object_state").append(...Object.entries(STATES).map(([state, label]) => new Option(label, state)));
  }

  /** Put one control beside the tank, with a sentence on it, and fold the others. Of a menu, the choices of the page's
   * agents become buttons, if they have several, and the whole of it is folded. */
  putFirst(name, presets) {
    this.only = name;
    const { parentElement: label } = this.control(name);
    const help = element("p", { className: "help" }, HELP[name]);
    const picks = this.control(name).matches("select") ? this.picksOf(presets) : [];
    const title = label.firstElementChild.textContent;
    const group = element("div", { className: "buttons picks", role: "group", ariaLabel: title }, ...picks,
      element("button", { type: "button", dataset: { action: "more" } }, "More …"));
    const control = [label.closest(".setting") ?? label];
    const buttons = [element("p", { className: "title" }, title), group];
    const first = element("div", { className: "only" }, ...(picks.length > 1 ? buttons : control), help);
    this.part(".starters").prepend(this.action("red"), this.action("tour"));
    this.part(".more").prepend(...[".bar", ".settings", ".starters", ".tools"].map((each) => this.part(each)));
    this.part(".columns").prepend(first);
    this.part(".curve").after(this.part("progress"));
    this.part("summary").textContent = "All controls";
  }

  /** A button for each choice that agents of the page have, of the first that has it. */
  picksOf(presets) {
    const own = orderedKeys(presets).filter((key) => presets[key].is_condition);
    const alike = Map.groupBy(own, (key) => choiceOf(this.only, initialSettings(presets, key), presets));
    return [...alike.values()].map(([key]) => pick(key, settingInWords(this.only, initialSettings(presets, key), presets)));
  }

  /** Show which of the choices is the present one. */
  showPick(settings, presets) {
    const choice = choiceOf(this.only, settings, presets);
    for (const button of this.root.querySelectorAll("[data-pick]")) {
      button.ariaPressed = choiceOf(this.only, initialSettings(presets, button.dataset.pick), presets) === choice;
    }
  }

  /** Unfold all controls, at the menu that stands there, or at the first one if the agent does not have it. */
  unfold() {
    this.part("details").open = true;
    [this.control(this.only), this.control("preset")].find(({ disabled }) => !disabled).focus();
  }

  /** Offer the agents of the page before all others, and as resolutions those of their maps. */
  offerOfPage(presets) {
    const menu = this.control("preset");
    menu.prepend(...menu.querySelectorAll(`[label="${OF_PAGE}"]`));
    const own = orderedKeys(presets).filter((key) => presets[key].is_condition);
    const numbers = own.flatMap((key) => presets[key].resolutions);
    if (numbers.length) this.numbers = numbers;
  }

  /** Offer the resolutions of an agent's maps besides the others. */
  offerResolutions(ofAgent) {
    const [numbers, chips] = [inOrder([...this.numbers, ...ofAgent]).filter((n) => n > 1), this.part(".chips")];
    if (isSame(numbers, Array.from(chips.children, ({ dataset }) => Number(dataset.chip)))) return;
    chips.replaceChildren(...numbers.map(chip));
  }

  /** Show a control and enable it, or hide it where the agent or its world has no such setting. */
  offer(name, isOffered) {
    this.control(name).disabled = this.control(name).parentElement.hidden = !isOffered;
  }

  showSlider(name, value, text = shown(value)) {
    const slider = this.control(name);
    slider.value = value;
    slider.nextElementSibling.value = slider.ariaValueText = text;
  }

  /** What is drawn of the superposed value, with its tiles along each side. */
  layers() {
    const tilesOf = (name) => (this.control(name).checked ? FIELD_TILES : 0);
    return { field: tilesOf("field"), heat: tilesOf("heat") };
  }

  showTank() {
    this.part(".board canvas").scrollIntoView({ block: "nearest" });
  }

  /** Say why there is no run, or, given "", that there is one. */
  complain(message) {
    this.failed = Boolean(message);
    Object.assign(this.part("[role=alert]"), { hidden: !message, textContent: message });
  }

  /** Mark a field whose new value is not allowed, with a message below it. */
  refuse(field, allowed) {
    field.ariaInvalid = "true";
    (field.closest(".setting, .open") ?? field.parentElement).after(this.refusal(allowed));
    if (field.name === "open-run") field.value = 0;
  }

  /** The message of a refusal, to be put where the reader looks. */
  refusal(reason) {
    return Object.assign(this.part(".refused"), { textContent: `${reason} Nothing was changed.` });
  }

  /** Clear the message of a refusal, once another input has been accepted. */
  forgive() {
    for (const field of this.root.querySelectorAll("[aria-invalid]")) field.ariaInvalid = null;
    this.part(".refused").textContent = "";
  }
}
