"""Living figures that stand before the experiment, and get the page's own runs once it has them."""

from nbclient import NotebookClient
from nbformat.v4 import new_code_cell, new_notebook

SHOWN = """from ipywidgets import IntSlider
from companion.page import Living
place = Living(IntSlider(1, description="before"))"""


def test_a_widget_takes_the_place_of_another_where_that_stood(tmp_path):
    page = new_notebook(cells=[new_code_cell(SHOWN), new_code_cell("place.show(IntSlider(2, description='after'))")])
    NotebookClient(page, kernel_name="python3", resources={"metadata": {"path": tmp_path}}).execute()
    (output,), rest = page.cells[0].outputs, page.cells[1].outputs
    shown = output.data["application/vnd.jupyter.widget-view+json"]["model_id"]
    states = page.metadata["widgets"]["application/vnd.jupyter.widget-state+json"]["state"]
    assert states[shown]["state"]["description"] == "after" and rest == []
