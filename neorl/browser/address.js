/* The Explorer's state in the address of its page, so that a link can name a run, its settings and a moment of it.

The first Explorer of a page has the part of the address behind `#explorer:`, in JupyterLab none. What differs from the
preset stands there by its name in `SHORT`; beside it `run`, `seed`, `minute`, at which the run stands still, the `map`
shown with the `goal` chosen in it, and `start`, one of the things to try. */

const PREFIX = "#explorer:";
const SHORT = { agent: "preset", run: "run", seed: "seed", resolutions: "resolutions", modality: "modality",
  recursion: "recursion", red: "valence_red", gains: "gains", rate: "learning_rate", discount: "discount",
  memory: "memory", creeps: "n_creeps" };
const LISTS = ["resolutions", "gains"];
const WORDS = ["preset", "modality"];

/** What an address says, {settings, minute, map, goal, start}, or null if it is not for an Explorer. */
function readAddress(hash, presets, preset) {
  if (!hash.startsWith(PREFIX)) return null;
  const said = new URLSearchParams(hash.slice(PREFIX.length));
  const number = (text) => (text.trim() === "" ? NaN : Number(text));
  const valueOf = (name, text) =>
    LISTS.includes(name) ? text.split(",").map(number) : WORDS.includes(name) ? text : number(text);
  const given = Object.entries(SHORT).filter(([short]) => said.has(short))
    .map(([short, name]) => [name, valueOf(name, said.get(short))]);
  const key = said.get("agent") ?? preset;
  const defaults = Object.hasOwn(presets, key) ? { ...initialSettings(presets, key), seed: presets[key].seed } : {};
  return { settings: { ...defaults, run: 0, ...Object.fromEntries(given) },
    minute: said.has("minute") ? number(said.get("minute")) : null, start: said.get("start"), map: said.get("map"),
    goal: said.has("goal") ? number(said.get("goal")) : null };
}

/** The address of settings, in full where they differ from their preset's, and of what is looked at. */
function addressOf(presets, settings, { minute, map, goal }) {
  const { preset } = settings;
  const defaults = { ...initialSettings(presets, preset), preset: null, run: null, seed: presets[preset].seed };
  const said = new URLSearchParams();
  for (const [short, name] of Object.entries(SHORT)) {
    const differs = JSON.stringify(settings[name]) !== JSON.stringify(defaults[name]);
    if (differs) said.set(short, String(settings[name]));
  }
  if (minute) said.set("minute", minute);
  if (goal !== null) said.set("map", map), said.set("goal", goal);
  return PREFIX + said.toString().replaceAll("%2C", ",");
}

class Address extends Starters {
  hasAddress() {
    return document.querySelector(".neorl-explorer:not(.neorl-replay)") === this.root
      && !document.body.hasAttribute("data-jp-theme-name");
  }

  /** Go to the run that the address names, if it names one. Returns whether it does. */
  visit() {
    const { presets, modalities, model } = this;
    const said = this.hasAddress() ? readAddress(location.hash, presets, model.get("preset")) : null;
    if (!said) return false;
    const { settings, minute, map, goal, start } = said;
    const starts = { watch: () => this.watch(), red: () => this.revalueRed(), corner: () => this.showCorner(),
      game: () => this.joinGame() };
    const wishes = { get: (name) => settings[name] ?? model.get(name) };
    const isMoment = minute === null || (minute >= 0 && minute < 1e6);
    const problem = problemOf(presets, modalities, wishes) || (isMoment ? "" : "The address names no minute.");
    if (problem) {
      this.refuse(this.control("preset"), `The address describes no run of this Explorer. ${problem}`);
      return false;
    }
    this.root.scrollIntoView({ block: "nearest" });
    const { world, steps } = presets[settings.preset];
    const step = Math.min(steps, Math.round((minute ?? 0) * 60 * world.fps));
    const act = async () => {
      if (minute !== null || this.calm) this.write({ playing: false });
      if (map) await this.look({ map, goal });
      if (Object.hasOwn(starts, start)) await starts[start]();
      this.refresh();
    };
    this.fresh({ ...settings, playing: true }, { step, hurries: true, act, news: "On the way to that moment …" });
    return true;
  }

  /** The address of now. Of a run that was changed on the way only the settings can be named. */
  addressOfNow() {
    const { life: { frame, changed, world }, presets, model } = this;
    const settings = { ...this.settings(), seed: model.get("seed"), run: model.get("run") };
    const minute = frame && !changed ? Number((frame.step / world.fps / 60).toFixed(5)) : 0;
    const { name: map = "", goal = null } = frame?.seen ?? {};
    return addressOf(presets, settings, { minute, map, goal });
  }

  /** Put the address of now into the page's, once the reader has turned something, without a new entry of history. */
  writeAddress() {
    if (!this.touched || this.running() || this.failed || !this.life.frame || this.life.due || !this.hasAddress()) return;
    clearTimeout(this.writing);
    this.writing = setTimeout(() => history.replaceState(history.state, "", this.addressOfNow()), 300);
  }

  async copyLink() {
    const link = new URL(this.addressOfNow(), location.href).href;
    if (this.hasAddress()) history.replaceState(history.state, "", link);
    this.life.news = await navigator.clipboard?.writeText(link).then(() => "The link is copied.", () => null)
      ?? "The link to this moment is in the address of the page.";
    this.refresh();
  }
}
