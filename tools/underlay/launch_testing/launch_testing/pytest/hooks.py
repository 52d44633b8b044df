# SPDX-License-Identifier: Apache-2.0
"""Let pytest run launch test files."""

from __future__ import annotations

from pathlib import Path
import re
from typing import Optional, TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from launch_testing.pytest.launch_test_module import LaunchTestModule

_MARKER = 'launch_test'


def pytest_configure(config: pytest.Config) -> None:
    """Register the marker and the option."""
    config.addinivalue_line(
        'markers',
        f'{_MARKER}: on generate_test_description(): launches it and runs the tests of the file',
    )


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option for the arguments of launch descriptions."""
    parser.addoption(
        '--launch-args',
        nargs='+',
        default=[],
        metavar='NAME:=VALUE',
        help='arguments of the launch descriptions of launch tests',
    )


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makemodule(
    module_path: Path,
    parent: pytest.Collector,
) -> Optional[LaunchTestModule]:
    """Collect a file as a launch test if it looks like one."""
    if not mentions(module_path, _MARKER):
        return None
    from launch_testing.pytest.launch_test_module import LaunchTestModule

    module: LaunchTestModule = LaunchTestModule.from_parent(parent, path=module_path)
    return module


def mentions(path: Path, marker: str) -> bool:
    """Return whether a file might be a launch test with this marker; nothing is imported."""
    return re.search(rb'\bmark\.%s\b' % marker.encode(), path.read_bytes()) is not None
