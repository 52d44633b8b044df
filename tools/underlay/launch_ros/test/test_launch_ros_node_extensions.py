# SPDX-License-Identifier: Apache-2.0
"""What other packages add to the command lines of nodes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from launch.substitutions import LocalSubstitution
from launch_ros.actions import _ros_arguments
from launch_ros.actions.node import NodeActionExtension
import pytest

Words = Callable[..., list[str]]


class Enclave(NodeActionExtension):
    """Adds an enclave that has the name of the node."""

    def prepare_for_execute(self, context: Any, ros_specific_arguments: Any, node_action: Any):
        """Return the option, whose value is one of the arguments for ROS."""
        arguments = {**ros_specific_arguments, 'enclave': node_action.node_name}
        return ['--enclave', LocalSubstitution("ros_specific_arguments['enclave']")], arguments


class Renaming(NodeActionExtension):
    """Gives the node another name."""

    def prepare_for_execute(self, context: Any, ros_specific_arguments: Any, node_action: Any):
        """Return nothing to add, and another name."""
        return [], {**ros_specific_arguments, 'name': '__node:=other'}


@pytest.fixture(autouse=True)
def _fresh_extensions() -> Iterator[None]:
    """Look the extensions up anew."""
    _ros_arguments.extensions.cache_clear()
    yield
    _ros_arguments.extensions.cache_clear()


def _install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *lines: str) -> None:
    folder = tmp_path / 'thing-1.0.dist-info'
    folder.mkdir()
    (folder / 'METADATA').write_text('Name: thing\nVersion: 1.0\n')
    text = '\n'.join(['[launch_ros.node_action]', *lines])
    (folder / 'entry_points.txt').write_text(text)
    monkeypatch.syspath_prepend(str(tmp_path))
    module = Path(__file__).read_text(encoding='utf-8')
    (tmp_path / 'node_extensions_of_test.py').write_text(module)


def test_additions(words: Words, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What an extension adds comes last, with its substitutions performed."""
    _install(tmp_path, monkeypatch, 'enclave = node_extensions_of_test:Enclave')
    found = words(name='n', namespace='a', remappings=[('x', 'y')])
    assert found[-4:] == ['-r', 'x:=y', '--enclave', '/a/n']


def test_changed_name(words: Words, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An extension may change what the node is told about its name."""
    _install(tmp_path, monkeypatch, 'renaming = node_extensions_of_test:Renaming')
    assert words(name='n') == ['--ros-args', '-r', '__node:=other']


def test_extension_that_cannot_be_loaded(
    words: Words,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    """It is reported once, and the node is started without it."""
    _install(tmp_path, monkeypatch, 'broken = node_extensions_of_test:Missing')
    assert words() == words() == ['--ros-args']
    out = capfd.readouterr().out
    assert out.count("the extension 'broken' (node_extensions_of_test:Missing) of nodes") == 1
