# SPDX-License-Identifier: GPL-3.0-or-later
"""Write the numbers and figures of docs/accuracy-and-cost.md from what `cost --full` has saved.

    python -m tools.accuracy_document out/cost.json

What stands between the markers of the document is replaced; the text around them is written by hand.
"""

import json
import shutil
import sys
from pathlib import Path

from .documents import filled, table

ROOT = Path(__file__).resolve().parent.parent
DOCUMENT = ROOT / "docs" / "accuracy-and-cost.md"
IMAGES = ROOT / "docs" / "images"


def number(value) -> str:
    """Three digits."""
    return "-" if value is None else "0" if abs(value) < 1e-9 else f"{value:.3g}"


def machine(saved) -> str:
    """What it was measured on."""
    m = saved["machine"]
    return (
        f"Measured on {m['processor']}, {m['cores']} cores, with Python {m['python']}, NumPy {m['numpy']}, BLAS "
        f"{m['blas']}, Blender {m['blender']}. The prices of the cost model were found in "
        f"{saved['probe_seconds']:.1f} s."
    )


def knobs(saved) -> str:
    """One table for each knob."""
    parts = []
    for knob in saved["knobs"]:
        rows = [
            (step["value"], number(step["error"]), number(step["ms"]), "" if step["worth_having"] else "left out")
            for step in knob["steps"]
        ]
        parts += [
            f"### {knob['label']}",
            f"{knob['affects']}. Error: {knob['error_of'][0].lower()}{knob['error_of'][1:]}, in {knob['unit']}, "
            f"against: {knob['reference'][0].lower()}{knob['reference'][1:]}. Time: {knob['time_of']}.",
            table(("step", f"error ({knob['unit']})", "ms", ""), rows),
        ]
    return "\n\n".join(parts)


def misprints(saved) -> str:
    """The printed equations."""
    rows = [
        (m["equation"], m["printed"], m["corrected"], m["error_of"], f"{number(m['error'])} {m['unit']}")
        for m in saved["misprints"]
    ]
    return table(("equation", "as printed", "right", "what would be off", "by"), rows)


def configurations(saved) -> str:
    """Draft to Reference."""
    rows = []
    for each in saved["configurations"]:
        picture = each["picture"] or {}
        rows.append(
            (
                each["label"],
                each["vertices"],
                number(each["vertices_per_wavelength"]),
                number(each["reach"]),
                each["ripples"],
                each["foam_instants"],
                number(each["height_error_mm"]),
                number(each["ripples_wrong_percent"]),
                number(picture.get("mean_steps")),
                number(picture.get("percentile_95_steps")),
                number(each["predicted_ms"]),
                number(each["measured_ms"]),
            )
        )
    header = (
        "quality",
        "vertices",
        "per wavelength",
        "reach",
        "ripples",
        "instants of foam",
        "height, mm",
        "ripples wrong, %",
        "picture, steps of 1/255, mean",
        "95 % below",
        "predicted ms",
        "measured ms",
    )
    return table(header, rows)


def convergence(saved) -> str:
    """Whether the Reference has converged."""
    if saved["pictures"] is None:
        return "No pictures were rendered."
    twice = saved["pictures"]["reference_from_twice"]
    return (
        f"Twice of everything changes the Reference's picture by {number(twice['mean_steps'])} steps of 1/255 in "
        f"the mean, by less than {number(twice['percentile_95_steps'])} in 95 % and "
        f"{number(twice['percentile_99_steps'])} in 99 % of its values."
    )


def budgets(saved) -> str:
    """What budgets buy."""
    rows = [
        (f"{each['budget_ms']:g}", number(each["predicted_ms"]), number(each["median_ms"]), each["choice"])
        for each in saved["budgets"]
    ]
    return table(("budget, ms", "predicted", "median of 50 frames", "the choice"), rows)


def predictions(saved) -> str:
    """Predicted beside measured, through Blender with this NumPy's BLAS, and by einsum."""
    with_blas, without = saved["predictions"], saved["predictions_without_blas"]
    if with_blas is None:
        return "Not measured."
    rows = [
        (
            a["configuration"],
            number(a["predicted_ms"]),
            number(a["measured_ms"]),
            f"{100 * a['off_by']:+.0f} %",
            number(b["predicted_ms"]),
            number(b["measured_ms"]),
            f"{100 * b['off_by']:+.0f} %",
        )
        for a, b in zip(with_blas, without, strict=True)
    ]
    header = (
        "configuration",
        "predicted ms",
        "measured",
        "off by",
        "without BLAS: predicted",
        "measured",
        "off by",
    )
    counts = [sum(abs(each["off_by"]) <= 0.2 for each in results) for results in (with_blas, without)]
    return (
        table(header, rows) + f"\n\nWithin 20 %: {counts[0]} of {len(with_blas)} with BLAS, through Blender; "
        f"{counts[1]} of {len(without)} without, in NumPy alone."
    )


PARTS = (machine, knobs, misprints, configurations, convergence, budgets, predictions)


def made_from(saved: dict, text: str) -> str:
    """The document with every marked part made anew."""
    for part in PARTS:
        text = filled(text, part.__name__, part(saved))
    return text


def main(saved_path: Path) -> None:
    """Fill the document and copy the figures that were saved beside the results."""
    saved = json.loads(saved_path.read_text(encoding="utf-8"))
    DOCUMENT.write_text(made_from(saved, DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8")
    for name in ("knobs", "front"):
        figure = saved_path.with_name(f"{saved_path.stem}_{name}.png")
        if figure.exists():
            shutil.copyfile(figure, IMAGES / f"cost_{name}.png")
    print(f"wrote {DOCUMENT.relative_to(ROOT)}")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
