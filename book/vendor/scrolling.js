// Tables wider than their column scroll within themselves. Here they also scroll by keyboard, have a name for screen
// readers, and fade at an edge that hides more. Tables that fit are left alone.
const BOXES = ".bd-content :is(.pst-scrollable-table-container, .wide-table)";

// A table that a notebook wrote as HTML has no box yet.
const wrap = (table) => {
  const box = document.createElement("div");
  box.className = "wide-table";
  table.replaceWith(box);
  box.append(table);
};

const [names, counts] = [new WeakMap(), {}]; // of boxes that scroll, and how many share each name

// The name of a table: the heading above it, since other tables may have the same columns, and its columns.
const nameOf = (box) => {
  const heads = [...box.querySelectorAll("thead th")].map((cell) => cell.textContent.trim()).filter(Boolean);
  const caption = box.querySelector("caption .caption-text, caption")?.textContent.trim();
  const heading = box.closest("section")?.querySelector("h1, h2, h3, h4, h5")?.firstChild?.textContent.trim();
  const name = `${heading ? `${heading}: table` : "Table"}, scrolls sideways: ${caption || heads.join(", ")
    || "no headings"}`;
  counts[name] = (counts[name] ?? 0) + 1;
  return counts[name] > 1 ? `${name} (${counts[name]})` : name;
};

const mark = (box) => {
  const hidden = box.scrollWidth - box.clientWidth;
  const scrolls = hidden > 1;
  box.classList.toggle("more-right", scrolls && box.scrollLeft < hidden - 1);
  box.classList.toggle("more-left", scrolls && box.scrollLeft > 1);
  if (scrolls) {
    box.tabIndex = 0;
    box.setAttribute("role", "region");
    if (!names.has(box)) names.set(box, nameOf(box));
    box.setAttribute("aria-label", names.get(box));
  } else {
    for (const each of ["tabindex", "role", "aria-label"]) box.removeAttribute(each);
  }
};

const start = () => {
  for (const table of document.querySelectorAll(".bd-content .cell_output table")) {
    if (!table.closest(BOXES)) wrap(table);
  }
  const watch = new ResizeObserver((entries) => entries.forEach((entry) => mark(entry.target)));
  for (const box of document.querySelectorAll(BOXES)) {
    box.addEventListener("scroll", () => mark(box), { passive: true });
    watch.observe(box);
  }
};

if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
else start();
