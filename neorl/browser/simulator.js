/* A worker that runs agents: `engine.js` with the kernels, each module of which loads when its first run begins; and
what a page does when one of its requests fails. */

/** An error that the reader can fix, with a message to show. The messages of other errors are not shown. */
class Refusal extends Error {}

/** A function after whose errors `fail` is called: with what a refusal says, or without a message. */
function guarded(act, fail) {
  return async (...given) => {
    try {
      await act(...given);
    } catch (error) {
      fail(error instanceof Refusal ? error.message : undefined);
    }
  };
}

/** A number with its unit, "1 minute" or "40 minutes". */
const counted = (number, unit) => `${number} ${unit}${String(number) === "1" ? "" : "s"}`;

/** Start the worker. Each request resolves to its answer, or to null if the worker is stopped before that; after a
 * failure, which is passed to onFailure, none resolves. */
function startEngine(model, onFailure) {
  if (typeof WebAssembly !== "object" || typeof Worker !== "function") {
    throw new Refusal("This browser cannot run the simulation: it needs WebAssembly and web workers.");
  }
  const address = URL.createObjectURL(new Blob([model.get("_engine")], { type: "text/javascript" }));
  const [worker, waiting, loaded] = [new Worker(address), [], new Set()];
  const stop = () => {
    worker.onmessage = worker.onerror = null;
    worker.terminate();
    URL.revokeObjectURL(address);
    for (const resolve of waiting) resolve(null);
  };
  worker.onmessage = ({ data }) => (data.type === "failed" ? onFailure(data.message) : waiting.shift()?.(data));
  worker.onerror = (event) => {
    event.preventDefault();
    onFailure();
  };
  const post = (message, transfer) => {
    worker.postMessage(message, transfer);
    return new Promise((resolve) => waiting.push(resolve));
  };
  const load = (name) => {
    const { buffer, byteOffset, byteLength } = model.get("_wasm")[name];
    const wasm = buffer.slice(byteOffset, byteOffset + byteLength);
    loaded.add(name);
    post({ type: "load", name, wasm, layout: model.get("_layout")[name] }, [wasm]);
  };
  const ask = (message) => {
    if (message.type === "begin" && !loaded.has(message.world.module)) load(message.world.module);
    return post(message);
  };
  return { ask, stop };
}
