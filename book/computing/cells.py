"""The cells of a built page: those of its notebook, in their order.

1. The parameters show the values used for the page, and the cell that papermill injects is left out.
2. The caption of a figure is a Markdown cell below it, tagged as such, so that every reader of the notebook sees it;
   the book shows it under the figure's number, answers its question by what is recorded on the claims it shows, and
   ends it with what the figure itself shows (`companion.page.captions`).
3. A fold of code and output bears the title in its first line, a comment, which JupyterLab shows in its place.
"""

import re

PARAMETERS, INJECTED, CAPTION = "parameters", "injected-parameters", "caption"
LABEL = "**Figure.** "  # with which a caption begins
TITLED = {"hide-cell", "hide-output"}  # tags of folds that may have a title


def of_page(cells, values):
    """The cells of a computed notebook as its page shows them. values: of its parameters, {name: value}."""
    kept, findings = [], findings_in(cells)
    for cell in cells:
        if CAPTION in tags(cell):
            figure = kept[-1].metadata["mystnb"]["figure"]
            caption = answered(caption_of(cell), findings.get(figure["name"]))
            figure["caption"] = " ".join([caption, *found_in(kept[-1])])
        elif INJECTED not in tags(cell):
            kept.append(cell)
        if PARAMETERS in tags(cell):
            cell.source = with_values(cell.source, values)
        if TITLED & tags(cell) and cell.source.startswith("# "):
            title, _, cell.source = cell.source.removeprefix("# ").partition("\n")
            cell.metadata.setdefault("mystnb", {}).update(code_prompt_show=title, code_prompt_hide=title)
    return kept


def caption_of(cell):
    """The caption in a cell, in one line, without its label."""
    return " ".join(cell.source.removeprefix(LABEL).split("\n"))


def findings_in(cells):
    """What is recorded on the claims that figures show, {label of a figure: words}, as the answer of a page has it."""
    outputs = (output.get("metadata", {}).get("text/html", {}) for cell in cells for output in cell.get("outputs", ()))
    return next((each["findings"] for each in outputs if "findings" in each), {})


def found_in(cell):
    """What the figure of a cell shows, in words, a list; the output that says so under JupyterLab is left out."""
    of_outputs = [output.get("metadata", {}).get("text/html", {}).get("found") for output in cell.get("outputs", ())]
    cell.outputs = [output for output, words in zip(cell.get("outputs", ()), of_outputs) if not words]
    return [words for words in of_outputs if words]


def answered(caption, finding):
    """A caption whose question, its first sentence, is followed by what was found, if anything was."""
    question, mark, rest = caption.partition("? ")
    return f"{question}{mark}Recorded: {finding}. {rest}" if finding and mark else caption


def tags(cell):
    """The tags of a cell, a set."""
    return set(cell.metadata.get("tags", ()))


def with_values(source, values):
    """The source of a cell of parameters, ``name: type = default  # comment``, with other values for the defaults.

    Raises ValueError for a name that is not there.
    """
    for name, value in values.items():
        shown = f"{value:_}" if isinstance(value, int) else repr(value)
        source, found = re.subn(rf"^({name}: \w+ = ).*?(?=\s*(#|$))", rf"\g<1>{shown}", source, flags=re.MULTILINE)
        if not found:
            raise ValueError(f"a parameter must be one of the notebook's, but is {name}")
    return source
