// Accessible names and roles that the theme omits or gets wrong: a fold and the search button are named by their own
// text, a list of pages that opens has a name, every part of a page lies in a landmark, entries of the bibliography are
// items of a list, and the empty corner of a table is no header.
const correct = () => {
  for (const each of document.querySelectorAll("details.hide > summary, .search-button-field")) {
    each.removeAttribute("aria-label");
  }
  for (const each of document.querySelectorAll("summary:has(> .toctree-toggle)")) each.ariaLabel = "Pages of this part";
  for (const each of document.querySelectorAll("[role=doc-biblioentry]")) each.setAttribute("role", "listitem");
  for (const each of document.querySelectorAll("th")) {
    if (!each.textContent.trim()) each.replaceWith(document.createElement("td"));
  }
  const sidebar = document.getElementById("pst-primary-sidebar");
  sidebar?.setAttribute("role", "complementary");
  sidebar?.setAttribute("aria-label", "Book");
};

if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", correct);
else correct();
