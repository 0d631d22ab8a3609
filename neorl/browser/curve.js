/* Curves over the run, on a canvas of their own, drawn purely from their arguments, as in drawing.js. */

/** Draw rates over the run. span: {seconds, binSeconds, elapsed (seconds), mark ({second, text}, a line, or none)}; lines:
 * {colour, totals (of bins), per (so many seconds, by default 1), span (of its own), isDashed, isPale}; band: of the
 * reward of other runs, or none. */
function drawCurves(canvas, colours, span, lines, band = null) {
  const board = { context: fittedContext(canvas), colours };
  const [left, top, right, bottom] = [34, 8, canvas.clientWidth - 8, canvas.clientHeight - 20];
  const { seconds } = span;
  const curves = lines.map(({ totals, per = 1, ...line }) => ({ ...line, ...ratesOf(totals, line.span ?? span, per) }));
  const values = [0, 0.5, ...curves.flatMap(({ rates }) => rates), ...(band ? [...band.low, ...band.high] : [])];
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
  if (span.mark) {
    const x = xOf(span.mark.second);
    stroke(board, colours.ink, 1, 0.7, (path) => addLine(path, [[x, top], [x, bottom]]));
    label(span.mark.text, x - 6, top + 4, "right");
  }
  const pointsOf = (borders, heights) => Array.from(heights, (rate, bin) =>
    [xOf((borders[bin] + borders[bin + 1]) / 2), yOf(rate)]);
  if (band) {
    const outline = [...pointsOf(band.edges, band.low), ...pointsOf(band.edges, band.high).reverse()];
    board.context.save();
    board.context.clip(pathOf((path) => path.rect(left, 0, right - left, bottom))); // it may be of longer runs
    fillPath(board, colours.ink, 0.2, (path) => addLine(path, outline));
    stroke(board, colours.ink, 1, 0.8, (path) => addLine(path, pointsOf(band.edges, band.middle)));
    board.context.restore();
  }
  for (const { colour, edges, rates, isDashed, isPale } of curves) {
    const points = pointsOf(edges, rates);
    if (points.length) points.unshift([left, points[0][1]]); // from the first second
    board.context.setLineDash(isDashed ? [4, 3] : []);
    stroke(board, colours[colour], 1.8, isPale ? 0.7 : 1, (path) => addLine(path, points));
  }
  board.context.setLineDash([]);
}

/** The rate, per so many seconds, in each bin that has begun. The last, unfinished one is averaged over the full length
 * of a bin, and so reaches back into the bin before. */
function ratesOf(totals, { seconds, binSeconds, elapsed }, per = 1) {
  const bins = elapsed < 1 ? 0 : Math.ceil(Math.min(elapsed, seconds) / binSeconds - 1e-9);
  const edges = Array.from({ length: bins + 1 }, (_, bin) => Math.min(bin * binSeconds, elapsed, seconds));
  const rates = Array.from({ length: bins }, (_, bin) => {
    const [length, isOpen] = [edges[bin + 1] - edges[bin], bin === bins - 1 && elapsed < seconds];
    if (!bin || !isOpen) return (per * totals[bin]) / length;
    return (per * (totals[bin] + (1 - length / binSeconds) * totals[bin - 1])) / binSeconds;
  });
  return { edges, rates };
}

/** The least number of the form 1, 2 or 5 times a power of ten that is not below `least`. */
function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5].find((times) => times * power >= least) ?? 10);
}
