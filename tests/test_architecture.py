# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules that keep the parts of the package apart, read from its source."""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "ocean_lod_addon"

# Part of the package -> the parts that it may import. A new part needs a line here.
MAY_IMPORT = {
    "core": {"core"},
    "nodes": {"core", "nodes"},
    "scene": {"core", "nodes", "scene"},
    "ui": {"core", "nodes", "scene", "ui"},
    "cli": {"core", "nodes", "scene", "ui", "cli", "__init__"},
    "__init__": {"scene", "ui", "cli"},
    "__main__": {"cli"},
}

BLENDER_MODULES = {"bpy", "bmesh", "mathutils", "bpy_extras", "gpu", "gpu_extras", "blf"}

# Parts that load without Blender: there, whatever leads to bpy is imported inside the function that needs it.
LOADS_WITHOUT_BLENDER = {"core", "cli", "__init__", "__main__"}
NEEDS_BLENDER = {"nodes", "scene", "ui"} | BLENDER_MODULES

# Modules that one file may import where they are installed: it says what is missing where they are not.
OPTIONAL = {
    "ocean_lod_addon/cli/sea_plot.py": {"matplotlib"},
    "ocean_lod_addon/cli/slopes_plot.py": {"matplotlib"},
    "ocean_lod_addon/cli/bench/plot.py": {"matplotlib"},
    "ocean_lod_addon/cli/cost/plot.py": {"matplotlib"},
}

FORBIDDEN_CALLS = {"eval", "exec", "compile", "__import__"}
FORBIDDEN_MODULES = {"pickle", "marshal", "shelve", "dill"}

LOCAL_PATH = re.compile(r"(?<![\w.:])/(home|root|Users|tmp|work|mnt|srv|var|opt|usr)/|\b[A-Z]:\\\\|\.\./")

SPDX = "# SPDX-License-Identifier: GPL-3.0-or-later"

MODULES = sorted(PACKAGE.rglob("*.py"))


def name_of(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def part_of(path: Path) -> str:
    """The part of the package that a module belongs to: its first folder, or its own name at the top."""
    return path.relative_to(PACKAGE).with_suffix("").parts[0]


def tree_of(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"), filename=str(path))


def part_named(parts: list[str], level: int, path: Path) -> str:
    """The part of the package that a relative import of `level` dots leads to."""
    folder = path.parents[level - 1]
    assert folder == PACKAGE or PACKAGE in folder.parents, f"{name_of(path)} imports from outside the package"
    part = (*folder.relative_to(PACKAGE).parts, *parts)[0]
    is_module = (PACKAGE / part).is_dir() or (PACKAGE / f"{part}.py").exists()
    return part if is_module else "__init__"  # else a function of the package itself


def imports_of(path: Path, nodes: Iterator[ast.AST]) -> Iterator[tuple[str, bool, int]]:
    """(what is imported, is it inside the package, line): a part for relative imports, else a top-level module."""
    for node in nodes:
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.name.split(".")[0], False, node.lineno
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module.split(".")[0], False, node.lineno
        elif isinstance(node, ast.ImportFrom):
            for alias in node.names:
                parts = [*(node.module or "").split("."), alias.name] if node.module else [alias.name]
                yield part_named(parts, node.level, path), True, node.lineno


def nodes_run_on_import(tree: ast.Module) -> Iterator[ast.AST]:
    """Every node that runs when the module is imported: all but the bodies of functions."""
    pending: list[ast.AST] = [tree]
    while pending:
        node = pending.pop()
        yield node
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            pending.extend(ast.iter_child_nodes(node))


def test_every_part_has_a_rule():
    assert {part_of(path) for path in MODULES} <= set(MAY_IMPORT)


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_imports_point_downward(path: Path):
    allowed = MAY_IMPORT[part_of(path)]
    for imported, inside, line in imports_of(path, ast.walk(tree_of(path))):
        if inside:
            assert imported in allowed, f"line {line}: {part_of(path)} may not import {imported}"


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_run_time_dependencies_are_numpy_and_blender(path: Path):
    allowed = sys.stdlib_module_names | {"numpy"} | OPTIONAL.get(name_of(path), set())
    if part_of(path) != "core":
        allowed |= BLENDER_MODULES
    for imported, inside, line in imports_of(path, ast.walk(tree_of(path))):
        # An installed extension has another name, so an absolute import of the package itself fails too.
        assert inside or imported in allowed, f"line {line}: {imported}"


@pytest.mark.parametrize(
    "path", [path for path in MODULES if part_of(path) in LOADS_WITHOUT_BLENDER], ids=name_of
)
def test_blender_is_imported_inside_functions(path: Path):
    for imported, _, line in imports_of(path, nodes_run_on_import(tree_of(path))):
        assert imported not in NEEDS_BLENDER, f"line {line}: {imported}"


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_no_code_is_made_from_data(path: Path):
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            assert node.func.id not in FORBIDDEN_CALLS, f"line {node.lineno}: {node.func.id}"
        if isinstance(node, ast.keyword):
            assert node.arg != "allow_pickle", f"line {node.value.lineno}: allow_pickle"
    for imported, _, line in imports_of(path, ast.walk(tree_of(path))):
        assert imported not in FORBIDDEN_MODULES, f"line {line}: {imported}"


def test_importing_the_package_and_its_core_loads_no_blender():
    # bpy is installed here, so an import of it would succeed and show in sys.modules.
    core = [".".join(path.relative_to(ROOT).with_suffix("").parts) for path in MODULES if part_of(path) == "core"]
    script = "import importlib, sys\nfor name in sys.argv[1:]: importlib.import_module(name)\n"
    script += "sys.exit('bpy' in sys.modules)"
    command = [sys.executable, "-c", script, "ocean_lod_addon", *core]
    assert subprocess.run(command, cwd=ROOT, check=False).returncode == 0


def own_python_files() -> list[Path]:
    folders = [PACKAGE, ROOT / "tests", ROOT / "tools"]
    return [ROOT / "__init__.py", *sorted(path for folder in folders for path in folder.rglob("*.py"))]


@pytest.mark.parametrize("path", own_python_files(), ids=name_of)
def test_every_file_names_its_licence(path: Path):
    assert path.read_text(encoding="utf-8").split("\n", 1)[0] == SPDX


@pytest.mark.parametrize(
    "path",
    [*MODULES, *sorted((ROOT / "presets").glob("*.json")), ROOT / "README.md", ROOT / "blender_manifest.toml"],
    ids=name_of,
)
def test_no_file_mentions_a_place_on_somebodys_machine(path: Path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        assert not LOCAL_PATH.search(line), f"line {number}: {line}"
