# SPDX-License-Identifier: Apache-2.0
"""The sources of the underlay follow the style of ROS, like any package's."""

from __future__ import annotations

from pathlib import Path
import subprocess

import pytest

UNDERLAY = Path(__file__).resolve().parents[1] / 'underlay'
PACKAGES = sorted(path.parent.name for path in UNDERLAY.glob('*/setup.py'))


@pytest.mark.parametrize('linter', ['ament_flake8', 'ament_pep257'])
@pytest.mark.parametrize('package', PACKAGES)
def test_style(package: str, linter: str) -> None:
    """The linter of ROS has no objection to a package."""
    result = subprocess.run([linter, str(UNDERLAY / package)], capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr
