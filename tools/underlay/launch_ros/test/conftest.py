# SPDX-License-Identifier: Apache-2.0
"""What the tests of this package share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import os
from pathlib import Path
import shlex
from typing import Any

from launch import LaunchContext, LaunchDescription, LaunchService
import launch.logging
from launch.utilities import visit_all_entities_and_collect_futures
from launch_ros.actions import Node
import pytest

Prefix = Callable[..., Path]


@pytest.fixture(autouse=True)
def _own_state(tmp_path: Path) -> Iterator[None]:
    """Give each test a log folder, a log and an environment of its own."""
    before = dict(os.environ)
    os.environ['ROS_LOG_DIR'] = str(tmp_path / 'log')
    launch.logging.reset()
    yield
    launch.logging.reset()
    os.environ.clear()
    os.environ.update(before)


@pytest.fixture
def context() -> LaunchContext:
    """Return a context that no service runs."""
    return LaunchContext()


@pytest.fixture
def words(context: LaunchContext) -> Callable[..., list[str]]:
    """Return a function that gives the words of a node's command line behind the program."""

    def of_node(*before: Any, **kwargs: Any) -> list[str]:
        for entity in before:
            visit_all_entities_and_collect_futures(entity, context)
        node = Node(executable='/bin/true', **kwargs)
        node.prepare(context)
        return list(node.cmd[1:])

    return of_node


@pytest.fixture
def run(capfd: pytest.CaptureFixture[str]) -> Callable[..., Any]:
    """Return a function that launches some entities and gives the status and the text."""

    def launch_entities(*entities: Any) -> Any:
        service = LaunchService(noninteractive=True)
        service.include_launch_description(LaunchDescription(entities))
        status = service.run()
        return status, capfd.readouterr().out

    return launch_entities


@pytest.fixture
def prefix(tmp_path: Path) -> Prefix:
    """Return a function that installs a package, with executables that print their words."""

    def install(package: str, *executables: str) -> Path:
        root = tmp_path / 'prefix'
        index = root / 'share/ament_index/resource_index/packages'
        index.mkdir(parents=True, exist_ok=True)
        (index / package).touch()
        (root / 'share' / package).mkdir(exist_ok=True)
        for name in executables:
            path = root / 'lib' / package / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f'#!/bin/sh\necho {shlex.quote(name)} "$@"\n')
            path.chmod(0o755)
        os.environ['AMENT_PREFIX_PATH'] = str(root)
        return root

    return install


@pytest.fixture
def own_domain() -> Iterator[None]:
    """Keep the nodes of a test apart from all others."""
    from domain_coordinator import domain_id

    with domain_id() as number:
        os.environ['ROS_DOMAIN_ID'] = str(number)
        os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
        yield
