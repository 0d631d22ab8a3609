/* The Explorer as a widget: all views of a model share one Explorer, so they show one run, which reports to Python once.

A model has several views if it is displayed twice, or if JupyterLab opens another view of its output. The Explorer
stands in the newest one, and the others offer to show it there. It stops when the last view is removed. */

const ELSEWHERE = `<div class="neorl-explorer neorl-elsewhere"><p>This Explorer is shown in another place.</p>
  <button type="button">Show it here</button></div>`;

/** A message on the parts of a widget's state that the page lacks, or "". */
function damageOf(model) {
  const isFull = (value) => value !== null && typeof value === "object" && Object.keys(value).length > 0;
  const sound = { _presets: isFull, _modalities: isFull, _layout: isFull, _engine: (text) => Boolean(text),
    _wasm: (all) => isFull(all) && Object.values(all).every((each) => ArrayBuffer.isView(each) && each.byteLength) };
  const missing = Object.keys(sound).filter((name) => !sound[name](model.get(name)));
  const { failed } = model.get("_compiling") ?? {};
  if (failed) return `The kernels for the browser were not compiled: ${failed}`;
  return missing.length ? `The Explorer cannot start: this page does not hold its ${missing.join(", ")}.` : "";
}

export default () => {
  let [model, explorer, endWaiting] = [null, null, () => null];
  const places = []; // of the views; the Explorer stands in the last one

  function settle() {
    const last = places.at(-1);
    endWaiting();
    if (!last) explorer?.stop(), explorer = null;
    else if (!explorer && isCompiling(model)) endWaiting = waitIn(last, model, model.get("_presets")[model.get("preset")]);
    else if (!explorer) start(last);
    else if (explorer.panel.root.parentElement !== last) last.replaceChildren(explorer.panel.root);
    if (explorer) for (const other of places.slice(0, -1)) other.replaceChildren(elementOf(ELSEWHERE));
  }

  function start(place) {
    try {
      const damage = damageOf(model);
      if (damage) throw new Refusal(damage);
      explorer = new Explorer(model, places);
    } catch (error) {
      const message = error instanceof Refusal ? error.message : "The Explorer cannot start on this page.";
      const alert = element("p", { role: "alert" }, message);
      place.replaceChildren(element("div", { className: "neorl-explorer", dataset: { state: "failed" } }, alert));
    }
  }

  function leave(place) {
    places.splice(places.indexOf(place), 1);
  }

  return {
    initialize(host) {
      model = host.model; // which outlives those of the views
      model.on("change:_presets", () => { // Python shows other conditions
        explorer?.stop();
        explorer = null;
        settle();
      });
      for (const name of ["_wasm", "_compiling"]) model.on(`change:${name}`, () => explorer || settle());
    },
    render({ el }) {
      const place = element("div", { className: "neorl-place" });
      place.addEventListener("click", ({ target }) => {
        if (!target.matches(".neorl-elsewhere button")) return;
        leave(place);
        places.push(place);
        settle();
        explorer?.panel.arena.focus();
      });
      el.append(place);
      places.push(place);
      settle();
      return () => {
        leave(place);
        place.remove();
        settle();
      };
    },
  };
};
