/* What a reader takes along: a link, a picture of the tank, the run as a table; and the tank alone on the screen. */

class Saving {
  /** parts: {panel, traits, tank, hands, address}, and functions {refresh, wake, safely} of the Explorer. */
  constructor(parts) {
    Object.assign(this, parts);
  }

  async copyLink() {
    const { address, hands, tank: { run } } = this;
    const link = new URL(address.now(true), location.href).href;
    if (address.isOwn()) history.replaceState(history.state, "", link);
    const copied = await navigator.clipboard?.writeText(link).then(() => "Link copied.", () => null)
      ?? "The address of the page is the link.";
    const but = "This run was changed on the way: the link begins it anew, with the present settings";
    const drops = hands.elements.length ? ", and drops the elements at this moment" : "";
    const { changed, turn } = run;
    run.news = turn ? `${copied} It makes red good again.` : changed ? `${copied} ${but}${drops}.` : copied;
    this.refresh();
  }

  savePicture() {
    const { panel, panel: { arena }, hands: { elements }, tank: { run: { frame } } } = this;
    const [colours, context] = [readColours(panel.root), arena.getContext("2d")];
    drawArena(arena, colours, frame, { trail: panel.control("trail").checked, elements });
    context.resetTransform();
    Object.assign(context, { globalCompositeOperation: "destination-over", globalAlpha: 1, fillStyle: colours.paper });
    context.fillRect(0, 0, arena.width, arena.height);
    context.globalCompositeOperation = "source-over";
    arena.toBlob(this.safely((picture) => this.save(picture, "png")));
    this.wake();
  }

  /** Save a table with a row for each point of the curves: its second, and what was earned and met up to it. */
  saveRun() {
    const { frame, length: { bin }, world: { fps } } = this.tank.run;
    const quoted = ({ kind }) => (/[",\r\n]/.test(kind) ? `"${kind.replaceAll('"', '""')}"` : kind);
    const head = ["second", "reward", ...frame.hits.map(quoted)];
    const rows = Array.from({ length: Math.ceil(frame.step / bin) }, (_, at) =>
      [Math.min(frame.step, (at + 1) * bin) / fps, frame.rewards[at], ...frame.hits.map(({ counts }) => counts[at])]);
    this.save(new Blob([[head, ...rows].join("\n"), "\n"], { type: "text/csv" }), "csv");
  }

  save(blob, ending) {
    const href = URL.createObjectURL(blob);
    const name = `${slug(this.traits.get("preset")) || "agent"}-run-${this.traits.get("run")}.${ending}`;
    element("a", { href, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(href), 10_000); // the browser reads it later
  }

  async showAlone() {
    await this.panel.root.requestFullscreen().catch(() => null); // a browser may refuse it
    this.panel.arena.focus();
  }
}
