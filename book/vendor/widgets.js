// Starts the widgets of a page, without a kernel and without network requests.
//
// The page holds the state of its widgets as JSON and, at the place of each, the id of its model. An anywidget carries
// its front end in its state, so it needs no more than a model to talk to. Like anywidget itself, this imports a
// module once, initialises each model once and renders each view. A widget that cannot start says so in its place, in
// one sentence, and the others continue.
(() => {
  const STATE = 'script[type="application/vnd.jupyter.widget-state+json"]';
  const VIEW = 'script[type="application/vnd.jupyter.widget-view+json"]';
  const NO_KERNEL = "This widget needs a running kernel.";
  const DAMAGED = "This widget cannot be shown: what the page keeps of it is missing or damaged.";

  const records = new Map(); // what the page stores of each model, by the model's id
  const models = new Map(); // the models made from these, by id
  const modules = new Map(); // promises of modules, by their text
  const styles = new Set();

  function startAll() {
    for (const script of document.querySelectorAll(STATE)) {
      for (const [id, record] of Object.entries(parse(script)?.state ?? {})) records.set(id, record);
    }
    document.querySelectorAll(VIEW).forEach(start); // none waits for another, which may take long or for ever
  }

  async function start(script) {
    const el = document.createElement("div");
    script.after(el);
    try {
      const model = modelOf(parse(script)?.model_id);
      const widget = await model.widget();
      await widget.render({ model: model.proxy(), el, ...surroundings() });
    } catch (error) {
      const sentence = document.createElement("p");
      sentence.setAttribute("role", "alert");
      sentence.textContent = error instanceof Refusal ? error.message : `This widget could not start (${error}).`;
      el.replaceChildren(sentence);
    }
  }

  class Refusal extends Error {} // its message is the sentence for the reader

  function parse(script) {
    try {
      return JSON.parse(script.textContent);
    } catch {
      return null;
    }
  }

  // Browsers since 2025 decode base64 natively, many times faster.
  function bytesOf(base64) {
    return Uint8Array.fromBase64?.(base64) ?? Uint8Array.from(atob(base64), (byte) => byte.charCodeAt(0));
  }

  function modelOf(id) {
    if (!models.has(id)) models.set(id, new Model(records.get(id)));
    return models.get(id);
  }

  class Model {
    listeners = [];

    constructor(record) {
      try {
        this.module = record.model_module;
        this.values = record.state;
        for (const { path, data } of record.buffers ?? []) {
          const owner = path.slice(0, -1).reduce((values, key) => values[key], this.values);
          owner[path.at(-1)] = new DataView(bytesOf(data).buffer);
        }
      } catch {
        throw new Refusal(DAMAGED);
      }
    }

    widget() {
      return (this.promise ??= this.initialize()); // once, in however many places it is shown
    }

    async initialize() {
      if (this.module && this.module !== "anywidget") throw new Refusal(NO_KERNEL);
      const { _esm, _css } = this.values ?? {};
      if (typeof _esm !== "string") throw new Refusal(DAMAGED);
      addStyle(_css);
      if (!modules.has(_esm)) modules.set(_esm, importText(_esm));
      const exported = (await modules.get(_esm)).default;
      const widget = typeof exported === "function" ? await exported() : exported;
      await widget.initialize?.({ model: this.proxy(), ...surroundings() });
      return widget;
    }

    set(changes) {
      const changed = Object.entries(changes).filter(([key, value]) => !same(this.values[key], value));
      for (const [key, value] of changed) this.values[key] = value;
      for (const [key, value] of changed) this.tell(`change:${key}`, value);
      if (changed.length) this.tell("change");
    }

    tell(event, ...details) {
      for (const { proxy, react } of this.listeners.filter((listener) => listener.event === event)) {
        react(proxy, ...details);
      }
    }

    // The model as one view has it: `off()` removes the listeners of this view, and leaves the others'.
    proxy() {
      const listens = (listener, events, react) => listener.proxy === proxy
        && (!events || events.split(" ").includes(listener.event)) && (!react || react === listener.react);
      const proxy = {
        get: (key) => this.values[key],
        set: (key, value) => this.set(typeof key === "string" ? { [key]: value } : key),
        save_changes() {}, // there is no kernel to save to
        send() {},
        on: (events, react) => {
          for (const event of events.split(" ")) this.listeners.push({ proxy, event, react });
        },
        off: (events, react) => {
          this.listeners = this.listeners.filter((listener) => !listens(listener, events, react));
        },
        widget_manager: { get_model: async (id) => modelOf(id.replace(/^(IPY_MODEL_|anywidget:)/, "")).proxy() },
      };
      return proxy;
    }
  }

  function surroundings() {
    const invoke = async () => {
      throw new Error(NO_KERNEL);
    };
    return { signal: new AbortController().signal, experimental: { invoke } }; // a view stays as long as its page
  }

  function addStyle(css) {
    if (!css || styles.has(css)) return;
    styles.add(css);
    document.head.append(Object.assign(document.createElement("style"), { textContent: css }));
  }

  async function importText(text) {
    const url = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    try {
      return await import(url);
    } finally {
      URL.revokeObjectURL(url);
    }
  }

  // Whether two values have the same content, so that setting an equal value notifies no listener, and two listeners
  // that set each other come to rest.
  function same(one, other) {
    if (Object.is(one, other)) return true;
    if (![one, other].every((value) => value && typeof value === "object" && !ArrayBuffer.isView(value))) return false;
    const keys = Object.keys(one);
    return Array.isArray(one) === Array.isArray(other) && keys.length === Object.keys(other).length
      && keys.every((key) => key in other && same(one[key], other[key]));
  }

  // As soon as the page is parsed; deferred scripts, such as the large one for formulas, run after that.
  if (document.readyState !== "loading") startAll();
  else document.addEventListener("readystatechange", startAll, { once: true });
})();
