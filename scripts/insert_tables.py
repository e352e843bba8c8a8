#!/usr/bin/env python3
"""Puts the tables that the benchmark wrote into the documents that show them.

A document marks the place by two lines of its own,
    <!-- benchmark/results/NAME.md -->
    <!-- end of table -->
and whatever stands between them is replaced by that file. Places whose file does not exist stay as they are. With
    <!-- benchmark/results/NAME.md, SCENE, SCENE -->
a place takes the rows of these scenes alone, which is their first column.
"""

import pathlib
import re
import sys

TOP = pathlib.Path(__file__).resolve().parent.parent
DOCUMENTS = ("README.md", "docs/experiments.md", "docs/performance.md", "docs/reliability.md")
PLACE = re.compile(r"(<!-- (benchmark/results/\w+\.md)((?:, [\w ]+)*) -->\n).*?(<!-- end of table -->\n)", re.DOTALL)
HEAD_ROWS = 2


def rows_of(table, scenes):
    """The head of a table and the rows of some scenes."""
    rows = [line for line in table.splitlines() if line.startswith("|")]
    chosen = [row for row in rows[HEAD_ROWS:] if row.split("|")[1].strip() in scenes]
    return "\n".join(rows[:HEAD_ROWS] + chosen) + "\n"


def with_table(place):
    begin, name, scenes, end = place.groups()
    table = TOP / name
    if not table.exists():
        return place.group(0)
    text = table.read_text(encoding="utf-8")
    if scenes:
        text = rows_of(text, [scene.strip() for scene in scenes.split(",")])
    return begin + "\n" + text + "\n" + end


def main():
    for name in DOCUMENTS:
        document = TOP / name
        before = document.read_text(encoding="utf-8")
        after = PLACE.sub(with_table, before)
        if after != before:
            document.write_text(after, encoding="utf-8")
            print("tables renewed: " + name)
    return 0


if __name__ == "__main__":
    sys.exit(main())
