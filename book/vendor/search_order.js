/* Scores of search results, which Sphinx adds to its own script (html_search_scorer).

By default modules come before the pages of the book. Here pages with the word in a heading come first, then modules,
classes and functions of that name, and then the pages that mention it. A page of the reference does not count as one
with the word in a heading: its headings are modules, which are results of their own and have a description. */

var Scorer = {
  objNameMatch: 11, objPartialMatch: 6, objPrio: { 0: 15, 1: 5, 2: -5 }, objPrioDefault: 0, // Sphinx's own
  title: 30, partialTitle: 7, term: 5, partialTerm: 2, // a title's is 15 in Sphinx
  score: ([page, , , description, score]) => (page.startsWith("api_") && description === null ? score - 16 : score),
};

// A page that is read from a file cannot fetch others to show excerpts of them.
if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;
