# SPDX-License-Identifier: Apache-2.0
"""Pytest hooks that collect launch test files."""

from __future__ import annotations

from pathlib import Path
import re
from typing import Optional, TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from launch_testing.pytest.launch_test_module import LaunchTestModule

_MARKER = 'launch_test'


def pytest_configure(config: pytest.Config) -> None:
    """
    Register the marker `launch_test`.

    Parameters
    ----------
    config
        The configuration of the pytest run.

    """
    config.addinivalue_line(
        'markers',
        f'{_MARKER}: on generate_test_description(): launches it and runs the tests of the file',
    )


def pytest_addoption(parser: pytest.Parser) -> None:
    """
    Add the option `--launch-args` for the arguments of launch descriptions.

    Parameters
    ----------
    parser
        The command line parser of pytest.

    """
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
    """
    Collect a file as a launch test if it mentions the marker.

    Parameters
    ----------
    module_path
        The file.
    parent
        The collector of its directory.

    Returns
    -------
    LaunchTestModule or None
        None leaves the file to other plugins.

    """
    if not mentions(module_path, _MARKER):
        return None
    from launch_testing.pytest.launch_test_module import LaunchTestModule

    module: LaunchTestModule = LaunchTestModule.from_parent(parent, path=module_path)
    return module


def mentions(path: Path, marker: str) -> bool:
    """
    Whether the text of a file contains a marker; nothing is imported.

    Parameters
    ----------
    path
        The Python file.
    marker
        The name of the marker, which follows `mark.` in the file.

    """
    return re.search(rb'\bmark\.%s\b' % marker.encode(), path.read_bytes()) is not None
