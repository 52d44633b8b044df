# SPDX-License-Identifier: Apache-2.0
"""What the tests of this package share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import os
from pathlib import Path
from typing import Any

from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
import launch.logging
import pytest


@pytest.fixture(autouse=True)
def _own_state(tmp_path: Path) -> Iterator[None]:
    """Give each test a log folder, a log and an environment of its own."""
    before = dict(os.environ)
    os.environ['ROS_LOG_DIR'] = str(tmp_path / 'log')
    os.environ.pop('OVERRIDE_LAUNCH_PROCESS_OUTPUT', None)
    launch.logging.reset()
    yield
    launch.logging.reset()
    os.environ.clear()
    os.environ.update(before)


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str, str], str]:
    """Return a function that writes a file and returns its path."""

    def write_file(name: str, text: str) -> str:
        path = tmp_path / name
        path.write_text(text, encoding='utf-8')
        return str(path)

    return write_file


@pytest.fixture
def run(
    write: Callable[[str, str], str],
    capfd: pytest.CaptureFixture[str],
) -> Callable[..., list[str]]:
    """Return a function that launches the content of a file and gives the lines it writes."""

    def launch_content(content: str, name: str = 'test.launch.xml', **arguments: Any) -> Any:
        path = write(name, content)
        service = LaunchService(noninteractive=True)
        include = IncludeLaunchDescription(path, launch_arguments=arguments.items())
        service.include_launch_description(LaunchDescription([include]))
        service.run()
        return capfd.readouterr().out.splitlines()[2:]

    return launch_content
