/* The curve of reward over the run, on a canvas of its own, drawn purely from its arguments, as in drawing.js. */

/** Reward per second over the run. curve: {seconds, binSeconds, rewards (of bins), beside (of another run, or none),
 * lived (seconds), band or none}. */
function drawCurve(canvas, colours, { seconds, binSeconds, rewards, beside, lived, band }) {
  const board = { context: fittedContext(canvas), colours };
  const [left, top, right, bottom] = [34, 8, canvas.clientWidth - 8, canvas.clientHeight - 20];
  const { edges, rates } = ratesOf(rewards, binSeconds, lived, seconds);
  const others = beside ? ratesOf(beside, binSeconds, lived, seconds).rates : [];
  const values = [0, 0.5, ...rates, ...others, ...(band ? [...band.low, ...band.high] : [])];
  const [least, most] = [Math.min(...values), Math.max(...values)];
  const [step, minutes] = [roundStep((most - least) / 3), roundStep(seconds / 240)];
  const xOf = (second) => left + ((right - left) * second) / seconds;
  const yOf = (rate) => bottom - ((bottom - top) * (rate - least)) / (most - least);
  const label = (text, x, y, align) => write(board, text, x, y, "11px", colours.ink, null, align);
  for (let tick = Math.ceil(least / step); tick * step <= most; tick += 1) {
    const [text, y] = [String(Number((tick * step).toFixed(6))).replace("-", "−"), yOf(tick * step)];
    stroke(board, colours.ink, 0.8, tick ? 0.15 : 0.7, (path) => addLine(path, [[left, y], [right, y]]));
    label(text, left - 6, y, "right");
  }
  for (let at = 0; at <= seconds / 60; at += minutes) {
    const isLast = at + minutes > seconds / 60;
    label(`${Number(at.toFixed(3))}${isLast ? " min" : ""}`, xOf(60 * at), bottom + 13, isLast ? "right" : "center");
  }
  const pointsOf = (borders, heights) => Array.from(heights, (rate, bin) =>
    [xOf((borders[bin] + borders[bin + 1]) / 2), yOf(rate)]);
  if (band) {
    const outline = [...pointsOf(band.edges, band.low), ...pointsOf(band.edges, band.high).reverse()];
    fillPath(board, colours.ink, 0.2, (path) => addLine(path, outline));
    stroke(board, colours.ink, 1, 0.8, (path) => addLine(path, pointsOf(band.edges, band.middle)));
  }
  for (const [colour, each] of [[colours.place, others], [colours.agent, rates]]) {
    const points = pointsOf(edges, each);
    if (points.length) points.unshift([left, points[0][1]]); // from the first second
    stroke(board, colour, 1.8, 1, (path) => addLine(path, points));
  }
}

/** Reward per second in each bin that has begun. The last, unfinished one is averaged over the full length of a bin,
 * and so reaches back into the bin before. */
function ratesOf(rewards, binSeconds, lived, seconds) {
  const bins = lived < 1 ? 0 : Math.ceil(Math.min(lived, seconds) / binSeconds - 1e-9);
  const edges = Array.from({ length: bins + 1 }, (_, bin) => Math.min(bin * binSeconds, lived, seconds));
  const rates = Array.from({ length: bins }, (_, bin) => {
    const [length, isOpen] = [edges[bin + 1] - edges[bin], bin === bins - 1 && lived < seconds];
    if (!bin || !isOpen) return rewards[bin] / length;
    return (rewards[bin] + (1 - length / binSeconds) * rewards[bin - 1]) / binSeconds;
  });
  return { edges, rates };
}

/** The least number of the form 1, 2 or 5 times a power of ten that is not below `least`. */
function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5].find((times) => times * power >= least) ?? 10);
}
