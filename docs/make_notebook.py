"""Turn docs/tutorial.md into docs/tutorial.ipynb: the same text, the same code.

Usage: python docs/make_notebook.py
"""

import json
import re
from pathlib import Path

DOCS = Path(__file__).parent
PAGE = DOCS / "tutorial.md"
NOTEBOOK = DOCS / "tutorial.ipynb"

CODE = re.compile(r"^```python\n(.*?)^```\n", re.MULTILINE | re.DOTALL)
SHOWN = re.compile(r"^<!-- output -->\n```text\n.*?^```\n", re.MULTILINE | re.DOTALL)


def cells_of(text):
    """Return the cells: text and code in turn; what code prints is left to the notebook."""
    cells = []
    for number, part in enumerate(CODE.split(SHOWN.sub("", text))):
        source = part.strip("\n")
        if source:
            cells.append(("code" if number % 2 else "markdown", source))
    return cells


def notebook_of(text):
    """Return the notebook as a JSON text."""
    cells = []
    for number, (kind, source) in enumerate(cells_of(text)):
        cell = {
            "cell_type": kind,
            "id": f"cell-{number}",
            "metadata": {},
            "source": source.splitlines(keepends=True),
        }
        if kind == "code":
            cell |= {"execution_count": None, "outputs": []}
        cells.append(cell)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    book = {
        "cells": cells,
        "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(book, indent=1, ensure_ascii=False, sort_keys=True) + "\n"


if __name__ == "__main__":
    NOTEBOOK.write_text(notebook_of(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
