# SPDX-License-Identifier: GPL-3.0-or-later
"""Documents of which a part is made from saved results and the rest written by hand."""

import re


def table(header, rows) -> str:
    """A Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


def filled(text: str, name: str, content: str) -> str:
    """The text with `content` between the markers of this name: <!-- name --> and <!-- end of name -->."""
    pattern = re.compile(rf"(<!-- {name} -->\n).*?(<!-- end of {name} -->)", re.DOTALL)
    if not pattern.search(text):
        raise SystemExit(f"the document has no place for {name}")
    return pattern.sub(lambda match: f"{match[1]}{content}\n{match[2]}", text)
