# SPDX-License-Identifier: Apache-2.0
"""The command `ament_copyright`, and what it reads in the head of a source file."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
import os
from pathlib import Path
import re
import sys

SOURCES = {'.py', '.c', '.cc', '.cpp', '.cxx', '.h', '.hh', '.hpp', '.hxx'}
COMMENT = re.compile(r'^\s*(#|//|/\*|\*|"""|\'\'\'|$)')
HOLDER = re.compile(
    r'(?:copyright\s*(?:\(c\)|©)?\s*[:,]?\s*\d{4}|SPDX-FileCopyrightText:)', re.IGNORECASE
)
LICENCE = re.compile(
    r'SPDX-License-Identifier:|permission is hereby granted|redistribution and use|licen[sc]e',
    re.IGNORECASE,
)


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


@dataclass(frozen=True)
class Header:
    """Whether a file's head names a holder of the copyright and a licence."""

    has_holder: bool
    has_licence: bool

    @property
    def defect(self) -> str:
        """Say what is missing; empty where nothing is."""
        if not self.has_holder:
            return 'could not find copyright notice'
        return '' if self.has_licence else 'could not find the licence that the file is under'


def read_header(text: str) -> Header:
    """
    Read the comments before the first statement of a source text.

    Parameters
    ----------
    text
        The source text, in Python, C or C++.

    """
    head = []
    for line in text.splitlines():
        if not COMMENT.match(line):
            break
        head.append(line)
    comments = '\n'.join(head)
    return Header(bool(HOLDER.search(comments)), bool(LICENCE.search(comments)))


if __name__ == '__main__':
    sys.exit(main())
