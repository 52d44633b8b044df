# SPDX-License-Identifier: Apache-2.0
"""Looking up entry points."""

from __future__ import annotations

from pathlib import Path
import subprocess
import sys

import pytest
from ros_environment.entry_points import entry_points_of


def test_group_that_is_offered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The entry points of a group are those of all distributions on the path of modules."""
    folder = tmp_path / 'thing-1.0.dist-info'
    folder.mkdir()
    (folder / 'METADATA').write_text('Name: thing\nVersion: 1.0\n')
    (folder / 'entry_points.txt').write_text('[some.group]\na = module:A\nb = module:B\n')
    monkeypatch.syspath_prepend(str(tmp_path))
    found = {point.name: point.value for point in entry_points_of('some.group')}
    assert found == {'a': 'module:A', 'b': 'module:B'}


def test_group_that_nobody_offers() -> None:
    """Where there is nothing to find, nothing is loaded to find it with."""
    code = (
        'import sys; from ros_environment.entry_points import entry_points_of;'
        'sys.path.append("/no/such/folder");'
        'assert entry_points_of("no.such.group") == [];'
        'sys.exit("importlib.metadata" in sys.modules)'
    )
    result = subprocess.run([sys.executable, '-c', code], stderr=subprocess.PIPE, text=True)
    assert (result.returncode, result.stderr) == (0, '')
