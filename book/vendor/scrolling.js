// Tables wider than their column scroll within themselves. Here they also scroll by keyboard, have a name for screen
// readers, and fade at an edge that hides more. On a phone, rows of claims become cards instead (book.css). Tables that
// fit are left alone.
const BOXES = ".bd-content :is(.pst-scrollable-table-container, .wide-table)";
const PHONE = window.matchMedia("screen and (max-width: 768px)");

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

// Each cell of a table that sets claims of the thesis beside findings says which column it is in, for cards.
const label = (box) => {
  const heads = [...box.querySelectorAll("thead th")].map((cell) => cell.textContent.trim());
  if (heads[0] !== "Claim" || !heads.includes("Thesis")) return;
  box.dataset.claims = "";
  for (const row of box.querySelectorAll("tbody tr")) {
    [...row.cells].forEach((cell, at) => { cell.dataset.head = heads[at] ?? ""; });
  }
};

const mark = (box) => {
  box.classList.remove("cards");
  box.classList.toggle("cards", "claims" in box.dataset && PHONE.matches && box.scrollWidth > box.clientWidth + 1);
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
    label(box);
    box.addEventListener("scroll", () => mark(box), { passive: true });
    watch.observe(box);
  }
};

if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
else start();
