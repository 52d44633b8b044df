# SPDX-License-Identifier: Apache-2.0
"""There are cases for each section of the specification."""

from __future__ import annotations

import ast
from pathlib import Path
import re

FILES = sorted(Path(__file__).parent.glob('test_launch_cases_3_*.py'))
SECTIONS = [f'3.{number}' for number in range(1, 17)]


def _titles(file: Path) -> list[str]:
    """Return the first line of what each test of a file says about itself."""
    tree = ast.parse(file.read_text(encoding='utf-8'))
    tests = [each for each in tree.body if isinstance(each, ast.FunctionDef)]
    return [(ast.get_docstring(each) or '') for each in tests if each.name.startswith('test_')]


def test_each_section_has_cases() -> None:
    """Sections 3.1 to 3.16 have a file each, with several cases."""
    counts = dict.fromkeys(SECTIONS, 0)
    for file in FILES:
        for title in _titles(file):
            counts[title.split()[0]] += 1
    assert min(counts.values()) >= 5, counts


def test_each_case_says_what_holds() -> None:
    """The title of a case is a sentence behind the section of its file."""
    for file in FILES:
        section = '.'.join(str(int(number)) for number in file.stem.split('_')[3:5])
        for title in _titles(file):
            assert re.fullmatch(rf'{re.escape(section)} [\w$-].*[.)]', title), (file.name, title)
