# SPDX-License-Identifier: GPL-3.0-or-later
"""Write the numbers of docs/effects.md from what `effects --output` has saved.

    python -m tools.effects_document out/effects.json

What stands between the markers of the document is replaced; the text around them is written by hand.
"""

import json
import sys
from pathlib import Path

from .documents import filled, table

ROOT = Path(__file__).resolve().parent.parent
DOCUMENT = ROOT / "docs" / "effects.md"


def _times(milliseconds, ratio):
    off_over_absent = f"{ratio['value']:.3f} ± {ratio['error']:.3f}"
    return [f"{milliseconds['on']:.1f}", f"{milliseconds['off']:.1f}", off_over_absent]


def table_of(saved) -> str:
    """The table, as Markdown, and what it was measured on."""
    engines = list(saved["effects"][0]["render_ms"])
    header = ["effect", "frame: on, ms", "off", "off / absent", "memory: on, MB", "off"]
    for engine in engines:
        header += [f"picture in {engine}: on, ms", "off", "off / absent"]
    rows = []
    for each in saved["effects"]:
        memory = each["memory_bytes"]
        row = [each["label"], *_times(each["frame_ms"], each["frame_off_over_absent"])]
        row += [f"{memory['on'] / 1e6:.1f}", f"{memory['off'] / 1e6:.1f}"]
        for engine in engines:
            row += _times(each["render_ms"][engine], each["render_off_over_absent"][engine])
        rows.append(row)
    machine = saved["machine"]
    lines = [
        table(header, rows),
        "",
        f"Measured on {machine['processor']}, {machine['cores']} cores, NumPy {machine['numpy']}, BLAS "
        f"{machine['blas']}, Blender {machine['blender']}, with {saved['vertices']} vertices.",
        saved["disturbance"],
    ]
    return "\n".join(lines)


def main(saved_path: Path) -> None:
    """Fill the document."""
    content = table_of(json.loads(saved_path.read_text(encoding="utf-8")))
    DOCUMENT.write_text(filled(DOCUMENT.read_text(encoding="utf-8"), "table", content), encoding="utf-8")
    print(f"wrote {DOCUMENT.relative_to(ROOT)}")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
