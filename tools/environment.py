# SPDX-License-Identifier: GPL-3.0-or-later
"""Make one of the development environments in .env/, if it is not there yet.

    python3 tools/environment.py blender-5.2 | blender-4.5 | lint

Afterwards .env/NAME/bin/python is an interpreter with all of tools/requirements-NAME.txt. An environment is
made again when its requirements change or an earlier attempt was interrupted. The CPython it needs is looked
for on PATH and where pyenv, uv and others keep theirs; failing that, uv fetches one into .env/. Whatever is
missing on the machine is named, with the command that installs it.

This script runs before anything is installed: standard library only, Python 3.9 or later.
"""

import glob
import hashlib
import os
import platform
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ENVIRONMENTS = ROOT / ".env"
FETCHED_INTERPRETERS = ENVIRONMENTS / "python"

# Environment -> the version of CPython it needs. Each bpy is built for exactly one.
PYTHON_VERSIONS = {"blender-5.2": "3.13", "blender-4.5": "3.11", "lint": "3.13"}

UV_REQUIREMENT = "uv>=0.5"

# Run by a candidate interpreter: fails unless it is one that bpy supports and that can make an environment.
# Prints its version and its own path, because a candidate may be a shim that forwards to the real one.
INTERPRETER_PROBE = """
import ctypes, ensurepip, ssl, sys, sysconfig, venv
free_threaded = sysconfig.get_config_var("Py_GIL_DISABLED")
if sys.implementation.name != "cpython" or free_threaded or sys.maxsize < 2**32:
    sys.exit(1)
print("%d.%d" % sys.version_info[:2])
print(sys.executable)
"""

# Shared libraries that bpy links to on Linux and pip does not bring -> package names for apt and for dnf.
SYSTEM_LIBRARIES = {
    "libGL.so.1": ("libgl1", "libglvnd-glx"),
    "libICE.so.6": ("libice6", "libICE"),
    "libSM.so.6": ("libsm6", "libSM"),
    "libX11.so.6": ("libx11-6", "libX11"),
    "libXext.so.6": ("libxext6", "libXext"),
    "libXfixes.so.3": ("libxfixes3", "libXfixes"),
    "libXi.so.6": ("libxi6", "libXi"),
    "libXrender.so.1": ("libxrender1", "libXrender"),
    "libstdc++.so.6": ("libstdc++6", "libstdc++"),
    "libxkbcommon.so.0": ("libxkbcommon0", "libxkbcommon"),
}

# Run by an environment's interpreter: prints each of its arguments that the system cannot load.
LIBRARY_PROBE = """
import ctypes, sys
for name in sys.argv[1:]:
    try:
        ctypes.CDLL(name)
    except OSError:
        print(name)
"""

# Run by an environment's interpreter: succeeds if EEVEE will find a driver, on a display or without one.
EGL_PROBE = """
import ctypes, sys
SURFACELESS = 0x31DD  # EGL_PLATFORM_SURFACELESS_MESA
egl = ctypes.CDLL("libEGL.so.1")
egl.eglGetDisplay.restype = egl.eglGetPlatformDisplay.restype = ctypes.c_void_p
displays = egl.eglGetDisplay(None), egl.eglGetPlatformDisplay(SURFACELESS, None, None)
sys.exit(not any(egl.eglInitialize(ctypes.c_void_p(display), None, None) for display in displays))
"""

# os._exit, because bpy 4.5 can hang while the interpreter shuts down.
IMPORT_PROBE = "import bpy, os; os._exit(0)"


class SetupError(Exception):
    """Something is missing; the text says what and how to get it."""


def say(message):
    print(message, file=sys.stderr, flush=True)


# ---------------------------------------------------------------------------------- interpreters


