# SPDX-License-Identifier: Apache-2.0
"""The command `ament_copyright` and the function that packages' tests call."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
import os
from pathlib import Path
import sys

from ament_copyright.header import read_header

SOURCES = {'.py', '.c', '.cc', '.cpp', '.cxx', '.h', '.hh', '.hpp', '.hxx'}


def main(argv: Sequence[str] | None = None) -> int:
    """
    Check the copyright notices of files and folders, and print what is missing.

    Parameters
    ----------
    argv
        The arguments without the program's name; by default those of the process.

    Returns
    -------
    int
        1 if a notice or a path is missing, else 0.

    """
    options = _parse(argv)
    missing = [path for path in options.paths if not Path(path).exists()]
    if missing:
        print(f"'{missing[0]}' does not exist: name files or folders to check", file=sys.stderr)
        return 1
    files = [path for given in options.paths for path in find_sources(Path(given))]
    files = [path for path in files if not _excluded(path, options.exclude)]
    defects = [(path, _defect(path)) for path in files]
    errors = [f'{path}: {defect}' for path, defect in defects if defect]
    for line in errors:
        print(line, file=sys.stderr)
    if errors:
        print(f'{len(errors)} errors, checked {len(files)} files')
        return 1
    print(f'No problems found, checked {len(files)} files')
    return 0


def _parse(argv: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description='Check that source files say who holds their copyright, and their licence.'
    )
    parser.add_argument('paths', nargs='*', default=[os.curdir], help='files or folders')
    parser.add_argument('--exclude', nargs='+', default=[], help='files to leave out')
    return parser.parse_args(argv)


def find_sources(path: Path) -> Iterator[Path]:
    """
    Find the source files at or below a path.

    Folders whose name begins with a dot or an underscore are left out, and those that are marked
    by AMENT_IGNORE or COLCON_IGNORE.

    Parameters
    ----------
    path
        A folder, or a file, which counts whatever its extension is.

    Yields
    ------
    Path
        The files; those of a folder sorted by name.

    """
    if path.is_file():
        yield path
        return
    for base, folders, files in os.walk(path):
        if 'AMENT_IGNORE' in files or 'COLCON_IGNORE' in files:
            folders.clear()
            continue
        folders[:] = sorted(name for name in folders if name[0] not in '._')
        yield from (Path(base, name) for name in sorted(files) if Path(name).suffix in SOURCES)


def _excluded(path: Path, patterns: Sequence[str]) -> bool:
    return any(path.match(pattern) for pattern in patterns)


def _defect(path: Path) -> str:
    text = path.read_text(encoding='utf-8', errors='replace')
    return read_header(text).defect if text.strip() else ''


if __name__ == '__main__':
    sys.exit(main())
