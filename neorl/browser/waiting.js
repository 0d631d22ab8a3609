/* What stands in the place of a living figure while its kernels are being compiled. */

const LONGEST = 3600; // seconds; nobody compiles any more for a page that was saved before
const WAITING = `<div class="neorl-explorer" data-state="compiling"><p role="timer"></p><div class="side" hidden>
  <p class="title">Reward per second</p><canvas class="curve" role="img"
  aria-label="Reward per simulated second over recorded runs, in minutes"></canvas><p class="legend"></p></div></div>`;

/** Whether the kernels of a model are being compiled. */
function isCompiling(model) {
  const age = Date.now() / 1000 - model.get("_compiling")?.since; // NaN if nothing is being compiled
  return Object.keys(model.get("_wasm") ?? {}).length === 0 && age < LONGEST;
}

/** Say in a place of the page that kernels are being compiled. preset: with a curve behind it to show, or none. Returns
 * what ends that. */
function waitIn(place, model, preset = null) {
  const root = elementOf(WAITING);
  const tell = () => {
    const seconds = Math.max(0, Math.round(Date.now() / 1000 - model.get("_compiling").since));
    root.querySelector("[role=timer]").textContent = `Compiling the kernels for the browser, once: ${seconds} s so far.`;
  };
  tell();
  const [ticking, ends] = [setInterval(tell, 1000), [() => root.remove()]];
  place.replaceChildren(root);
  if (preset?.behind) {
    const { behind, steps, world: { fps } } = preset;
    const canvas = root.querySelector("canvas");
    const draw = () => drawCurves(canvas, readColours(root), { seconds: steps / fps, binSeconds: 1, elapsed: 0 }, [], behind);
    root.querySelector(".side").hidden = false;
    root.querySelector(".legend").replaceChildren(element("span", { className: "swatch band" }), behind.words);
    ends.push(watchLook([canvas], draw));
    draw();
  }
  return () => [() => clearInterval(ticking), ...ends].forEach((end) => end());
}