def interpreter_candidates(version):
    """Where a CPython of this version may be, likeliest first; not all of them exist, or run."""
    home = Path.home()
    data_home = os.environ.get("XDG_DATA_HOME") or home / ".local/share"
    pyenv = os.environ.get("PYENV_ROOT") or home / ".pyenv"
    uv = os.environ.get("UV_PYTHON_INSTALL_DIR") or f"{data_home}/uv/python"

    search_path = [folder for folder in os.environ.get("PATH", "").split(os.pathsep) if folder]
    for name in (f"python{version}", "python3"):
        yield from (f"{folder}/{name}" for folder in search_path)
    for pattern in (
        f"{FETCHED_INTERPRETERS}/cpython-{version}.*/bin",
        f"{pyenv}/versions/{version}.*/bin",
        f"{uv}/cpython-{version}.*/bin",
        f"{data_home}/mise/installs/python/{version}.*/bin",
        f"{home}/.asdf/installs/python/{version}.*/bin",
        f"{home}/.local/bin",
        "/usr/local/bin",
        "/usr/bin",
        f"/opt/homebrew/opt/python@{version}/bin",
        f"/usr/local/opt/python@{version}/bin",
        f"/Library/Frameworks/Python.framework/Versions/{version}/bin",
    ):
        for folder in sorted(glob.glob(pattern), key=_numbers, reverse=True):
            yield f"{folder}/python{version}"


def _numbers(path):
    """A sort key that puts 3.13.10 after 3.13.9."""
    return [int(digits) for digits in re.findall(r"\d+", path)]


def working_interpreter(candidate, version):
    """The real path of the interpreter behind `candidate`, or None unless it runs and is of this version."""
    if not os.access(candidate, os.X_OK):
        return None
    try:
        probe = subprocess.run(
            [candidate, "-c", INTERPRETER_PROBE], capture_output=True, text=True, timeout=60, check=True
        )
    except (OSError, subprocess.SubprocessError):
        return None  # a shim of a version manager for a version that is not selected, a broken link, ...
    found_version, executable = probe.stdout.splitlines()
    return executable if found_version == version else None


def find_interpreter(version):
    """A working CPython of this version, or None."""
    for candidate in dict.fromkeys(interpreter_candidates(version)):
        executable = working_interpreter(candidate, version)
        if executable:
            return executable
    return None


def uv_command():
    """uv where it is installed, or else installed from PyPI into its own environment."""
    for candidate in (shutil.which("uv"), Path.home() / ".local/bin/uv", Path.home() / ".cargo/bin/uv"):
        if candidate and os.access(candidate, os.X_OK):
            return str(candidate)
    folder = ENVIRONMENTS / "uv"
    say("Installing uv from PyPI")
    subprocess.run([sys.executable, "-m", "venv", "--clear", folder], check=True)
    subprocess.run([folder / "bin/python", "-m", "pip", "install", "--quiet", UV_REQUIREMENT], check=True)
    return str(folder / "bin/uv")


def fetch_interpreter(version):
    """Have uv fetch a CPython of this version into .env/; nothing outside the checkout is touched."""
    say(f"No CPython {version} found here; fetching one with uv")
    settings = {"UV_PYTHON_INSTALL_DIR": str(FETCHED_INTERPRETERS), "UV_PYTHON_INSTALL_BIN": "0"}
    try:
        command = [uv_command(), "python", "install", version]
        subprocess.run(command, check=True, env={**os.environ, **settings})
    except (OSError, subprocess.SubprocessError) as error:
        say(f"uv could not fetch it: {error}")
    executable = find_interpreter(version)
    if executable is None:
        raise SetupError(
            f"CPython {version} (with venv) is missing: it is not on PATH, nor where pyenv, uv, mise, asdf,\n"
            "Homebrew or the system keep theirs, and uv could not fetch it. Install it with one of\n"
            f"    pyenv install {version}\n"
            f"    uv python install {version}\n"
            f"    apt install python{version} python{version}-venv    (Debian, Ubuntu)\n"
            f"    dnf install python{version}                    (Fedora)\n"
            f"    brew install python@{version}                  (macOS)\n"
            "and run the same command again."
        )
    return executable


# ---------------------------------------------------------------------------------- system libraries


