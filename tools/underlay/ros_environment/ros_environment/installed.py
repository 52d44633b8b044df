# SPDX-License-Identifier: Apache-2.0
"""What is installed: prefixes in the environment, packages, executables and launch files."""

from __future__ import annotations

from collections.abc import Iterator
import os
from pathlib import Path

LAUNCH_SUFFIXES = ('launch.py', 'launch.xml', 'launch.yaml', 'launch.yml', '.launch')


def prefixes(variable: str = 'AMENT_PREFIX_PATH') -> list[Path]:
    """Return the existing folders that an environment variable lists."""
    folders = (Path(text) for text in os.environ.get(variable, '').split(os.pathsep) if text)
    return [folder for folder in folders if folder.is_dir()]


def known_packages() -> set[str]:
    """Return the names of all packages that the environment makes available."""
    names: set[str] = set()
    for prefix in prefixes():
        index = prefix / 'share' / 'ament_index' / 'resource_index' / 'packages'
        if index.is_dir():
            names.update(os.listdir(index))
    return names


def built_on_demand(package: str) -> str:
    """Return the sentence on a package that the environment builds on demand, or ''."""
    for prefix in prefixes():
        index = prefix / 'share' / 'ament_index' / 'resource_index' / 'on_demand'
        for path in sorted(index.glob('*')):
            words, _, sentence = path.read_text(encoding='utf-8').partition('\n')
            if any(word in package for word in words.split()):
                return sentence.strip()
    return ''


def is_installed_in(install: Path, package: str) -> bool:
    """Tell if a package was installed below a workspace's install folder, in either layout."""
    marker = Path('share', 'ament_index', 'resource_index', 'packages', package)
    return (install / package / marker).exists() or (install / marker).exists()


def executables(prefix: Path, package: str) -> list[str]:
    """Return the names of a package's executables, sorted."""
    folder = prefix / 'lib' / package
    return sorted(path.name for path in _files(folder) if os.access(path, os.X_OK))


def launch_files(share: Path) -> list[str]:
    """Return the names of the launch files in a package's share folder, sorted."""
    return sorted(path.name for path in _files(share) if path.name.endswith(LAUNCH_SUFFIXES))


def package_of_share_file(path: Path) -> str | None:
    """Return the package in whose share folder a path lies, None if in none that is known."""
    for prefix in prefixes():
        share = prefix / 'share'
        if share in path.parents:
            return path.relative_to(share).parts[0]
    return None


def _files(folder: Path) -> Iterator[Path]:
    for root, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith('.')]
        yield from (Path(root, name) for name in names)
