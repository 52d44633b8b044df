# SPDX-License-Identifier: Apache-2.0
"""Which version of the code has done a run: that of everything that can change its result."""

from __future__ import annotations

from collections.abc import Iterator
import hashlib
from importlib import metadata, util
from pathlib import Path

from ament_index_python.packages import get_package_share_directory

PACKAGES = ('humanoid_control', 'humanoid_description', 'humanoid_simulation')
LIBRARIES = ('mujoco', 'numpy')
_DATA = {'humanoid_description': ('config', 'urdf'), 'humanoid_simulation': ('config',)}
_SWEEP, _SWEEP_PARTS = 'sweep', ('conditions.py', 'walk.py')
"""How runs are chosen and reported does not change them."""


def code_version() -> str:
    """
    Compute the version of the code that does runs.

    Returns
    -------
    str
        The version of this package, and 12 digits of a digest: of the Python files of the walk,
        the model and the simulator, of the model and of the versions of MuJoCo and NumPy. Any
        change of them makes another version.

    """
    found = hashlib.sha256()
    for name in LIBRARIES:
        found.update(f'{name} {_installed(name)}\n'.encode())
    for name, path in sorted(_files()):
        found.update(f'{name} {hashlib.sha256(path.read_bytes()).hexdigest()}\n'.encode())
    return f'{_installed("humanoid_simulation")}+{found.hexdigest()[:12]}'


def _installed(name: str) -> str:
    """Return the version of a distribution, or that of its module if it is not known."""
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        module = util.find_spec(name)
        return '' if module is None else str(getattr(__import__(name), '__version__', ''))


def _files() -> Iterator[tuple[str, Path]]:
    """Yield all files that count, with a name that is the same wherever they are installed."""
    for package in PACKAGES:
        spec = util.find_spec(package)
        assert spec is not None and spec.submodule_search_locations is not None
        for folder in map(Path, spec.submodule_search_locations):
            for path in folder.rglob('*.py'):
                inside = path.relative_to(folder)
                if inside.parts[0] != _SWEEP or path.name in _SWEEP_PARTS:
                    yield f'{package}/{inside}', path
    for package, folders in _DATA.items():
        for share in (Path(get_package_share_directory(package), each) for each in folders):
            for path in share.rglob('*'):
                if path.is_file():
                    yield f'{package}/{share.name}/{path.relative_to(share)}', path