def check_system_libraries(python):
    """Before hundreds of megabytes are downloaded: can this machine load what bpy links to?"""
    if platform.system() != "Linux":
        return
    names = sorted(SYSTEM_LIBRARIES)
    probe = subprocess.run([python, "-c", LIBRARY_PROBE, *names], capture_output=True, text=True, check=True)
    missing = probe.stdout.split()
    if missing:
        apt, dnf = (" ".join(SYSTEM_LIBRARIES[name][manager] for name in missing) for manager in (0, 1))
        raise SetupError(
            f"Blender needs system libraries that this machine lacks: {', '.join(missing)}. Install them with\n"
            f"    apt install {apt}    (Debian, Ubuntu)\n"
            f"    dnf install {dnf}    (Fedora)\n"
            "and run the same command again."
        )


def warn_without_eevee(python):
    """Cycles needs no graphics driver. EEVEE does, even without a display."""
    if platform.system() != "Linux":
        return
    if subprocess.run([python, "-c", EGL_PROBE], capture_output=True, check=False).returncode:
        say(
            "Warning: EEVEE finds no EGL driver here; the tests that use it will fail. Install one with\n"
            "    apt install libegl1 libgl1-mesa-dri               (Debian, Ubuntu)\n"
            "    dnf install libglvnd-egl mesa-dri-drivers         (Fedora)"
        )


# ---------------------------------------------------------------------------------- environments


def requirements_text(path):
    """The text of a requirements file and of those it includes."""
    text = path.read_text(encoding="utf-8")
    included = re.findall(r"^-r\s+(\S+)", text, flags=re.MULTILINE)
    return text + "".join(requirements_text(path.parent / name) for name in included)


def is_complete(folder, version, fingerprint):
    """Was this environment finished, from these requirements, and does its interpreter still run?"""
    stamp = folder / "complete"
    if not stamp.exists() or stamp.read_text(encoding="utf-8") != fingerprint:
        return False
    return working_interpreter(folder / "bin/python", version) is not None


def build(folder, interpreter, requirements, fingerprint):
    """Make the environment from nothing. The stamp comes last, so a build that was interrupted is not used."""
    say(f"Making {folder.relative_to(ROOT)} with {interpreter}")
    if folder.exists():
        shutil.rmtree(folder)
    python = folder / "bin/python"
    subprocess.run([interpreter, "-m", "venv", folder], check=True)
    try:
        subprocess.run([python, "-m", "pip", "install", "--requirement", requirements], check=True)
    except subprocess.CalledProcessError:
        raise SetupError(
            f"pip could not install {requirements.relative_to(ROOT)}; its messages are above. It must be able to\n"
            "reach PyPI. bpy exists for Linux (x86-64, glibc 2.28 or later), macOS and Windows only."
        ) from None
    if "bpy" in requirements.read_text(encoding="utf-8"):
        check_bpy(python)
    (folder / "complete").write_text(fingerprint, encoding="utf-8")


def check_bpy(python):
    """Last of all, is this Blender usable?"""
    probe = subprocess.run([python, "-c", IMPORT_PROBE], capture_output=True, text=True, check=False)
    if probe.returncode:
        raise SetupError(
            f"bpy is installed, but `import bpy` fails:\n{probe.stderr.strip()}\n"
            "If it names a lib*.so, install the package of your system that has this file."
        )


def ensure(name):
    """Make environment `name` unless it is complete. Returns its interpreter."""
    version = PYTHON_VERSIONS[name]
    folder = ENVIRONMENTS / name
    requirements = ROOT / "tools" / f"requirements-{name}.txt"
    fingerprint = hashlib.sha256(f"{version}\n{requirements_text(requirements)}".encode()).hexdigest()
    complete = is_complete(folder, version, fingerprint)
    python = folder / "bin/python"
    interpreter = python if complete else find_interpreter(version) or fetch_interpreter(version)
    if name.startswith("blender"):
        check_system_libraries(interpreter)
        warn_without_eevee(interpreter)
    if not complete:
        build(folder, interpreter, requirements, fingerprint)
    return python


def main(arguments):
    if len(arguments) != 1 or arguments[0] not in PYTHON_VERSIONS:
        say(f"usage: python3 tools/environment.py {'|'.join(PYTHON_VERSIONS)}")
        return 2
    try:
        ensure(arguments[0])
    except SetupError as error:
        say(f"\n{error}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
