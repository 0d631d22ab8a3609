/* New elements of a page. Names and kinds are written by strangers: they become texts and attributes, never markup. */

/** An element with these properties and data attributes, and with these elements and texts in it. */
function element(tag, { dataset = {}, ...properties } = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  Object.assign(made.dataset, dataset);
  made.append(...children);
  return made;
}

/** The element of constant markup, which holds nothing but what our own source says. */
function elementOf(markup) {
  const template = document.createElement("template");
  template.innerHTML = markup;
  return template.content.firstElementChild;
}
