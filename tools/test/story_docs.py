# SPDX-License-Identifier: Apache-2.0
"""Does what the longer pages of the documentation say: `make stories`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from docs_reader import do_page, LONG, PAGES
import pytest

RUNS = [page for page in PAGES if page.stem in LONG]


def test_all_are_there() -> None:
    """Each name is that of a page."""
    assert sorted(page.stem for page in RUNS) == sorted(LONG)


@pytest.mark.timeout(600)
@pytest.mark.parametrize('page', RUNS, ids=lambda page: page.stem)
def test_a_page_works_as_written(
    page: Path, root: Path, tmp_path: Path, start: Callable[..., Any], own_domain: int
) -> None:
    """Everything that the page tells its reader to do works, and prints what it says."""
    do_page(page, root, tmp_path, start)
